// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "tenon/scene/mujoco_parts.h"
#include "tenon/scene/vendor_setting.h"

/// What the schemas of single vendors author on an object beside its neutral fields: one member for
/// each vendor, of a type of that vendor's own header (mujoco_parts.h). Other engines ignore it.
/// Which attributes of a vendor's schemas are neutral, kept here or without effect, and why, is in
/// physics/vendors/vendor_attributes.def. A further vendor is a header, members here, and their
/// rows in fields/object_fields.h.
namespace tenon::scene {

struct SceneParts {
  /// What MjcSceneAPI authors, except the time step; none without that API.
  std::optional<std::vector<VendorSetting>> mujoco{};
  std::vector<VendorSetting> physx{};  ///< how PhysxSceneAPI wants it solved, by name
};

struct BodyParts {
  std::vector<VendorSetting> physx{};  ///< how PhysxRigidBodyAPI wants it solved, by name
};

struct ArticulationParts {
  std::vector<VendorSetting> physx{};  ///< how PhysxArticulationAPI wants it solved, by name
};

struct ColliderParts {
  MujocoContact mujoco;
};

struct JointParts {
  MujocoSoftness mujoco;
  MujocoLoop mujoco_loop;
};

struct MimicParts {
  MujocoEquality mujoco;
};

}  // namespace tenon::scene
