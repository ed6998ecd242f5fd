// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Each scene has one simulation, whose drives are given the gains to be tried. Variables are the
// logarithms of frequency and ratio; the frequency is what is made small. Overshoot, and how far it
// is from its target from the time on at which it is to have settled, are smooth, where a settling
// time jumps. Constraints have a margin to the goal, which what is found is measured by.
#include "tenon/tuning/gain_search.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tenon/base/text/rounded_text.h"
#include "tenon/math/angle.h"
#include "tenon/tuning/optimizer.h"
#include "tenon/tuning/rig.h"

namespace tenon::tuning {
namespace {

constexpr double kSettledBand = 0.02;     // of the step
constexpr double kOvershootMargin = 0.9;  // of the goal
constexpr double kSettlingMargin = 0.95;
constexpr double kLeastRatio = 0.3;
constexpr double kMostRatio = 3;
constexpr std::size_t kTries = 40;  // of a start
constexpr double kTolerance = 0.01;
constexpr int kSoftenings = 4;          // starts from the best so far
constexpr double kWorthwhile = 0.97;    // of the frequency, for another one
constexpr double kHopeless = 100;       // of a constraint
constexpr double kNoOvershoot = 0.005;  // what a goal of 0 is measured in

/// What the steps of one drive were with one set of gains.
struct Measured {
  double overshoot = 0;
  std::optional<double> settling_time = 0;
  double late = 0;   // how far it still is, by the size of the step
  double worst = 0;  // what it misses the goal by: up to 1 it is met
  std::string worst_scene;
  std::vector<std::string> notes;
};

struct Scene {
  const SearchScene* of = nullptr;
  DriveTestOptions options;
  std::unique_ptr<TestRun> run;
  std::unique_ptr<Rig> rig;
  double done = 0;  // [s]
};

class GainSearch {
 public:
  GainSearch(const std::vector<SearchScene>& scenes, const std::vector<SearchedDrive>& drives,
             const SearchOptions& options)
      : drives_(drives), options_(options), scenes_(scenes.size()), found_(drives.size()) {
    for (std::size_t i = 0; i < scenes.size(); ++i) {
      scenes_[i].of = &scenes[i];
    }
  }

  Result<GainSearchResult> run() {
    TENON_CHECK(open_scenes());
    for (const bool again : {false, true}) {
      for (std::size_t i = 0; i < drives_.size() && !interrupted(); ++i) {
        if (!again || !found_[i].met) {
          TENON_CHECK(search_drive(i));
        }
      }
      TENON_TRY(const bool all_met, measure_all());
      if (all_met || interrupted()) {
        break;
      }
    }
    return GainSearchResult{interrupted() ? std::vector<FoundGains>{} : std::move(found_),
                            interrupted()};
  }

 private:
  double period() const { return 2.5 * options_.goal.settling + 0.1; }

  Result<void> open_scenes() {
    const double waiting = 0.5;  // [s] before a step, roughly
    planned_ = static_cast<double>(drives_.size() * kTries * scenes_.size()) * (period() + waiting);
    for (Scene& scene : scenes_) {
      scene.options.kind = TestKind::Step;
      scene.options.amplitude = options_.amplitude;
      scene.options.time_step = options_.time_step;
      scene.options.go_on = [this, at = &scene](double seconds, double) {
        at->done = seconds;
        double sum = 0;
        for (const Scene& one : scenes_) {
          sum += one.done;
        }
        return !options_.go_on || options_.go_on(std::min(sum, planned_), planned_);
      };
      const SearchScene& of = *scene.of;
      scene.run = std::make_unique<TestRun>(TestInputs{*of.scene, of.rows, of.make, scene.options},
                                            planned_);
      TENON_TRY(Rig rig, Rig::make(*of.scene, of.rows, of.make, options_.time_step));
      scene.rig = std::make_unique<Rig>(std::move(rig));
      if (!scene.rig->can_give()) {
        return Error(ErrorCode::Unsupported, of.engine + " cannot change gains while it runs")
            .with_rule("tune.search-engine")
            .with_fix("search on another engine");
      }
    }
    return {};
  }

  bool interrupted() const {
    return std::any_of(scenes_.begin(), scenes_.end(),
                       [](const Scene& scene) { return scene.run && scene.run->interrupted(); });
  }

