// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "tenon/base/path.h"
#include "tenon/base/result.h"
#include "tenon/layer/layer.h"
#include "tenon/scene/physics_scene.h"

namespace tenon::structure {

/// Where two things that should be the same are not.
struct Disagreement {
  std::string prim;
  std::string property;
  std::string what;
};

/// Invalid, "structure.differs": `of`, what is composed, would not be the same under a variant.
Error differs(const std::string& variant, const Disagreement& where, const char* of);

/// The first prim, property or value that one content has and the other has not. Order of children
/// and of lists of API schemas, prims that are switched off, blocked values and empty lists of
/// targets do not count; numbers do to the last bit, except that NaN is NaN.
std::optional<Disagreement> compare_contents(const layer::Layer& expected,
                                             const layer::Layer& found);

/// The first difference of two physics scenes: objects are matched by path, `moved` gives the path
/// in `found` of a collider of `expected`. Numbers may differ by one part in 10^9.
std::optional<Disagreement> compare_physics(const scene::PhysicsScene& expected,
                                            const scene::PhysicsScene& found,
                                            const std::function<Path(Path)>& moved);

}  // namespace tenon::structure
