// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/scene/physics_scene.h"

/// Links and joints that one run or session skips or holds, while the asset stays as it is.
namespace tenon::dynamics {

/// Each text is a path, a name or a regular expression (tenon/base/text/name_pattern.h) and may
/// mean several.
struct Masks {
  /// Links with all that hangs on them, joints, or the path of a prim with all that is below it.
  std::vector<std::string> deactivate{};
  /// Joints, which hold their sides as they stand at the start, and links, whose joints hang on
  /// the link before them.
  std::vector<std::string> bypass{};
  std::vector<std::string> anchor{};  ///< links, fixed to the world where they start

  bool empty() const { return deactivate.empty() && bypass.empty() && anchor.empty(); }
};

/// Changes the scene as the masks say; bodies keep their places in their list. What was done, and
/// what does not act because of it (mimics, tendons, actuators, sensors), is in `findings`, of
/// severity Info, rules mask.deactivated, mask.bypassed, mask.anchored and mask.skipped. Errors:
/// those of NamePattern; NotFound (mask.unknown) for what nothing is called, Invalid
/// (mask.conflict) for a part that two masks mean, and (mask.no-parent) for a bypassed link that
/// hangs on nothing.
Result<void> apply_masks(const Masks& masks, scene::PhysicsScene& scene, Diagnostics& findings);

}  // namespace tenon::dynamics
