// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "tenon/base/result.h"
#include "tenon/math/transform.h"
#include "tenon/math/vector.h"
#include "tenon/stage/prim.h"

/// Internal to the wiring.
namespace tenon {

/// The place of a joint, in the world as the stage has it (units of length of the stage).
struct JointWish {
  stage::Prim body0;         ///< invalid: the world
  stage::Prim body1;         ///< the same; one of them is a prim
  std::optional<Vec3d> at;   ///< without it the origin of body1, else of body0
  std::string axis;          ///< "X", "Y", "Z" of the world, "x,y,z" there; empty: X of that body
  bool own_origins = false;  ///< without `at`: the origin of each body, for joints over a distance
};

/// The frames of a joint, as UsdPhysics has them: in the space of each prim, its scale included.
struct JointPlacement {
  Vec3d position0;
  Vec3d position1;
  Quatd rotation0;
  Quatd rotation1;
  std::string axis;  ///< "X", "Y" or "Z" of the frames
};

/// Frames that agree in the poses that the prims have at time `start`. Errors: Invalid
/// (edit.bad-argument) for an axis that is none.
Result<JointPlacement> place_joint(const JointWish& wish, double start);

/// "1,2,3", with or without brackets. Errors: Invalid (edit.bad-argument).
Result<Vec3d> read_vector(const std::string& text, const std::string& what);

}  // namespace tenon
