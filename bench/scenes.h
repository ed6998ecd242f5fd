// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "tenon/layer/layer.h"

/// Inputs of the benchmarks, made from a seed: the same on every machine.
namespace tenon::bench {

/// `prim_count` prims: groups of 99 shapes and frames, each with transform ops, a tag, a short
/// array and a colour; every tenth part is animated over 24 samples.
layer::Layer make_prim_scene(std::size_t prim_count, std::uint64_t seed);

/// Bodies with one collider each, in rows of 100, and a joint from every body of even number to the
/// next: revolute (half of them driven), prismatic, spherical, fixed in turn. Metres, kilograms.
layer::Layer make_physics_scene(std::size_t body_count, std::uint64_t seed);

/// Cubes of 0.2 m above a plane, 25 in a layer, not quite in rows: they fall on each other.
layer::Layer make_pile_scene(std::size_t body_count, std::uint64_t seed);

/// A small asset with a variant set, inherited classes and an internal reference: 18 composed
/// prims.
layer::Layer make_part_asset();

/// `count` references to `asset_path`, every one with an own opinion and a variant selection; those
/// with `instanceable` share prototypes.
layer::Layer make_fleet_scene(std::size_t count, const std::string& asset_path, bool instanceable);

/// A wavy square of `side` x `side` points with normals, texture coordinates and a mesh collider.
layer::Layer make_mesh_scene(std::size_t side);

}  // namespace tenon::bench
