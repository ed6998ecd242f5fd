// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "cli/report.h"
#include "cli/simulate.h"
#include "cli/verb.h"
#include "tenon/bake/stage_values.h"
#include "tenon/bake/write_log.h"

namespace tenon::cli {
namespace {

struct Options {
  SimulateArguments simulate;
  std::string log;
  std::string bake;
};

Json list(const Vec3d& v) { return Json(v.v); }
Json list(const Quatd& q) { return Json::array({q.w, q.x, q.y, q.z}); }

Json bodies_json(const Simulated& s) {
  Json bodies = Json::object();
  for (physics::Index i = 0; i < s.scene->bodies.size(); ++i) {
    const engines::BodyState state = bake::in_stage_units(s.simulation->body_state(i), *s.scene);
    bodies[s.scene->bodies[i].path.str()] = {{"position", list(state.pose.position)},
                                             {"orientation", list(state.pose.orientation)},
                                             {"linearVelocity", list(state.linear_velocity)},
                                             {"angularVelocity", list(state.angular_velocity)}};
  }
  return bodies;
}

Json joints_json(const Simulated& s) {
  Json joints = Json::object();
  for (physics::Index i = 0; i < s.scene->joints.size(); ++i) {
    const engines::JointState state =
        bake::in_stage_units(s.simulation->joint_state(i), s.scene->joints[i], *s.scene);
    joints[s.scene->joints[i].path.str()] = {{"position", state.position},
                                             {"velocity", state.velocity}};
  }
  return joints;
}

Json not_mapped_json(const Simulated& s) {
  Json items = Json::array();
  for (const physics::NotRead& item : s.scene->not_read) {
    items.push_back({{"prim", item.prim.str()}, {"property", item.property}, {"why", item.why}});
  }
  for (const engines::NotMapped& item : s.simulation->not_mapped()) {
    items.push_back({{"prim", item.prim.str()}, {"property", item.property}, {"why", item.why}});
  }
  return items;
}

/// What changed for good: joints that broke (S-93).
Json events_json(const Simulated& s) {
  Json items = Json::array();
  for (const engines::Event& event : s.simulation->events()) {
    items.push_back({{"time", event.time}, {"prim", event.prim.str()}, {"what", event.what}});
  }
  return items;
}

Json end_state(const Simulated& s, const std::string& engine) {
  Json state = Json::object();
  state["engine"] = engine;
  state["engineVersion"] = s.engine_version;
  state["dt"] = s.simulation->time_step();
  state["steps"] = s.run.steps;
  state["time"] = s.run.time;
  state["realTimeFactor"] = s.wall_seconds > 0 ? s.run.time / s.wall_seconds : 0.0;
  state["unstable"] = s.unstable();
  state["bodies"] = bodies_json(s);
  state["joints"] = joints_json(s);
  state["energy"] = {{"initial", s.run.initial_energy.total()},
                     {"final", s.run.final_energy.total()}};
  state["contacts"] = s.simulation->contact_count();
  state["events"] = events_json(s);
  state["notMapped"] = not_mapped_json(s);
  return state;
}

void print_numbers(const Json& numbers) {
  for (const auto& number : numbers) {
    std::printf(" %10.5g", number.get<double>());
  }
}

/// One line per reason, with the first prim and how many more there are.
void print_not_mapped(const Json& items) {
  std::vector<std::pair<std::string, std::vector<std::string>>> reasons;
  for (const auto& item : items) {
    const std::string reason =
        item["property"].get<std::string>() + ": " + item["why"].get<std::string>();
    auto found = std::find_if(reasons.begin(), reasons.end(),
                              [&](const auto& known) { return known.first == reason; });
    if (found == reasons.end()) {
      found = reasons.insert(reasons.end(), {reason, {}});
    }
    found->second.push_back(item["prim"].get<std::string>());
  }
  for (const auto& [reason, prims] : reasons) {
    const std::string more =
        prims.size() > 1 ? " and " + std::to_string(prims.size() - 1) + " more" : "";
    std::printf("not mapped  %s (<%s>%s)\n", reason.c_str(), prims.front().c_str(), more.c_str());
  }
}

void print_text(const Json& state) {
  std::printf(
      "%s %s  %zu steps of %g s = %g s  %.1fx real time%s\n",
      state["engine"].get<std::string>().c_str(), state["engineVersion"].get<std::string>().c_str(),
      state["steps"].get<std::size_t>(), state["dt"].get<double>(), state["time"].get<double>(),
      state["realTimeFactor"].get<double>(), state["unstable"].get<bool>() ? "  UNSTABLE" : "");
  std::printf("energy %.6g J -> %.6g J, %zu contacts\n", state["energy"]["initial"].get<double>(),
              state["energy"]["final"].get<double>(), state["contacts"].get<std::size_t>());
  if (!state["joints"].empty()) {
    std::printf("joint positions (degrees or stage units)\n");
  }
  for (const auto& [path, joint] : state["joints"].items()) {
    std::printf("  %-56s", path.c_str());
    print_numbers(joint["position"]);
    std::printf("\n");
  }
  std::printf("body positions (stage units)\n");
  for (const auto& [path, body] : state["bodies"].items()) {
    std::printf("  %-56s", path.c_str());
    print_numbers(body["position"]);
    std::printf("\n");
  }
  for (const auto& event : state["events"]) {
    std::printf("at %g s  <%s> %s\n", event["time"].get<double>(),
                event["prim"].get<std::string>().c_str(), event["what"].get<std::string>().c_str());
  }
  print_not_mapped(state["notMapped"]);
}

Result<void> write_files(const Simulated& s, const Options& options, Report& report) {
  if (!options.log.empty()) {
    TENON_TRY(const std::string log, bake::log_for(options.log, *s.scene, s.run.recording));
    TENON_CHECK(write_output(options.log, log));
  }
  if (!options.bake.empty()) {
    TENON_CHECK(write_bake(s, options.simulate, options.bake, report));
  }
  return {};
}

int run_sim(const Globals& globals, const Options& options) {
  Report report(globals, "sim", options.simulate.asset.asset);
  auto simulated = simulate(options.simulate, report);
  if (!simulated) {
    return report.fail(simulated.error());
  }
  const Json state = end_state(*simulated, options.simulate.engine);
  if (!globals.json) {
    print_text(state);
  }
  if (simulated->run.interrupted) {
    return report.finish(kInterrupted, state);
  }
  if (auto written = write_files(*simulated, options, report); !written) {
    report.diagnostics.add(written.error().diagnostic());
    return report.finish(exit_code_of(written.error()), state);
  }
  return report.finish(simulated->exit_code(), state);
}

}  // namespace

void add_sim(const Command& parent, const Globals& globals, Chosen& chosen) {
  const Command verb = parent.add_subcommand("sim", "Simulate the asset on a real engine");
  auto options = std::make_shared<Options>();
  options->simulate.add_to(verb);
  verb.add_option("-o,--output", options->log, "Write a log: .csv, .jsonl or .npz");
  verb.add_option("--bake", options->bake, "Also write the motion as a layer over the asset");
  verb.footer(
      "Examples:\n"
      "  tenon sim hand.usda --physics physics --duration 5 -o run.csv\n"
      "  tenon sim door.usda --set /Door/hinge.drive:angular:physics:targetPosition=45 --json");
  choose(verb, chosen, [&globals, options] { return run_sim(globals, *options); });
}

}  // namespace tenon::cli
