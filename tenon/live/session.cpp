// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Real time is a debt of simulated time that steps pay. What cannot be paid within one call is
// forgiven, so that a slow model runs late instead of ever further behind. Everything that changes
// what there is to see ends in set_asset() or begin_model(), which tell everyone.
#include "tenon/live/session.h"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <utility>

#include "tenon/answers/diagnostic_json.h"
#include "tenon/answers/or_null.h"
#include "tenon/answers/variants_json.h"
#include "tenon/base/text/shown_path.h"
#include "tenon/live/session_state.h"
#include "tenon/make_simulation.h"
#include "tenon/watches/report_faults.h"

namespace tenon::live {
namespace {

using LiveClock = std::chrono::steady_clock;

constexpr double kStepSeconds = 0.03;  // of real time that one call may step
constexpr double kMostOwed = 0.1;      // [s] that a pause of the machine may be made up for
constexpr double kRateWindow = 0.5;    // [s]
constexpr std::size_t kMostContacts = 1000;
constexpr std::size_t kMostBodies = 256;  // whose velocities are told
constexpr std::size_t kMostEvents = 50;
constexpr int kLooksBeforeTold = 4;  // a fault that is there for a second is no passing one

Json engines_json() {
  Json rows = Json::array();
  for (const engines::EngineInfo& info : list_engines()) {
    rows.push_back({{"name", info.name},
                    {"available", info.available},
                    {"howToGet", answers::or_null(info.how_to_get)}});
  }
  return rows;
}

Json paths_of_bodies(const scene::PhysicsScene& scene) {
  Json rows = Json::array();
  for (const scene::Body& body : scene.bodies) {
    rows.push_back(body.path.str());
  }
  return rows;
}

Json opening_json(const Diagnostics& opening) {
  constexpr std::size_t kMost = 50;
  Json rows = Json::array();
  for (const Diagnostic& finding : opening) {
    if (rows.size() < kMost) {
      rows.push_back(answers::diagnostic_json(finding));
    }
  }
  return rows;
}

Json events_json(const LiveAsset& asset) {
  Json rows = Json::array();
  for (std::size_t i = 0; asset.world && i < asset.world->events().size(); ++i) {
    const engines::Event& event = asset.world->events()[i];
    if (i < kMostEvents) {
      rows.push_back({{"time", event.time}, {"prim", event.prim.str()}, {"what", event.what}});
    }
  }
  return rows;
}

Json finding_or_null(const std::optional<Diagnostic>& finding) {
  return finding ? answers::diagnostic_json(*finding) : Json(nullptr);
}

template <class List>
Result<scene::Index> index_of(const List& list, Path path, const char* what) {
  const auto found =
      std::find_if(list.begin(), list.end(), [&](const auto& one) { return one.path == path; });
  if (found == list.end()) {
    return Error(ErrorCode::NotFound, "there is no " + std::string(what) + " <" + path.str() + ">")
        .with_rule("live.not-found")
        .with_prim(path.str());
  }
  return static_cast<scene::Index>(found - list.begin());
}

}  // namespace

bool Session::State::Timer::due(double seconds) {
  passed += seconds;
  if (passed < period) {
    return false;
  }
  passed = 0;
  return true;
}

// ---- messages to pages

void Session::State::tell(ClientNumber to, const Json& message, Outbox& out) const {
  out.messages.push_back({to, answers::on_one_line(message)});
}

void Session::State::tell_answer(ClientNumber to, const std::string& request, const Json& id,
                                 Result<Json> result, Outbox& out) const {
  Json answer = {{"is", result ? "answer" : "error"}, {"to", request}, {"id", id}};
  if (result) {
    answer["result"] = *std::move(result);
  } else {
    answer["error"] = answers::diagnostic_json(result.error().diagnostic());
  }
  tell(to, answer, out);
}

void Session::State::tell_problem(const Diagnostic& finding, Outbox& out) const {
  tell(0, {{"is", "problem"}, {"problem", answers::diagnostic_json(finding)}}, out);
}

Json Session::State::scene_notice(const char* why) const {
  return {{"is", "scene"},
          {"revision", revision},
          {"why", why},
          {"engine", asset.engine},
          {"engines", engines_json()},
          {"simulates", asset.world.has_value()},
          {"problem", finding_or_null(asset.problem)},
          {"opening", opening_json(asset.opening)},
          {"timeStep", asset.world ? Json(asset.world->time_step()) : Json(nullptr)},
          {"variants", answers::variants_json(*asset.stage, "")},
          {"bodies", paths_of_bodies(asset.scene())},
          {"joints", joints_json(asset)},
          {"canUndo", history.can_undo()},
          {"canRedo", history.can_redo()}};
}

Json Session::State::targets_json() const {
  Json rows = Json::array();
  for (const scene::Joint& joint : asset.scene().joints) {
    Json row = Json::array();
    for (scene::Index drive = 0; drive < joint.drives.size(); ++drive) {
      const auto known = targets.find(std::make_pair(joint.path, drive));
      const scene::Drive& own = joint.drives[drive];
      const auto target = known == targets.end()
                              ? engines::DriveTarget{own.target_position, own.target_velocity}
                              : known->second;
      row.push_back({target.position, target.velocity});
    }
    rows.push_back(std::move(row));
  }
  for (const scene::ScalarTrack& track : asset.scene().scalar_tracks) {
    const Path joint = asset.scene().joints[track.joint].path;
    const bool is_position = track.what == scene::Animated::DriveTargetPosition;
    const bool is_target = is_position || track.what == scene::Animated::DriveTargetVelocity;
    if (is_target && asset.world && !targets.contains(std::make_pair(joint, track.drive))) {
      rows[track.joint][track.drive][is_position ? 0 : 1] = track.at(asset.world->time());
    }
  }
  return rows;
}

Json Session::State::state_notice() const {
  return {{"is", "state"},
          {"playing", playing},
          {"time", asset.world ? asset.world->time() : 0.0},
          {"speed", speed},
          {"rate", playing ? rate : 0.0},
          {"contacts", asset.world ? asset.world->contact_count() : 0},
          {"pulled", pulls.count()},
          {"events", events_json(asset)},
          {"stopped", finding_or_null(stopped)},
          {"outdated", finding_or_null(outdated)}};
}

void Session::State::tell_observers(Outbox& out) const {
  const auto wanted = [&](bool Client::* what) {
    return asset.world && !stopped &&
           std::any_of(clients.begin(), clients.end(),
                       [what](const auto& client) { return client.second.*what; });
  };
  const auto tell_each = [&](bool Client::* what, const Json& message) {
    const std::string text = answers::on_one_line(message);
    for (const auto& [number, client] : clients) {
      if (client.*what) {
        out.messages.push_back({number, text});
      }
    }
  };
  if (wanted(&Client::plots)) {
    const engines::Energy energy = asset.world->energy();
    tell_each(&Client::plots, {{"is", "plots"},
                               {"time", asset.world->time()},
                               {"joints", positions_json(asset)},
                               {"velocities", velocities_json(asset)},
                               {"efforts", efforts_json(asset)},
                               {"targets", targets_json()},
                               {"bodies", body_velocities_json(asset, kMostBodies)},
                               {"kinetic", energy.kinetic},
                               {"potential", energy.potential}});
  }
  if (wanted(&Client::contacts)) {
    tell_each(&Client::contacts, {{"is", "contacts"},
                                  {"time", asset.world->time()},
                                  {"count", asset.world->contact_count()},
                                  {"rows", contacts_json(asset, kMostContacts)}});
  }
}

void Session::State::frame_due(Outbox& out) {
  if (!stopped) {
    frame = pose_frame(asset);
  }
  out.frame = frame;
  moved = false;
}

void Session::State::tell_found(Work& work, Outbox& out) const {
  for (const Json& notice : work.take_found()) {
    tell(work.client(), notice, out);
  }
}

void Session::State::tell_works(Outbox& out) {
  for (const std::shared_ptr<Work>& work : works) {
    tell_found(*work, out);
    if (const Json progress = work->take_progress(); progress.is_object() && !work->is_over()) {
      tell(work->client(), progress, out);
    }
  }
  std::erase_if(works, [](const auto& work) { return work->is_over(); });
}

// ---- what requests do

Result<std::shared_ptr<Work>> Session::State::begin_work(ClientNumber client, const char* request) {
  std::erase_if(works, [](const auto& work) { return work->is_over(); });
  for (const std::shared_ptr<Work>& work : works) {
    if (work->client() == client) {
      return Error(ErrorCode::Limit, "`" + work->request() + "` of this page goes on")
          .with_rule("live.busy")
          .with_fix("wait for it, or end it by the request `cancel`");
    }
  }
  later_work = std::make_shared<Work>(client, request);
  works.push_back(later_work);
  return later_work;
}

Result<void> Session::State::set_gains(scene::Index joint, scene::Dof dof,
                                       const tuning::Gains& wanted) {
  TENON_TRY(engines::World * model, world());
  const std::vector<scene::Drive>& drives = asset.scene().joints[joint].drives;
  for (scene::Index i = 0; i < drives.size(); ++i) {
    if (drives[i].dof == dof) {
      using engines::Parameter;
      TENON_CHECK(model->set_parameter({Parameter::DriveStiffness, joint, i}, wanted.stiffness));
      return model->set_parameter({Parameter::DriveDamping, joint, i}, wanted.damping);
    }
  }
  return refused("the joint has no drive along " + std::string(scene::dof_name(dof)),
                 "name one that it has");
}

Result<engines::World*> Session::State::world() {
  if (!asset.world) {
    const std::string why = asset.problem ? asset.problem->message : "there is no engine";
    return Error(ErrorCode::Invalid, "nothing is simulated: " + why)
        .with_rule("live.no-model")
        .with_fix(asset.problem ? asset.problem->fix : "");
  }
  return &*asset.world;
}

Result<scene::Index> Session::State::joint(Path path) const {
  return index_of(asset.scene().joints, path, "joint");
}

Result<scene::Index> Session::State::body(Path path) const {
  return index_of(asset.scene().bodies, path, "body");
}

void Session::State::begin_model() {
  stopped.reset();
  pulls.begin(asset.scene());
  owed = 0;
  rate = 0;
  window_wall = 0;
  window_simulated = 0;
  playing = playing && asset.world.has_value();
  for (auto known = targets.begin(); known != targets.end();) {
    const auto [path, drive] = known->first;
    const auto index = joint(path);
    const bool is_set = index && asset.world &&
                        asset.world->set_drive_target(*index, drive, known->second).has_value();
    known = is_set || !asset.world ? std::next(known) : targets.erase(known);
  }
  for (auto known = gains.begin(); asset.world && known != gains.end();) {
    const auto index = joint(known->first.first);
    const bool is_set = index && set_gains(*index, known->first.second, known->second).has_value();
    known = is_set ? std::next(known) : gains.erase(known);
  }
  told_faults.clear();
  watch_run(targets.empty() ? watches::Steering::None : watches::Steering::Commands);
}

void Session::State::act() {
  if (watches && watches->steering() == watches::Steering::None) {
    watch_run(watches::Steering::Commands);
  }
}

void Session::State::watch_run(watches::Steering steering) {
  seen_faults.clear();
  watches.reset();
  if (asset.world) {
    watches.emplace(asset.world->simulation(), asset.scene(), steering);
  }
}

void Session::State::tell_faults(Outbox& out) {
  if (!watches || stopped) {
    return;
  }
  Diagnostics found;
  watches::report_faults(asset.scene(), watches->faults(), asset.world->events(), found);
  std::map<std::string, int> seen;
  for (const Diagnostic& finding : found) {
    const int looks = seen[finding.rule] = seen_faults[finding.rule] + 1;
    if (finding.severity == Severity::Warning && looks >= kLooksBeforeTold &&
        told_faults.insert(finding.rule).second) {
      tell_problem(finding, out);
    }
  }
  seen_faults = std::move(seen);
}

void Session::State::set_asset(LiveAsset opened, const char* why, Outbox& out) {
  watches.reset();  // they refer to the world, and it to the scene, that goes
  asset.world.reset();
  asset = std::move(opened);
  drive_rows.reset();
  outdated.reset();
  ++revision;
  begin_watching();
  out.picture = asset.picture;
  begin_again(why, out);
}

void Session::State::begin_watching() {
  const bytes::ReadRecord* record = bytes::ReadRecord::current();
  std::vector<std::string> paths = record == nullptr ? std::vector<std::string>() : record->paths();
  if (record != nullptr) {  // what was not there may come
    std::ranges::copy(record->missing(), std::back_inserter(paths));
  }
  paths.push_back(options.asset.path);
  watch.begin(paths);
  if (record != nullptr && !record->check_unchanged({})) {
    watch.doubt();
  }
}

Result<void> Session::State::reopen(LiveAssetOptions changed, const char* why, Outbox& out) {
  if (bytes::ReadRecord* record = bytes::ReadRecord::current()) {
    record->clear();  // what follows is read again
  }
  auto opened = open_live_asset(changed);
  if (!opened) {
    return opened.error();
  }
  options.asset = std::move(changed);
  set_asset(*std::move(opened), why, out);
  return {};
}

void Session::State::restart(const std::string& engine, const char* why, Outbox& out) {
  watches.reset();  // they refer to the world that goes
  make_live_world(options.asset, engine, asset);
  begin_again(why, out);
}

void Session::State::begin_again(const char* why, Outbox& out) {
  begin_model();
  tell(0, scene_notice(why), out);
  tell(0, state_notice(), out);
  frame_due(out);
}

Result<void> Session::State::check_not_stopped() const {
  if (!stopped) {
    return {};
  }
  return Error(ErrorCode::Invalid, stopped->message)
      .with_rule("live.stopped")
      .with_prim(stopped->prim)
      .with_fix("reset, then change the asset, the engine or the time step");
}

Result<void> Session::State::step(Outbox& out) {
  TENON_TRY(engines::World * model, world());
  TENON_CHECK(check_not_stopped());
  TENON_CHECK(pulls.apply(*model, asset.scene()));
  moved = true;
  if (auto done = model->step(); !done) {
    playing = false;
    moved = false;  // its poses are of no use
    stopped = done.error().diagnostic();
    tell_problem(done.error().diagnostic(), out);
    tell(0, state_notice(), out);
    return done;
  }
  watches->after_step();
  return {};
}

// ---- time

void Session::State::take_steps(double seconds, Outbox& out) {
  const double dt = asset.world->time_step();
  owed = std::min(owed + seconds * speed, std::max(kMostOwed * speed, dt));
  const auto begin = LiveClock::now();
  const double before = asset.world->time();
  while (playing && owed >= dt) {
    if (!step(out)) {
      break;
    }
    owed -= dt;
    if (std::chrono::duration<double>(LiveClock::now() - begin).count() > kStepSeconds) {
      owed = std::min(owed, dt);  // the machine is too slow for it
    }
  }
  window_wall += seconds;
  window_simulated += asset.world->time() - before;
  if (window_wall >= kRateWindow) {
    rate = window_simulated / window_wall;
    window_wall = 0;
    window_simulated = 0;
  }
}

void Session::State::advance(double seconds, Outbox& out) {
  if (playing && asset.world) {
    take_steps(seconds, out);
  }
  if (moved) {
    frame_due(out);
  }
  if (state_timer.due(seconds) && playing) {
    tell(0, state_notice(), out);
    tell_faults(out);
  }
  if (observer_timer.due(seconds) && playing) {
    tell_observers(out);
  }
  if (work_timer.due(seconds)) {
    tell_works(out);
  }
}

// ---- the session

std::span<const MessageInfo> requests() {
  static const std::vector<MessageInfo> known = [] {
    std::vector<MessageInfo> list;
    for (const Request& request : all_requests()) {
      list.push_back(request.info);
    }
    return list;
  }();
  return known;
}

Session::Session(std::unique_ptr<State> state) : state_(std::move(state)) {}
Session::Session(Session&&) noexcept = default;
Session& Session::operator=(Session&&) noexcept = default;
Session::~Session() = default;

Result<Session> Session::open(SessionOptions options) {
  auto state = std::make_unique<State>();
  if (bytes::ReadRecord* record = bytes::ReadRecord::current()) {
    record->clear();  // what is noted from here on is the asset
  }
  TENON_TRY(state->asset, open_live_asset(options.asset));
  state->options = std::move(options);
  state->begin_model();
  state->begin_watching();
  return Session(std::move(state));
}

const LiveAsset& Session::asset() const { return state_->asset; }
bool Session::is_playing() const { return state_->playing; }

void Session::greet(ClientNumber client, Outbox& out) {
  state_->clients[client];
  state_->tell(client,
               {{"is", "hello"},
                {"protocol", kProtocol},
                {"version", state_->options.version},
                {"client", client},
                {"asset", shown_path(state_->options.asset.path)},
                {"readOnly", !state_->options.write}},
               out);
  state_->tell(client, state_->scene_notice("open"), out);
  state_->tell(client, state_->state_notice(), out);
  state_->frame_due(out);
}

void Session::forget(ClientNumber client) {
  state_->clients.erase(client);
  for (const std::shared_ptr<Work>& work : state_->works) {
    if (work->client() == client) {
      work->end();
    }
  }
  state_->pulls.release(client);
}

void Session::end_works() {
  for (const std::shared_ptr<Work>& work : state_->works) {
    work->end();
  }
}

void Session::hear(ClientNumber client, std::string_view text, Outbox& out) {
  Asked asked;
  const auto index = Listener(requests()).read(text, asked);
  Result<Json> result =
      index ? all_requests()[*index].handle(*state_, client, asked, out) : index.error();
  if (state_->moved) {
    state_->frame_due(out);
  }
  if (result && state_->later) {
    out.late.push_back({client, asked.name(), asked.id(), std::exchange(state_->later, {}),
                        std::exchange(state_->later_work, {}),
                        std::exchange(state_->later_is_outside, false)});
  } else {
    if (state_->later_work) {
      std::exchange(state_->later_work, {})->finish();
    }
    state_->tell_answer(client, asked.name(), asked.id(), std::move(result), out);
  }
}

void Session::answer_late(const LateAnswer& late, Result<Json> result, Outbox& out) const {
  if (late.work) {
    late.work->finish();
  }
  if (state_->clients.contains(late.client)) {
    if (late.work) {
      state_->tell_found(*late.work, out);
    }
    state_->tell_answer(late.client, late.request, late.id, std::move(result), out);
  }
}

void Session::advance(double seconds, Outbox& out) { state_->advance(seconds, out); }

void Session::look_at_files(Outbox& out) {
  if (!state_->options.watch || !state_->watch.look()) {
    return;
  }
  if (auto opened = state_->reopen(state_->options.asset, "file", out); !opened) {
    state_->outdated = opened.error().diagnostic();
    state_->tell_problem(*state_->outdated, out);
    state_->tell(0, state_->state_notice(), out);
  }
}

}  // namespace tenon::live