  /// The stiffest that all time steps follow and none makes unstable [rad/s].
  double most_frequency(double ratio) const {
    double most = scene::kUnlimited;
    for (const Scene& scene : scenes_) {
      const double step = scene.rig->time_step();
      most =
          std::min({most, kUnderSampled / step,
                    stiffest_stable(stepping_of(scene.of->engine, *scene.of->scene), ratio, step)});
    }
    return most;
  }

  /// The drive has this response from now on, in all scenes.
  void give(std::size_t drive, const Response& response) {
    for (std::size_t s = 0; s < scenes_.size(); ++s) {
      const auto row = drives_[drive].rows[s];
      if (row) {
        scenes_[s].rig->give(*row, {gains_for(response, drives_[drive].load).gains,
                                    scenes_[s].rig->max_force(*row)});
      }
    }
  }

  Result<Measured> measure(std::size_t drive) {
    Measured all;
    for (std::size_t s = 0; s < scenes_.size(); ++s) {
      if (drives_[drive].rows[s] && !interrupted()) {
        TENON_CHECK(measure_in(scenes_[s], *drives_[drive].rows[s], all));
      }
    }
    return all;
  }

  Result<void> measure_in(Scene& scene, std::size_t row, Measured& all) const {
    std::vector<Way> ways;
    TENON_TRY(const auto begin, step_all(*scene.run, *scene.rig, {row}, ways, period()));
    const Signal signal = scene.rig->take_signal(0);
    if (!begin || ways[0].to == signal.position[*begin]) {
      all.overshoot = begin ? all.overshoot : kHopeless;
      all.late = kHopeless;
      all.settling_time.reset();
      worsen(all, kHopeless, scene,
             begin ? "it has nowhere to go" : "it makes the simulation unstable");
      return {};
    }
    const StepMetrics step = step_metrics(signal, *begin, ways[0].to, scene.rig->max_force(row));
    const double late = late_part(signal, *begin, ways[0].to);
    all.overshoot = std::max(all.overshoot, step.overshoot);
    all.late = std::max(all.late, late);
    all.settling_time = step.settling_time && all.settling_time
                            ? std::optional(std::max(*step.settling_time, *all.settling_time))
                            : std::nullopt;
    const StepGoal& goal = options_.goal;
    const double slow = step.settling_time ? *step.settling_time / goal.settling : kHopeless / 2;
    const double over = step.overshoot <= goal.overshoot
                            ? 0
                            : 1 + (step.overshoot - goal.overshoot) / overshoot_unit();
    std::string notes;
    for (const std::string& note :
         {saturation_note(*scene.run, row, step.saturation), speed_note(*scene.run, row, signal)}) {
      notes += (notes.empty() || note.empty() ? "" : "; ") + note;
    }
    worsen(all, std::max(over, slow), scene, notes);
    return {};
  }

  void worsen(Measured& all, double missed, const Scene& scene, const std::string& notes) const {
    if (missed <= all.worst && !all.worst_scene.empty()) {
      return;
    }
    all.worst = missed;
    all.worst_scene = scene.of->name;
    all.notes.assign(notes.empty() ? 0 : 1, notes);
  }

  double overshoot_unit() const { return std::max(options_.goal.overshoot, kNoOvershoot); }

  /// The largest distance from the target from when it is to have settled.
  double late_part(const Signal& signal, std::size_t begin, double target) const {
    const double size = std::fabs(target - signal.position[begin]);
    const double from = signal.time[begin] + kSettlingMargin * options_.goal.settling;
    double most = 0;
    for (std::size_t i = begin; i < signal.size(); ++i) {
      most = signal.time[i] >= from ? std::max(most, std::fabs(signal.position[i] - target)) : most;
    }
    return std::min(most / size, kHopeless);
  }

  Response response_at(const std::vector<double>& point) const {
    const double ratio = std::exp(point[1]);
    return {std::min(std::exp(point[0]), most_frequency(ratio)), ratio};
  }

  /// What was tried for a drive, the best of it.
  struct Best {
    Response response;
    double worst = scene::kUnlimited;
    bool met = false;
    std::size_t tries = 0;
  };

