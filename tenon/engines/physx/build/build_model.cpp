// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The list of passes: neutral scene -> PhysX. What PhysX itself says while they run is an error
// where no object came of it, and a warning where one did.
#include "tenon/engines/physx/build/build.h"

namespace tenon::engines::physx {
namespace {

Result<void> run_passes(Build& build, Begin begin) {
  plan_joints(build);
  TENON_CHECK(add_scenes(build));
  add_materials(build);
  TENON_CHECK(add_bodies(build));
  add_colliders(build);
  set_reduced_joints(build);
  add_constraints(build);
  add_mimics(build);
  add_tendons(build);
  report_unmapped(build);
  start(build, begin);
  return {};
}

}  // namespace

Result<Model> build_model(const scene::PhysicsScene& scene, const SimulationOptions& options,
                          double time_step, Diagnostics& diagnostics, Begin begin) {
  TENON_TRY(const Runtime* runtime, open_physx());
  if (scene.scenes.empty()) {
    return Error(ErrorCode::Invalid, "the description has no scene").with_rule("physx.no-scene");
  }
  Messages messages;
  Build build(scene, *runtime, options, diagnostics);
  build.model.time_step = time_step;
  TENON_CHECK(run_passes(build, begin));
  for (const std::string& words : messages.errors()) {
    diagnostics.add({Severity::Warning, "physx.message", "PhysX says: " + words, "", "", ""});
  }
  build.model.child_of_joint.resize(scene.joints.size());
  for (scene::Index b = 0; b < build.forest.bodies.size(); ++b) {
    if (const std::optional<scene::Index>& joint = build.forest.bodies[b].joint) {
      build.model.child_of_joint[*joint] = b;
    }
  }
  build.model.forest = std::move(build.forest);
  for (const scene::Joint& joint : scene.joints) {
    build.model.joint_frames.emplace_back(joint.frame0, joint.frame1);
  }
  return std::move(build.model);
}

}  // namespace tenon::engines::physx
