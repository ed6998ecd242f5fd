// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tenon/asset/edit_asset.h"
#include "tenon/live/file_watch.h"
#include "tenon/live/pulls.h"
#include "tenon/live/session.h"
#include "tenon/tuning/gains.h"
#include "tenon/watches/run_watches.h"

/// What a session knows. Internal to tenon/live: requests change it, session.cpp lets time pass.
namespace tenon::live {

class Session::State {
 public:
  SessionOptions options;
  LiveAsset asset;
  EditHistory history;
  FileWatch watch;
  Pulls pulls;

  struct Client {
    bool contacts = false;  ///< observes them
    bool plots = false;
  };
  std::map<ClientNumber, Client> clients;

  bool playing = false;
  double speed = 1;
  double owed = 0;             ///< [s] of simulation that real time is ahead
  double rate = 0;             ///< of simulated to wanted time, lately
  std::uint32_t revision = 1;  ///< of the picture
  bool moved = false;          ///< since the last frame
  /// A step that failed, usually because the simulation became unstable. Until the model begins
  /// again no step is made and `frame`, the last one before, stays.
  std::optional<Diagnostic> stopped;
  std::string frame;  ///< the last one that was told
  /// Why a changed file could not be opened; what is shown is older than the files.
  std::optional<Diagnostic> outdated;
  /// Of the run since the model began, or since somebody acted on it; none: there is no model.
  std::optional<watches::RunWatches> watches;
  std::map<std::string, int> seen_faults;  ///< by rule: at how many looks in a row it was there
  std::set<std::string> told_faults;       ///< rules that were told of this model
  /// Set by a request whose answer is made later, elsewhere.
  Function<Result<Json>()> later;
  std::shared_ptr<Work> later_work;          ///< of it; null: it tells nothing meanwhile
  bool later_is_outside = false;             ///< another program makes it
  std::vector<std::shared_ptr<Work>> works;  ///< that are not over
  /// Drive targets that were set, by joint and drive: they are set again on a new model.
  std::map<std::pair<Path, scene::Index>, engines::DriveTarget> targets;
  /// Gains that were set, of a degree of freedom of a joint, likewise, until they are saved.
  std::map<std::pair<Path, scene::Dof>, tuning::Gains> gains;
  std::shared_ptr<FoundLayer> found_layer = std::make_shared<FoundLayer>();
  /// Drives of the scene as they are at its start; none: nobody has asked yet.
  std::optional<std::vector<tuning::DriveRow>> drive_rows;

  /// Now and then, in real time.
  struct Timer {
    double period = 1;
    double passed = 0;
    bool due(double seconds);
  };
  Timer state_timer{0.25};
  Timer observer_timer{0.05};
  Timer work_timer{0.1};
  double window_wall = 0;  // [s] of the window over which the rate is measured
  double window_simulated = 0;

  // ---- what requests do

  /// Opens the asset again with `changed` options; where that fails everything stays as it is.
  Result<void> reopen(LiveAssetOptions changed, const char* why, Outbox& out);
  /// Rebuilds the model of the asset as it is.
  void restart(const std::string& engine, const char* why, Outbox& out);
  /// Tells everyone that the model begins at its start.
  void begin_again(const char* why, Outbox& out);
  /// The model, where there is one. Errors: Invalid (live.no-model), with the reason.
  Result<engines::World*> world();
  Result<scene::Index> joint(Path path) const;
  Result<scene::Index> body(Path path) const;
  /// Errors: Invalid (live.stopped) after a step that failed.
  Result<void> check_not_stopped() const;
  /// Somebody acts on the run: it is watched for less from here on.
  void act();
  /// A long request of a client begins, for `later`. Errors: Limit (live.busy) while another one of
  /// the same client goes on.
  Result<std::shared_ptr<Work>> begin_work(ClientNumber client, const char* request);
  /// The drive of a joint that moves this degree of freedom, in the model as it runs.
  Result<void> set_gains(scene::Index joint, scene::Dof dof, const tuning::Gains& wanted);
  /// One step, with what pulls; one that fails stops the time until the model begins again.
  Result<void> step(Outbox& out);

  // ---- messages to pages

  Json scene_notice(const char* why) const;
  Json state_notice() const;
  Json targets_json() const;
  void tell(ClientNumber to, const Json& message, Outbox& out) const;
  void tell_answer(ClientNumber to, const std::string& request, const Json& id, Result<Json> result,
                   Outbox& out) const;
  void tell_problem(const Diagnostic& finding, Outbox& out) const;
  void tell_observers(Outbox& out) const;
  /// What works have found and how far they are, to those who asked.
  void tell_works(Outbox& out);
  void tell_found(Work& work, Outbox& out) const;
  void frame_due(Outbox& out);

  // ---- time

  void advance(double seconds, Outbox& out);
  void begin_watching();
  void begin_model();

