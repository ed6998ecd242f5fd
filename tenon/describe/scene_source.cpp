// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/describe/scene_source.h"

#include "tenon/layer/fields.h"

namespace tenon::describe {

std::string SceneSource::name_of(Path prim, const char* otherwise) const {
  if (prim.empty()) {
    return otherwise;
  }
  if (const stage::Prim source = stage_.prim(prim)) {
    const layer::Value shown = source.metadata(layer::fields::displayName);
    if (const auto* text = shown.get<std::string>(); text != nullptr && !text->empty()) {
      return *text;
    }
  }
  return prim.name().str();
}

Placed SceneSource::placed(const stage::Prim& prim) {
  const double unit = scene_.meters_per_unit;
  const Mat4d& world = cache_.local_to_world(prim);
  Placed result;
  result.pose = rigid_part(world);
  result.rest = world * inverse(pose_matrix(result.pose)) * scale_matrix({{unit, unit, unit}});
  result.pose.position = result.pose.position * unit;
  return result;
}

void SceneSource::left_out(Path prim, const std::string& why) {
  struct Names {
    const char* rule;
    const char* format;
  };
  const Names names = is_mjcf()  ? Names{"mjcf.left-out", "MJCF"}
                      : is_sdf() ? Names{"sdf.left-out", "SDF"}
                                 : Names{"urdf.left-out", "URDF"};
  Diagnostic finding;
  finding.severity = Severity::Warning;
  finding.rule = names.rule;
  finding.message = why + ", which " + names.format + " does not support; dropped";
  finding.prim = prim.str();
  diagnostics_.add(std::move(finding));
}

/// Cyclic turns, so exact ones.
Quatd turn_from_z(scene::Axis axis) {
  switch (axis) {
    case scene::Axis::X:
      return {0.5, 0.5, 0.5, 0.5};
    case scene::Axis::Y:
      return {-0.5, -0.5, -0.5, 0.5};
    case scene::Axis::Z:
      break;
  }
  return kIdentityRotation;
}

}  // namespace tenon::describe
