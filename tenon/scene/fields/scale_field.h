// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "tenon/base/path.h"
#include "tenon/scene/physics_scene.h"

namespace tenon::scene {

/// Whether `meant` is an object: its path, the last element of it, or, where it is empty, any.
bool is_meant(const Path& meant, const Path& object);

/// Multiplies a number of the objects of a list, found by the names of the tables: "colliders",
/// "shape.radius"; all components of vectors and matrices. `object`: which (is_meant()).
/// Unlimited stays unlimited. Gives how many objects have it.
std::size_t scale_field(std::string_view list, std::string_view field, Path object, double factor,
                        PhysicsScene& scene);

/// Sets a number, or all components of a vector or a matrix, row by row, found in the same way;
/// `values` are as many. Gives how many objects have it.
std::size_t set_field(std::string_view list, std::string_view field, Path object,
                      std::span<const double> values, PhysicsScene& scene);

}  // namespace tenon::scene
