// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The list of passes: neutral scene -> mjSpec -> mjModel. Each pass names what those before it
// made, so bodies come first, then joints and what acts on them, then geoms, then filters and
// surfaces, which look at the geoms. MuJoCo refuses whole models. The part that its message names
// is skipped (of a joint, its limits), and all passes run again on a fresh spec, at most 100 times.
#include <set>
#include <string_view>

#include "tenon/base/limits/limits.h"
#include "tenon/engines/mujoco/build/build.h"
#include "tenon/engines/mujoco/build/model_size.h"
#include "tenon/engines/mujoco/build/surfaces.h"
#include "tenon/engines/mujoco/error_hook.h"
#include "tenon/engines/time_step.h"

namespace tenon::engines::mujoco {
namespace {

constexpr std::size_t kMaxRefused = 100;  // parts that are skipped before the model is given up
constexpr std::size_t kDeepest = 1023;    // bodies below each other that MuJoCo takes
static_assert(kDeepest <= limits::kKinematicChain);

Result<void> check_sizes(const Build& build) {
  if (build.plan.forest.depth > kDeepest) {
    return Error(ErrorCode::Limit, "a chain of " + std::to_string(build.plan.forest.depth) +
                                       " jointed bodies is longer than the " +
                                       std::to_string(kDeepest) + " that MuJoCo takes")
        .with_rule("mujoco.chain-too-long")
        .with_fix("simulate it on PhysX or Jolt (--engine physx)");
  }
  if (build.scene.scenes.empty()) {
    return Error(ErrorCode::Invalid, "the description has no scene").with_rule("mujoco.no-scene");
  }
  return {};
}

/// The collider or joint that MuJoCo's words name as an element, or an empty path.
Path refused_part(const scene::PhysicsScene& scene, const std::string& words) {
  constexpr std::string_view kBefore = "Element name '";
  const std::size_t at = words.find(kBefore);
  const std::size_t end = at == std::string::npos ? at : words.find('\'', at + kBefore.size());
  if (end == std::string::npos) {
    return {};
  }
  const std::string name = words.substr(at + kBefore.size(), end - at - kBefore.size());
  const auto names = [&](const Path& path) {
    return name == path.str() || name.starts_with(path.str() + ".");
  };
  for (const scene::Collider& collider : scene.colliders) {
    if (names(collider.path)) {
      return collider.path;
    }
  }
  for (const scene::Joint& joint : scene.joints) {
    if (names(joint.path)) {
      return joint.path;
    }
  }
  for (const scene::MujocoActuator& actuator : scene.actuators) {
    if (names(actuator.path)) {
      return actuator.path;
    }
  }
  return {};
}

Result<Model> build_once(Build& build, Begin begin) {
  const scene::PhysicsScene& scene = build.scene;
  TENON_CHECK(check_scene_size(scene));
  build.plan = plan_tree(scene);
  TENON_CHECK(check_sizes(build));
  const std::vector<scene::FreeRotations> rotations = wanted_rotations(scene);
  for (std::size_t j = 0; j < scene.joints.size(); ++j) {
    build.dofs.push_back(joint_dofs(scene.joints[j], rotations[j]));
  }
  build.joints.assign(scene.joints.size(), {});
  build.balls.assign(scene.joints.size(), nullptr);
  add_options(build);
  add_bodies(build);
  add_joints(build);
  add_equalities(build);
  add_actuators(build);
  TENON_CHECK(add_geoms(build));
  add_tendons(build);
  add_box_tests(build);
  add_mujoco_actuators(build);
  ContactFilter filter = add_filters(build);
  Surfaces surfaces = add_surfaces(build);
  report_unmapped(build);
  TENON_TRY(Model model, compile(build));
  connect_geoms(model, std::move(filter), std::move(surfaces));
  const bool is_text = build.purpose == Purpose::Text;
  const int flags = model.model->opt.disableflags;
  if (is_text) {  // nothing is stepped, so what touches does not matter, however much it is
    model.model->opt.disableflags |= mjDSBL_CONTACT;
  }
  TENON_CHECK(set_initial_state(scene, begin, model, build.diagnostics));
  model.model->opt.disableflags = flags;
  if (!is_text) {
    report_overlaps(scene, model, build.diagnostics);
  }
  return model;
}

/// Who read the scene from a stage has said where frames are apart, in words of the file.
void append_untold(const Diagnostics& findings, Diagnostics& diagnostics) {
  std::set<std::string> told;
  for (const Diagnostic& found : diagnostics) {
    if (found.rule == "joint.frames-apart") {
      told.insert(found.prim);
    }
  }
  for (const Diagnostic& found : findings) {
    if (found.rule != "joint.frames-apart" || !told.contains(found.prim)) {
      diagnostics.add(found);
    }
  }
}

}  // namespace

Result<SpecAndModel> build_spec(const scene::PhysicsScene& scene, const SimulationOptions& options,
                                Diagnostics& diagnostics, Begin begin, Purpose purpose) {
  TENON_CHECK(open_mujoco());
  const double time_step =
      choose_time_step(scene, options, "MuJoCo", "mujoco.time-step", diagnostics);
  std::set<Path> refused;
  while (true) {
    Diagnostics findings;
    Build build(scene, findings);
    build.time_step = time_step;
    build.purpose = purpose;
    build.drive_terms = options.drives;
    build.methods = options.methods;
    build.refused = refused;
    Result<Model> model = build_once(build, begin);
    if (model.has_value()) {
      append_untold(findings, diagnostics);
      return SpecAndModel{std::move(build.spec), std::move(*model)};
    }
    // MuJoCo refuses whole models: the part that it names is skipped and reported.
    const Path part = refused_part(scene, model.error().message());
    if (part.empty() || refused.size() >= kMaxRefused || !refused.insert(part).second) {
      append_untold(findings, diagnostics);
      return model.error();
    }
    diagnostics.add(
        {Severity::Warning, "mujoco.part-left-out",
         "MuJoCo refuses a part of the model, which goes on without it: " + model.error().message(),
         part.str(), "", "give the shape a size, the joint sound limits"});
  }
}

Result<Model> build_model(const scene::PhysicsScene& scene, const SimulationOptions& options,
                          Diagnostics& diagnostics, Begin begin) {
  TENON_TRY(SpecAndModel built, build_spec(scene, options, diagnostics, begin));
  return std::move(built.model);
}

}  // namespace tenon::engines::mujoco