 private:
  void set_asset(LiveAsset opened, const char* why, Outbox& out);
  void watch_run(watches::Steering steering);
  void take_steps(double seconds, Outbox& out);
  void tell_faults(Outbox& out);
};

/// Json for what was asked for.
using Handler = Result<Json> (*)(Session::State& state, ClientNumber client, const Asked& asked,
                                 Outbox& out);

/// A request and what it does.
struct Request {
  MessageInfo info;
  Handler handle = nullptr;
};

/// The truth about requests (requests.cpp), which has those of panels from panel_requests.cpp and
/// identify_requests.cpp.
std::span<const Request> all_requests();
std::span<const Request> panel_requests();
std::span<const Request> identify_requests();

/// live.refused, with what to do instead.
Error refused(std::string message, std::string fix);

// ---- edits (editing.cpp)
/// The variants that the session shows are those in which an edit has to count.
EditOptions edit_options(const Session::State& state);
/// What follows is read again, so that a commit compares with what is there now.
void read_anew();
/// Whether edits that have no effect on what engines receive are refused.
enum class MayRest : bool { No, Yes };
/// Makes edits as one step of the history, or tells with `dry_run` what they would do. Errors:
/// Unsupported (live.read-only), Invalid (live.nothing-to-write, edit.no-effect), those of
/// edit_asset and of writing.
Result<Json> make_edits(Session::State& state, const std::vector<AssetEdit>& edits,
                        const EditOptions& options, MayRest may_rest, bool dry_run, Outbox& out);
/// The same of files that were made otherwise.
Result<Json> write_made(Session::State& state, const std::vector<AssetEdit>& edits,
                        const EditedAsset& made, bool dry_run, Outbox& out);

// ---- requests that ask (asking.cpp) and edit (editing.cpp)
Result<Json> ask_tree(Session::State& state, ClientNumber client, const Asked& asked, Outbox& out);
Result<Json> ask_inspect(Session::State& state, ClientNumber client, const Asked& asked,
                         Outbox& out);
Result<Json> ask_where(Session::State& state, ClientNumber client, const Asked& asked, Outbox& out);
Result<Json> ask_explain(Session::State& state, ClientNumber client, const Asked& asked,
                         Outbox& out);
Result<Json> ask_findings(Session::State& state, ClientNumber client, const Asked& asked,
                          Outbox& out);
Result<Json> set_property(Session::State& state, ClientNumber client, const Asked& asked,
                          Outbox& out);
Result<Json> clear_property(Session::State& state, ClientNumber client, const Asked& asked,
                            Outbox& out);
Result<Json> undo_edit(Session::State& state, ClientNumber client, const Asked& asked, Outbox& out);
Result<Json> redo_edit(Session::State& state, ClientNumber client, const Asked& asked, Outbox& out);

// ---- of panels: that ask and steer (panel_answers.cpp), and edit (panel_edits.cpp)
Result<Json> ask_pairs(Session::State& state, ClientNumber client, const Asked& asked, Outbox& out);
Result<Json> ask_drives(Session::State& state, ClientNumber client, const Asked& asked,
                        Outbox& out);
Result<Json> ask_gains(Session::State& state, ClientNumber client, const Asked& asked, Outbox& out);
Result<Json> ask_poses(Session::State& state, ClientNumber client, const Asked& asked, Outbox& out);
Result<Json> set_live_gains(Session::State& state, ClientNumber client, const Asked& asked,
                            Outbox& out);
Result<Json> forget_gains(Session::State& state, ClientNumber client, const Asked& asked,
                          Outbox& out);
Result<Json> test_live_drives(Session::State& state, ClientNumber client, const Asked& asked,
                              Outbox& out);
Result<Json> cancel_work(Session::State& state, ClientNumber client, const Asked& asked,
                         Outbox& out);
Result<Json> go_to_pose(Session::State& state, ClientNumber client, const Asked& asked,
                        Outbox& out);
Result<Json> filter_pairs(Session::State& state, ClientNumber client, const Asked& asked,
                          Outbox& out);
Result<Json> set_limits(Session::State& state, ClientNumber client, const Asked& asked,
                        Outbox& out);
Result<Json> save_gains(Session::State& state, ClientNumber client, const Asked& asked,
                        Outbox& out);
Result<Json> save_pose(Session::State& state, ClientNumber client, const Asked& asked, Outbox& out);
Result<Json> rename_pose(Session::State& state, ClientNumber client, const Asked& asked,
                         Outbox& out);
Result<Json> remove_pose(Session::State& state, ClientNumber client, const Asked& asked,
                         Outbox& out);
Result<Json> import_poses(Session::State& state, ClientNumber client, const Asked& asked,
                          Outbox& out);
Result<Json> apply_fixes(Session::State& state, ClientNumber client, const Asked& asked,
                         Outbox& out);

// ---- of the panel "Identify" (identifying.cpp)
Result<Json> tell_identify_logs(Session::State& state, ClientNumber client, const Asked& asked,
                                Outbox& out);
Result<Json> identify(Session::State& state, ClientNumber client, const Asked& asked, Outbox& out);
Result<Json> write_identified(Session::State& state, ClientNumber client, const Asked& asked,
                              Outbox& out);

}  // namespace tenon::live