  /// First to where the goal is met, from where the form alone meets it, else from far above; from
  /// there to the softest.
  Result<void> search_drive(std::size_t drive) {
    if (options_.next_drive) {
      options_.next_drive(drive);
    }
    const double settling = options_.goal.settling;
    const double least = 1 / settling;
    const double most = std::max(most_frequency(kLeastRatio), 1.01 * least);
    Problem problem;
    problem.lower = {std::log(least), std::log(kLeastRatio)};
    problem.upper = {std::log(most), std::log(kMostRatio)};
    problem.most_tries = kTries;
    problem.tolerance = kTolerance;
    Best best;
    for (const double times : {5.0, 20.0}) {
      problem.start = {std::log(std::clamp(times / settling, least, most)),
                       std::log(ratio_of_form())};
      problem.step = {0.4, 0.2};
      if (!best.met && !interrupted()) {
        TENON_CHECK(search_from(problem, drive, Phase::Meet, best));
      }
    }
    problem.constraint_count = 2;
    problem.most_tries = kTries / 2;
    double before = scene::kUnlimited;
    for (int i = 0; i < kSoftenings && best.met && !interrupted() &&
                    best.response.frequency < kWorthwhile * before;
         ++i) {
      before = best.response.frequency;
      problem.start = {std::log(before), std::log(best.response.ratio)};
      problem.step = {0.2, 0.1};
      TENON_CHECK(search_from(problem, drive, Phase::Soften, best));
    }
    found_[drive].tries += best.tries;
    found_[drive].response = best.response;
    give(drive, best.response);
    return {};
  }

  /// The least with which the form meets the goal's overshoot.
  double ratio_of_form() const {
    const double depth = std::log(std::max(options_.goal.overshoot, 1e-4));
    return std::clamp(-depth / std::hypot(kPi, depth), 2 * kLeastRatio, 1.0);
  }

  enum class Phase : unsigned char { Meet, Soften };

  Result<void> search_from(const Problem& problem, std::size_t drive, Phase phase, Best& best) {
    std::optional<Error> failed;
    TENON_CHECK(minimize(problem, [&](const std::vector<double>& point, bool& stop) {
      const Response response = response_at(point);
      give(drive, response);
      auto measured = measure(drive);
      if (!measured || interrupted()) {
        stop = true;
        failed = measured ? failed : std::optional(measured.error());
        return Tried{kHopeless, std::vector<double>(problem.constraint_count, kHopeless)};
      }
      keep_best(response, *measured, best);
      const double over =
          (measured->overshoot - kOvershootMargin * options_.goal.overshoot) / overshoot_unit();
      const double late = measured->late / kSettledBand - 1;
      if (phase == Phase::Soften) {
        return Tried{point[0], {over, late}};
      }
      stop = best.met;
      return Tried{std::max(over, late), {}};
    }));
    if (failed) {
      return std::move(*failed);
    }
    return {};
  }

  static void keep_best(const Response& response, const Measured& measured, Best& best) {
    ++best.tries;
    const bool met = measured.worst <= 1;
    const bool better = met ? !best.met || response.frequency < best.response.frequency
                            : !best.met && measured.worst < best.worst;
    if (better) {
      best.response = response;
      best.worst = measured.worst;
      best.met = met;
    }
  }

  /// Each with the gains of all. -> whether all are met
  Result<bool> measure_all() {
    bool all_met = true;
    for (std::size_t i = 0; i < drives_.size() && !interrupted(); ++i) {
      TENON_TRY(const Measured measured, measure(i));
      FoundGains& found = found_[i];
      found.met = measured.worst <= 1;
      found.overshoot = measured.overshoot;
      found.settling_time = measured.settling_time;
      found.worst = measured.worst_scene;
      found.reasons = found.met ? std::vector<std::string>{} : measured.notes;
      const double most = most_frequency(found.response.ratio);
      if (!found.met && found.response.frequency > 0.98 * most) {
        found.reasons.push_back("stiffer than " + rounded_text(most / (2 * kPi), 3) +
                                " Hz the time step does not follow");
      }
      all_met = all_met && found.met;
    }
    return all_met;
  }

  const std::vector<SearchedDrive>& drives_;
  const SearchOptions& options_;
  std::vector<Scene> scenes_;
  std::vector<FoundGains> found_;
  double planned_ = 0;  // [s]
};

}  // namespace

Result<GainSearchResult> search_gains(const std::vector<SearchScene>& scenes,
                                      const std::vector<SearchedDrive>& drives,
                                      const SearchOptions& options) {
  return GainSearch(scenes, drives, options).run();
}

}  // namespace tenon::tuning
