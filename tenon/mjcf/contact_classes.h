// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "tenon/mjcf/mjcf_source.h"
#include "tenon/robot/robot_model.h"

/// Internal to this folder.
namespace tenon::mjcf {

/// Which geoms touch which.
struct ContactClasses {
  std::vector<robot::ContactClass> classes;
  std::vector<std::optional<robot::Index>> of_geom;  ///< (ngeom), into classes; none: touches all
  std::vector<bool> collides;                        ///< (ngeom), ever touches anything
};

/// Lists other settings of contact pairs, and too many classes, as skipped.
ContactClasses find_contact_classes(MjcfSource& source);

}  // namespace tenon::mjcf
