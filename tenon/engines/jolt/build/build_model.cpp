// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The list of passes: neutral scene -> Jolt.
#include <utility>

#include "tenon/engines/jolt/build/build.h"
#include "tenon/engines/jolt/jolt_runtime.h"

namespace tenon::engines::jolt {

Result<Model> build_model(const scene::PhysicsScene& scene, const SimulationOptions& options,
                          double time_step, Diagnostics& diagnostics, Begin begin) {
  open_jolt();
  if (scene.scenes.empty()) {
    return Error(ErrorCode::Invalid, "the description has no scene").with_rule("jolt.no-scene");
  }
  Build build(scene, options, diagnostics);
  build.model.time_step = time_step;
  plan(build, begin);
  add_systems(build);
  TENON_CHECK(add_bodies(build, begin));
  add_trees(build);
  add_holders(build);
  add_laws(build);
  add_mimics(build);
  add_tendons(build);
  report_unmapped(build);
  insert_constraints(build);
  build.model.forest = std::move(build.forest);
  return std::move(build.model);
}

}  // namespace tenon::engines::jolt
