// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/simulating/simulated_json.h"

#include <utility>

#include "tenon/bake/record_outputs.h"
#include "tenon/bake/stage_values.h"

namespace tenon {
namespace {

using answers::append_member;
using answers::Json;

Json list_json(const Vec3d& v) { return Json(v.v); }
Json list_json(const Quatd& q) { return Json::array({q.w, q.x, q.y, q.z}); }

Json bodies_json(const SimulatedAsset& s) {
  Json bodies = Json::object();
  for (scene::Index i = 0; i < s.scene->bodies.size(); ++i) {
    const engines::BodyState state = bake::in_stage_units(s.simulation->body_state(i), *s.scene);
    append_member(bodies, s.scene->bodies[i].path.str(),
                  {{"position", list_json(state.pose.position)},
                   {"orientation", list_json(state.pose.orientation)},
                   {"linearVelocity", list_json(state.linear_velocity)},
                   {"angularVelocity", list_json(state.angular_velocity)}});
  }
  return bodies;
}

Json joints_json(const SimulatedAsset& s) {
  Json joints = Json::object();
  for (scene::Index i = 0; i < s.scene->joints.size(); ++i) {
    const engines::JointState state =
        bake::in_stage_units(s.simulation->joint_state(i), s.scene->joints[i], *s.scene);
    append_member(joints, s.scene->joints[i].path.str(),
                  {{"position", state.position}, {"velocity", state.velocity}});
  }
  return joints;
}

/// Of the reading and of the engine.
Json all_not_mapped_json(const SimulatedAsset& s) {
  Json items = not_mapped_json(s.scene->not_read);
  for (Json& item : not_mapped_json(s.simulation->not_mapped())) {
    items.push_back(std::move(item));
  }
  return items;
}

/// What changed for good: joints that broke (S-93).
Json events_json(const SimulatedAsset& s) {
  Json items = Json::array();
  for (const engines::Event& event : s.simulation->events()) {
    items.push_back({{"time", event.time}, {"prim", event.prim.str()}, {"what", event.what}});
  }
  return items;
}

/// What the run was made with: settings of the engine, and which articulations collide with
/// themselves.
Json settings_json(const SimulatedAsset& s) {
  Json settings = Json::object();
  for (const scene::VendorSetting& setting : s.simulation->settings()) {
    const std::vector<double>& numbers = setting.numbers;
    append_member(settings, setting.name,
                  !setting.token.empty() ? Json(setting.token)
                  : numbers.size() == 1  ? Json(numbers.front())
                                         : Json(numbers));
  }
  Json articulations = Json::object();
  for (const scene::Articulation& articulation : s.scene->articulations) {
    append_member(articulations, articulation.path.str(), articulation.self_collision);
  }
  settings["selfCollision"] = std::move(articulations);
  return settings;
}

/// What the run was given and asked for.
void add_request(const SimulatedAsset& s, Json& state) {
  if (!s.state_in.empty()) {
    state["stateIn"] = s.state_in;
    state["begin"] = s.begin;
  }
  if (s.commands) {
    state["commands"] = {{"file", s.commands_file},
                         {"rows", s.commands->times.size()},
                         {"columns", s.commands->columns.size()}};
  }
  if (s.until_rest) {
    state["rest"] = {{"reached", s.run.rest_since.has_value()}};
    if (s.run.rest_since) {
      state["rest"]["since"] = *s.run.rest_since;
    }
  }
  if (s.simulation->outputs().any()) {
    state["log"] = bake::names_of(s.simulation->outputs());
  }
}

}  // namespace

Json not_mapped_json(const std::vector<scene::NotRead>& list) {
  Json items = Json::array();
  for (const scene::NotRead& item : list) {
    items.push_back({{"prim", item.prim.str()}, {"property", item.property}, {"why", item.why}});
  }
  return items;
}

Json simulated_json(const SimulatedAsset& s, bool timing) {
  Json state = Json::object();
  state["engine"] = s.engine;
  state["engineVersion"] = s.engine_version;
  state["dt"] = s.simulation->time_step();
  state["steps"] = s.run.steps;
  state["time"] = s.run.time;
  if (timing) {
    state["realTimeFactor"] = s.wall_seconds > 0 ? s.run.time / s.wall_seconds : 0.0;
  }
  state["engineSettings"] = settings_json(s);
  state["unstable"] = s.unstable();
  state["bodies"] = bodies_json(s);
  state["joints"] = joints_json(s);
  state["energy"] = {{"initial", s.run.initial_energy.total()},
                     {"final", s.run.final_energy.total()}};
  state["contacts"] = s.simulation->contact_count();
  state["events"] = events_json(s);
  state["notMapped"] = all_not_mapped_json(s);
  add_request(s, state);
  return state;
}

Json motion_json(const SimulatedAsset& simulated, const std::string& output) {
  return {{"output", output},
          {"frames", simulated.run.recording.frame_count()},
          {"bodies", simulated.scene->bodies.size()},
          {"time", simulated.run.time}};
}

}  // namespace tenon
