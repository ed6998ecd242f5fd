// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tenon/mjcf/contact_classes.h"
#include "tenon/mjcf/mjcf_source.h"
#include "tenon/mjcf/shapes/material_table.h"
#include "tenon/robot/robot_model.h"

/// Internal to this folder.
namespace tenon::mjcf {

/// What geoms are on the link of their body: those that touch are colliders, those that are shown
/// or touch nothing are visuals.
struct BodyShapes {
  std::vector<robot::Visual> visuals;
  std::vector<robot::Collider> colliders;
};

/// The shapes of all bodies (nbody), by MuJoCo's number. `meshes` are those of read_meshes;
/// `materials` is asked how each visual looks. Geoms of other kinds are listed as skipped.
std::vector<BodyShapes> read_geoms(MjcfSource& source, const std::vector<robot::MeshFile>& meshes,
                                   const ContactClasses& contacts, MaterialTable& materials);

}  // namespace tenon::mjcf
