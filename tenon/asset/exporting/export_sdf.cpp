// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/exporting/export_sdf.h"

#include <algorithm>

#include "tenon/asset/exporting/kept_apart.h"
#include "tenon/asset/exporting/obj_files.h"
#include "tenon/asset/physics_options.h"
#include "tenon/base/file_finding.h"
#include "tenon/describe/describe_robot.h"
#include "tenon/physics/read_physics.h"
#include "tenon/sdf/plain_sdf.h"
#include "tenon/sdf/write_sdf.h"

namespace tenon {
namespace {

/// The links and joints that are written: frames are neither, nor is the world without shapes, and
/// what floats has no joint. A world with shapes is a link that a joint holds.
void count_parts(const robot::RobotModel& model, ExportedUrdf& result) {
  const sdf::Carriers carriers = sdf::carriers_of(model);
  const robot::Link& root = model.links[carriers.root];
  const bool has_shapes = !root.visuals.empty() || !root.colliders.empty();
  const auto frames =
      static_cast<std::size_t>(std::count(carriers.is_frame.begin(), carriers.is_frame.end(), 1));
  result.links = model.links.size() - frames - (carriers.root_is_world && !has_shapes ? 1 : 0);
  const auto floating = static_cast<std::size_t>(std::count_if(
      model.joints.begin(), model.joints.end(),
      [](const robot::Joint& joint) { return joint.kind == robot::JointKind::Floating; }));
  result.joints =
      model.joints.size() - frames - floating + (carriers.root_is_world && has_shapes ? 1 : 0);
}

}  // namespace

Result<ExportedUrdf> export_sdf(const stage::Stage& stage, const std::string& folder,
                                Diagnostics& diagnostics) {
  physics::Provenance provenance;
  const scene::PhysicsScene scene =
      physics::read_physics(stage, read_options(), diagnostics, &provenance);
  TENON_TRY(robot::RobotModel model,
            describe::describe_robot(stage, scene, diagnostics, describe::Format::Sdf));
  const KeptApart apart = model.self_collision ? kept_apart(scene, provenance) : KeptApart{};
  const std::size_t pairs = apart.pairs.size();
  if (pairs > 0) {
    diagnostics.add(file_finding(Severity::Warning, "sdf.left-out",
                                 (apart.is_cut ? "more than " : "") + std::to_string(pairs) +
                                     (pairs == 1 ? " pair of links is" : " pairs of links are") +
                                     " kept apart, which SDF does not support; dropped",
                                 ""));
  }
  sdf::make_plain(model, diagnostics);
  ExportedUrdf result;
  result.meshes = name_obj_files(model, folder);
  result.text = sdf::write_sdf(model);
  count_parts(model, result);
  return result;
}

}  // namespace tenon
