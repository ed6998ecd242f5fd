// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The table of requests, and what those do that steer the simulation; panel_requests.cpp has those
// of panels. A request that cannot be done is an error that the page receives, and changes nothing.
#include <algorithm>
#include <array>
#include <utility>

#include "tenon/live/move_joint.h"
#include "tenon/live/session_state.h"
#include "tenon/live/shapes.h"
#include "tenon/make_simulation.h"

namespace tenon::live {
namespace {

using State = Session::State;

constexpr std::uint32_t kMostSteps = 1000;
constexpr double kLeastSpeed = 0.001;
constexpr double kMostSpeed = 100;

/// Tells everyone, and is the answer.
Json new_state(const State& state, Outbox& out) {
  const Json notice = state.state_notice();
  state.tell(0, notice, out);
  return Json::object();
}

Result<Json> play(State& state, ClientNumber, const Asked&, Outbox& out) {
  TENON_CHECK(state.world());
  TENON_CHECK(state.check_not_stopped());
  state.playing = true;
  state.owed = 0;
  return new_state(state, out);
}

Result<Json> pause(State& state, ClientNumber, const Asked&, Outbox& out) {
  state.playing = false;
  return new_state(state, out);
}

Result<Json> step_some(State& state, ClientNumber, const Asked& asked, Outbox& out) {
  const std::uint32_t count = asked.integer("count", 1);
  state.playing = false;
  for (std::uint32_t i = 0; i < count; ++i) {
    TENON_CHECK(state.step(out));
  }
  state.tell_observers(out);
  return new_state(state, out);
}

Result<Json> reset(State& state, ClientNumber, const Asked&, Outbox& out) {
  TENON_TRY(engines::World * world, state.world());
  TENON_CHECK(world->reset());
  state.targets.clear();
  state.begin_again("reset", out);
  return Json::object();
}

Result<Json> set_speed(State& state, ClientNumber, const Asked& asked, Outbox& out) {
  const double speed = asked.number("factor", 1);
  if (speed < kLeastSpeed || speed > kMostSpeed) {
    return refused("the speed must be from 0.001 to 100", "give another factor");
  }
  state.speed = speed;
  return new_state(state, out);
}

Result<Json> set_drive(State& state, ClientNumber, const Asked& asked, Outbox&) {
  TENON_TRY(engines::World * world, state.world());
  TENON_TRY(const scene::Index index, state.joint(asked.path("joint")));
  const scene::Joint& joint = state.asset.scene().joints[index];
  const scene::Index drive = asked.integer("drive");
  if (drive >= joint.drives.size()) {
    return refused("the joint has " + std::to_string(joint.drives.size()) + " drives",
                   "apply PhysicsDriveAPI to it, or name one that it has");
  }
  const auto key = std::make_pair(joint.path, drive);
  const auto known = state.targets.find(key);
  engines::DriveTarget target{joint.drives[drive].target_position,
                              joint.drives[drive].target_velocity};
  target = known == state.targets.end() ? target : known->second;
  target.position = asked.number("position", target.position);
  target.velocity = asked.number("velocity", target.velocity);
  TENON_CHECK(world->set_drive_target(index, drive, target));
  state.targets[key] = target;
  state.act();
  return Json{{"position", target.position}, {"velocity", target.velocity}};
}

Result<Json> set_joint(State& state, ClientNumber, const Asked& asked, Outbox& out) {
  TENON_TRY(engines::World * world, state.world());
  TENON_TRY(const scene::Index index, state.joint(asked.path("joint")));
  TENON_CHECK(state.check_not_stopped());
  if (state.playing) {
    return refused("the simulation is running: joints are moved by hand while it is paused",
                   "pause first");
  }
  const std::vector<double> wanted = asked.numbers("position");
  const std::size_t count = world->joint_state(index).position.size();
  if (wanted.size() != count) {
    return refused("the joint has " + std::to_string(count) + " coordinates", "give as many");
  }
  TENON_CHECK(move_joint(state.asset, index, wanted));
  state.act();
  state.moved = true;
  state.tell_observers(out);
  return Json{{"position", world->joint_state(index).position}};
}

Result<Json> set_effort(State& state, ClientNumber, const Asked& asked, Outbox&) {
  TENON_TRY(engines::World * world, state.world());
  TENON_TRY(const scene::Index index, state.joint(asked.path("joint")));
  const std::vector<double> efforts = asked.numbers("effort");
  const std::size_t count = world->joint_state(index).velocity.size();
  if (efforts.size() != count) {
    return refused("the joint has " + std::to_string(count) + " degrees of freedom",
                   "give as many efforts");
  }
  TENON_CHECK(world->set_joint_efforts(index, efforts));
  state.act();
  return Json{{"effort", efforts}};
}

/// The body that is asked for, where it can be pulled.
Result<Pull> pull_at(const State& state, const Asked& asked) {
  Pull pull;
  TENON_TRY(pull.body, state.body(asked.path("body")));
  const scene::Body& body = state.asset.scene().bodies[pull.body];
  if (body.kinematic) {
    return refused("<" + body.path.str() + "> is kinematic: forces do not move it",
                   "pull at a body that moves freely");
  }
  return pull;
}

Result<Json> push(State& state, ClientNumber client, const Asked& asked, Outbox& out) {
  TENON_TRY(engines::World * world, state.world());
  TENON_TRY(Pull pull, pull_at(state, asked));
  const Pose pose = world->body_state(pull.body).pose;
  pull.anchor = transform_point(inverse(pose), asked.point("point"));
  pull.force = asked.point("force");
  state.pulls.set(client, pull);
  state.act();
  return new_state(state, out);
}

Result<Json> drag(State& state, ClientNumber client, const Asked& asked, Outbox& out) {
  TENON_CHECK(state.world());
  TENON_TRY(Pull pull, pull_at(state, asked));
  pull.anchor = asked.point("anchor");
  pull.target = asked.point("target");
  pull.to_target = true;
  state.pulls.set(client, pull);
  state.act();
  return new_state(state, out);
}

Result<Json> release(State& state, ClientNumber client, const Asked&, Outbox& out) {
  state.pulls.release(client);
  return new_state(state, out);
}

Result<Json> observe(State& state, ClientNumber client, const Asked& asked, Outbox& out) {
  State::Client& one = state.clients[client];
  one.contacts = asked.flag("contacts", one.contacts);
  one.plots = asked.flag("plots", one.plots);
  if (!state.playing) {
    state.tell_observers(out);  // there is something to see at once
  }
  return Json{{"contacts", one.contacts}, {"plots", one.plots}};
}

Result<Json> choose_variant(State& state, ClientNumber, const Asked& asked, Outbox& out) {
  const std::string prim_path = asked.text("prim");
  const std::string set = asked.text("set");
  const std::string variant = asked.text("variant");
  const stage::Prim prim = state.asset.stage->prim(asked.path("prim"));
  const auto names = prim ? prim.variant_names(set) : std::vector<std::string>();
  if (std::find(names.begin(), names.end(), variant) == names.end()) {
    return Error(ErrorCode::NotFound,
                 "<" + prim_path + "> has no variant `" + variant + "` of a set `" + set + "`")
        .with_rule("variant.unknown")
        .with_prim(prim_path)
        .with_fix("choose one of those that the message `scene` lists");
  }
  LiveAssetOptions changed = state.options.asset;
  auto& selections = changed.open.selections;
  std::erase_if(selections,
                [&](const auto& one) { return one.prim == prim_path && one.set == set; });
  selections.push_back({prim_path, set, variant});
  TENON_CHECK(state.reopen(std::move(changed), "variant", out));
  return Json::object();
}

Result<Json> set_engine(State& state, ClientNumber, const Asked& asked, Outbox& out) {
  const std::string name = asked.text("engine");
  const engines::EngineInfo info = engine_info(name);
  if (!info.available) {
    return Error(ErrorCode::Missing, "the engine `" + name.substr(0, 64) + "` is not there")
        .with_rule("live.no-engine")
        .with_fix(info.how_to_get.empty() ? "choose one of those that the message `scene` lists"
                                          : info.how_to_get);
  }
  state.options.asset.engine = name;
  state.restart(name, "engine", out);
  return Json::object();
}

Result<Json> tell_messages(State&, ClientNumber, const Asked&, Outbox&) {
  return messages_json(requests());
}

constexpr std::array<Field, 0> kNoFields{};
constexpr std::array kStepFields{
    Field{"count", kInteger, false, "how many, at most 1,000; default 1", kMostSteps}};
constexpr std::array kSpeedFields{Field{"factor", kNumber, true, "1 is real time"}};
constexpr std::array kDriveFields{
    Field{"joint", kPath, true, "the joint's prim"},
    Field{"drive", kInteger, false, "which of its drives, default 0"},
    Field{"position", kNumber, false, "[rad, m]; default: unchanged"},
    Field{"velocity", kNumber, false, "[rad/s, m/s]; default: unchanged"}};
constexpr std::array kJointFields{
    Field{"joint", kPath, true, "the joint's prim"},
    Field{"position", kNumbers, true, "of each of its degrees of freedom [rad, m]"}};
constexpr std::array kEffortFields{
    Field{"joint", kPath, true, "the joint's prim"},
    Field{"effort", kNumbers, true, "along each of its degrees of freedom [N m, N]"}};
constexpr std::array kForceFields{Field{"body", kPath, true, "the body's prim"},
                                  Field{"point", kPoint, true, "where, world axes [m]"},
                                  Field{"force", kPoint, true, "world axes [N]"}};
constexpr std::array kDragFields{
    Field{"body", kPath, true, "the body's prim"},
    Field{"anchor", kPoint, true, "the point that is held, in the body's frame [m]"},
    Field{"target", kPoint, true, "where it is drawn to, world axes [m]"}};
constexpr std::array kObserveFields{Field{"contacts", kFlag, false, "as it was"},
                                    Field{"plots", kFlag, false, "as it was"}};
constexpr std::array kVariantFields{Field{"prim", kPath, true, "that has the set"},
                                    Field{"set", kText, true, "its name"},
                                    Field{"variant", kText, true, "of the set"}};
constexpr std::array kEngineFields{Field{"engine", kText, true, "its name"}};
constexpr std::array kPrimFields{Field{"prim", kPath, true, "any prim"}};
constexpr std::array kWhereFields{
    Field{"object", kText, true, "`/prim.property`, or `/prim`"},
    Field{"time", kNumber, false, "time code of what counts at times"}};
constexpr std::array kExplainFields{
    Field{"object", kText, true, "`/prim.property`, or `/prim`"},
    Field{"other", kText, false, "another prim: whether the two collide, and why not"}};
constexpr std::array kSetFields{
    Field{"object", kText, true, "`/prim.property`"},
    Field{"value", kText, true, "as text layers print it; of relationships paths"},
    Field{"engine", kText, false, "the file of this engine alone: physx, mujoco, newton"}};
constexpr std::array kClearFields{Field{"object", kText, true, "`/prim.property`"}};

// ---- what is answered

constexpr std::array kTargetFields{Field{"position", kNumber}, Field{"velocity", kNumber}};
constexpr Shape kTarget{"", kTargetFields};
constexpr std::array kMovedFields{Field{"position", kNumbers}};
constexpr Shape kMoved{"", kMovedFields};
constexpr std::array kPushedFields{Field{"effort", kNumbers}};
constexpr Shape kPushed{"", kPushedFields};
constexpr std::array kObservedFields{Field{"contacts", kFlag}, Field{"plots", kFlag}};
constexpr Shape kObserved{"", kObservedFields};
constexpr std::array kPrimRow{Field{"path", kPath}, Field{"specifier", kText}, Field{"type", kText},
                              Field{"active", kFlag}, Field{"instance", kFlag}};
constexpr Shape kPrim{"PrimRow", kPrimRow};
constexpr std::array kTreeFields{rows("prims", kPrim, "depth first")};
constexpr Shape kTree{"", kTreeFields};
constexpr std::array kPropertyFields{
    Field{"name", kText}, Field{"type", kText}, Field{"value", kText, false, "as layers print it"},
    Field{"authored", kFlag}, Field{"source", kText, true, "what the value comes from"}};
constexpr Shape kProperty{"Property", kPropertyFields};
constexpr std::array kInspectedFields{Field{"prim", kPath}, Field{"type", kText},
                                      list("apis", kEachText),
                                      rows("all", kProperty, "authored ones first")};
constexpr Shape kInspected{"Inspected", kInspectedFields, "explain"};
constexpr std::array kOpinionFields{Field{"file", kText, false, "null: the schema"},
                                    Field{"line", kInteger, false}, Field{"value", kText, false},
                                    Field{"verdict", kText, true, "whether it counts"},
                                    Field{"why", kText, false}};
constexpr Shape kOpinion{"Opinion", kOpinionFields, "where"};
constexpr std::array kWhereAnswer{rows("opinions", kOpinion, "the strongest one first")};
constexpr Shape kWhere{"Where", kWhereAnswer, "where"};
constexpr Shape kExplained{"", {}, "explain"};
constexpr std::array kFindingsAnswer{rows("diagnostics", kFinding)};
constexpr Shape kFindings{"", kFindingsAnswer, "check"};
constexpr std::array kMessagesAnswer{Field{"protocol", kInteger}, list("requests", kEachAny),
                                     list("notices", kEachAny)};
constexpr Shape kMessages{"", kMessagesAnswer};

constexpr std::array kRequests{
    Request{{"play", kNoFields, "Lets time go on"}, play},
    Request{{"pause", kNoFields, "Stops it"}, pause},
    Request{{"step", kStepFields, "Makes some time steps and stops"}, step_some},
    Request{{"reset", kNoFields, "Back to the start; drive targets are the asset's again"}, reset},
    Request{{"speed", kSpeedFields, "How fast time is to go on"}, set_speed},
    Request{{"setDrive", kDriveFields, "Sets a drive's target, until it is set again or reset",
             &kTarget},
            set_drive},
    Request{{"setJoint", kJointFields,
             "Moves a joint, and those that mimic it, by hand, while the simulation is paused",
             &kMoved},
            set_joint},
    Request{{"setEffort", kEffortFields,
             "Forces or torques along a joint, on top of its drives, until they are set again or "
             "reset",
             &kPushed},
            set_effort},
    Request{{"force", kForceFields,
             "A force on a body until it is set again or released; one pull for each page"},
            push},
    Request{{"drag", kDragFields,
             "A spring between a point of a body and a point in the world, for pulling by mouse"},
            drag},
    Request{{"release", kNoFields, "Ends what this page pulls"}, release},
    Request{
        {"observe", kObserveFields, "Which notices this page gets while time goes on", &kObserved},
        observe},
    Request{{"variant", kVariantFields, "Selects a variant; no file is touched"}, choose_variant},
    Request{{"engine", kEngineFields, "Simulates on another engine, from the start"}, set_engine},
    Request{{"tree", kNoFields, "All prims", &kTree}, ask_tree},
    Request{{"inspect", kPrimFields, "All that is known of a prim", &kInspected}, ask_inspect},
    Request{
        {"where", kWhereFields, "Which files have opinions on it, and which one counts", &kWhere},
        ask_where},
    Request{{"explain", kExplainFields, "Where a number comes from", &kExplained}, ask_explain},
    Request{{"findings", kNoFields, "What is wrong with the asset", &kFindings}, ask_findings},
    Request{{"set", kSetFields, "Changes a property in the file that owns it", &kEdited},
            set_property},
    Request{{"clear", kClearFields, "Removes the owning file's opinion", &kEdited}, clear_property},
    Request{{"undo", kNoFields, "Takes the last edit back"}, undo_edit},
    Request{{"redo", kNoFields, "Makes it again"}, redo_edit},
    // Those of panels follow (panel_requests.cpp).
    Request{{"messages", kNoFields, "These tables", &kMessages}, tell_messages},
};

}  // namespace

Error refused(std::string message, std::string fix) {
  return Error(ErrorCode::Invalid, std::move(message))
      .with_rule("live.refused")
      .with_fix(std::move(fix));
}

std::span<const Request> all_requests() {
  static const std::vector<Request> all = [] {
    std::vector<Request> list(kRequests.begin(), kRequests.end());
    for (const auto panels : {panel_requests(), identify_requests()}) {
      list.insert(list.end() - 1, panels.begin(), panels.end());  // `messages` comes last
    }
    return list;
  }();
  return all;
}

}  // namespace tenon::live
