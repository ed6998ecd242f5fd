// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The second-order form knows one mass on one spring and damper. A step that is not by it runs
// again without all that a robot has beside these: bounds, friction, weight, contacts, joints that
// nothing drives, other drives that give way, at last with finer steps. If that run is by the form,
// these come back, first what rarely is the cause, and what cannot come back is it: the last run is
// without it, and by the form.
#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "tenon/base/limits/run_limits.h"
#include "tenon/base/text/rounded_text.h"
#include "tenon/scene/joint_forest.h"
#include "tenon/scene/joint_freedom.h"
#include "tenon/scene/start_coordinate.h"
#include "tenon/tuning/rig.h"

namespace tenon::tuning {
namespace {

struct NamedCause {
  StepCause cause;
  std::string_view name;
  std::string_view words;
};

/// In the order of the enumeration.
constexpr std::array kCauses{
    NamedCause{StepCause::TimeStep, "time-step", "the time step"},
    NamedCause{StepCause::SelfCollision, "self-collision", "self-collision"},
    NamedCause{StepCause::VelocityLimit, "velocity-limit", "velocity limits"},
    NamedCause{StepCause::JointLimits, "joint-limits", "limits of joints"},
    NamedCause{StepCause::Friction, "friction", "friction of joints"},
    NamedCause{StepCause::MaxForce, "max-force", "maxForce"},
    NamedCause{StepCause::FreeJoints, "free-joints", "joints that nothing drives"},
    NamedCause{StepCause::OtherDrives, "other-drives", "other drives that give way"},
    NamedCause{StepCause::Gravity, "gravity", "gravity"},
};

constexpr std::array kFiner{0.25, 0.0625};  // of the time step, tried one after the other
constexpr double kStiffer = 100;     // of the frequency of other drives, as far as steps follow
constexpr double kStiffestStep = 1;  // of their omega dt
constexpr std::size_t kKeptScenes = 16;

constexpr unsigned bit_of(StepCause cause) { return 1U << static_cast<unsigned>(cause); }
constexpr unsigned kRareCauses = bit_of(StepCause::SelfCollision) |
                                 bit_of(StepCause::VelocityLimit) | bit_of(StepCause::JointLimits) |
                                 bit_of(StepCause::Friction) | bit_of(StepCause::MaxForce);

bool has_cause(unsigned causes, StepCause cause) { return (causes & bit_of(cause)) != 0; }

/// Joints of trees that no drive holds in place, and that no mimic or loop ties to others.
std::vector<Index> free_joints(const scene::PhysicsScene& scene,
                               const std::vector<DriveRow>& rows) {
  const scene::JointForest forest = scene::joint_forest(scene);
  std::vector<char> tied(scene.bodies.size(), 0);  // by island
  const auto island_of = [&](const scene::Joint& joint) {
    return forest.bodies[joint.body1 ? *joint.body1 : *joint.body0].island;
  };
  for (const Index loop : forest.loop_joints) {
    tied[island_of(scene.joints[loop])] = 1;
  }
  std::vector<char> held(scene.joints.size(), 0);
  for (const DriveRow& row : rows) {
    held[row.joint] = held[row.joint] != 0 || row.position_drive() ? 1 : 0;
  }
  for (const scene::Joint& joint : scene.joints) {
    for (const scene::Mimic& mimic : joint.mimics) {
      held[mimic.leader] = 1;
    }
  }
  std::vector<Index> found;
  for (Index j = 0; j < scene.joints.size(); ++j) {
    const scene::Joint& joint = scene.joints[j];
    if (forest.joints[j] == scene::ForestRole::Tree && held[j] == 0 && joint.mimics.empty() &&
        joint.kind != scene::JointKind::Fixed && tied[island_of(joint)] == 0) {
      found.push_back(j);
    }
  }
  return found;
}

/// It stays where it is at the start.
void hold_at_start(const scene::PhysicsScene& scene, scene::Joint& joint) {
  scene::Joint held = scene::fixed_in_place_of(joint);
  held.frame0 = joint.frame0 * scene::relative_frames(scene, joint);
  joint = std::move(held);
}

scene::PhysicsScene scene_without(const scene::PhysicsScene& scene,
                                  const std::vector<DriveRow>& rows, unsigned causes) {
  scene::PhysicsScene left =
      has_cause(causes, StepCause::SelfCollision) ? without_self_collision(scene) : scene;
  if (has_cause(causes, StepCause::VelocityLimit)) {
    left = without_velocity_limits(left);
  }
  if (has_cause(causes, StepCause::Gravity)) {
    left = without_gravity(left);
  }
  if (has_cause(causes, StepCause::FreeJoints)) {
    for (const Index j : free_joints(scene, rows)) {
      hold_at_start(scene, left.joints[j]);
    }
  }
  for (scene::Joint& joint : left.joints) {
    joint.friction = has_cause(causes, StepCause::Friction) ? 0 : joint.friction;
    if (has_cause(causes, StepCause::JointLimits)) {
      joint.lower = -scene::kUnlimited;
      joint.upper = scene::kUnlimited;
      std::erase_if(joint.limits,
                    [](const scene::Limit& limit) { return limit.lower < limit.upper; });
    }
    for (scene::Drive& drive : joint.drives) {
      if (has_cause(causes, StepCause::MaxForce)) {
        drive.max_force = scene::kUnlimited;
        drive.envelope = {drive.envelope.max_velocity, 0, 0};
      }
    }
  }
  return left;
}

/// Which of them the scene has; steps of time are tried last.
unsigned causes_in(const scene::PhysicsScene& scene, const std::vector<DriveRow>& rows) {
  unsigned causes = 0;
  const auto add = [&causes](bool has, StepCause cause) { causes |= has ? bit_of(cause) : 0; };
  add(!scene.colliders.empty(), StepCause::SelfCollision);
  for (const scene::Joint& joint : scene.joints) {
    add(std::isfinite(joint.velocity_limit), StepCause::VelocityLimit);
    add(std::isfinite(joint.lower) || std::isfinite(joint.upper) || !joint.limits.empty(),
        StepCause::JointLimits);
    add(joint.friction > 0, StepCause::Friction);
    for (const scene::Drive& drive : joint.drives) {
      const scene::DriveEnvelope& envelope = drive.envelope;
      add(std::isfinite(envelope.max_velocity), StepCause::VelocityLimit);
      add(std::isfinite(drive.max_force) || envelope.speed_effort_gradient > 0 ||
              envelope.velocity_resistance > 0,
          StepCause::MaxForce);
    }
  }
  const auto drives = std::count_if(rows.begin(), rows.end(),
                                    [](const DriveRow& row) { return row.position_drive(); });
  add(drives > 1, StepCause::OtherDrives);
  add(!free_joints(scene, rows).empty(), StepCause::FreeJoints);
  for (const scene::Scene& one : scene.scenes) {
    add(length(one.gravity) > 0, StepCause::Gravity);
  }
  return causes;
}

class Causes {
 public:
  Causes(TestRun& run, double period, DriveTestResult& result)
      : run_(run), period_(period), result_(result), row_(run.in.rows[result.row]) {}

  Result<void> find() {
    if (run_.in.options.next_part) {
      run_.in.options.next_part("looking for what keeps " + joint_name() + " from its form");
    }
    away_ = causes_in(run_.in.scene, run_.in.rows);
    TENON_TRY(found_, step_without(away_));
    for (const double finer : kFiner) {
      const double count = static_cast<double>(result_.signal.size()) / finer;
      if (found_ || count >= static_cast<double>(limits::kRecordedStates)) {
        break;
      }
      away_ |= bit_of(StepCause::TimeStep);
      finer_ = finer;
      TENON_TRY(found_, step_without(away_));
    }
    if (!found_) {
      return {};
    }
    for (const unsigned causes : {kRareCauses, bit_of(StepCause::FreeJoints),
                                  bit_of(StepCause::OtherDrives), bit_of(StepCause::Gravity)}) {
      TENON_CHECK(put_back(causes));
    }
    if (run_.interrupted()) {
      return {};
    }
    for (const NamedCause& one : kCauses) {
      if (has_cause(away_, one.cause)) {
        result_.form->causes.push_back(one.cause);
      }
    }
    result_.form->without = found_;
    return {};
  }

 private:
  std::string joint_name() const { return run_.in.scene.joints[row_.joint].path.name().str(); }

  /// All of them at once where that is by the form, else each for which it is.
  Result<void> put_back(unsigned causes) {
    TENON_TRY(const bool all, come_back(causes));
    for (const NamedCause& one : kCauses) {
      if (!all && causes != bit_of(one.cause) && has_cause(causes, one.cause)) {
        TENON_CHECK(come_back(bit_of(one.cause)));
      }
    }
    return {};
  }

  /// Whether the step is by the form with these.
  Result<bool> come_back(unsigned causes) {
    if ((away_ & causes) == 0 || run_.interrupted()) {
      return true;
    }
    TENON_TRY(const auto step, step_without(away_ & ~causes));
    if (step) {
      away_ &= ~causes;
      found_ = step;
    }
    return step.has_value();
  }

  /// The step of the joint alone; none: it is not by the form.
  Result<std::optional<StepMetrics>> step_without(unsigned causes) {
    TENON_TRY(Rig * rig, rig_without(causes & ~bit_of(StepCause::OtherDrives)));
    TENON_CHECK(hold_others(*rig, has_cause(causes, StepCause::OtherDrives)));
    std::vector<Way> ways;
    TENON_TRY(const auto begin, step_all(run_, *rig, {result_.row}, ways, period_));
    if (!begin) {
      return std::optional<StepMetrics>();
    }
    const StepMetrics step =
        step_metrics(rig->take_signal(0), *begin, ways[0].to, rig->max_force(result_.row));
    return is_by_form(step, *row_.response) ? std::optional(step) : std::nullopt;
  }

  Result<Rig*> rig_without(unsigned causes) {
    double step = run_.in.options.time_step;
    if (has_cause(causes, StepCause::TimeStep)) {
      TENON_TRY(const Rig* coarse, rig_without(causes & ~bit_of(StepCause::TimeStep)));
      step = coarse->time_step() * finer_;
    }
    if (run_.reduced.size() >= kKeptScenes && !run_.reduced.contains(causes)) {
      run_.reduced.clear();
    }
    ReducedScene& kept = run_.reduced[causes];
    if (!kept.rig || kept.time_step != step) {
      kept.rig = nullptr;
      kept.time_step = step;
      kept.scene =
          std::make_unique<scene::PhysicsScene>(scene_without(run_.in.scene, run_.in.rows, causes));
      TENON_TRY(Rig rig, Rig::make(*kept.scene, run_.in.rows, run_.in.make, step));
      kept.rig = std::make_unique<Rig>(std::move(rig));
    }
    return kept.rig.get();
  }

  /// All other drives stiff, or as they are.
  Result<void> hold_others(Rig& rig, bool stiff) const {
    for (std::size_t i = 0; i < run_.in.rows.size() && rig.can_give(); ++i) {
      const DriveRow& other = run_.in.rows[i];
      if (!other.position_drive() || !other.response) {
        continue;
      }
      if (i == result_.row || !stiff) {
        rig.give_own(i);
        continue;
      }
      const double own = other.response->frequency;
      const Response held{std::clamp(kStiffestStep / rig.time_step(), own, kStiffer * own), 1};
      rig.give(i, {gains_for(held, other.load).gains, scene::kUnlimited});
    }
    return {};
  }

  TestRun& run_;
  double period_;
  DriveTestResult& result_;
  const DriveRow& row_;
  unsigned away_ = 0;
  double finer_ = kFiner.front();
  std::optional<StepMetrics> found_;
};

std::string percent_text(double part) { return rounded_text(100 * part, 3) + " %"; }

std::string cause_text(const FormMatch& form) {
  if (form.causes.empty() && form.without) {
    return "not by its form after the steps of other joints, and by it in a fresh simulation";
  }
  if (form.causes.empty()) {
    return "not by its form, whatever is taken away: a mimic or a loop moves along";
  }
  std::string text;
  for (std::size_t i = 0; i < form.causes.size(); ++i) {
    text += i == 0 ? "" : i + 1 == form.causes.size() ? " and " : ", ";
    text += kCauses[static_cast<std::size_t>(form.causes[i])].words;
  }
  return "not by its form because of " + text + ": overshoot " +
         percent_text(form.without->overshoot) + ", rise " +
         rounded_text(form.without->rise_time.value_or(0), 3) + " s without";
}

}  // namespace

std::string_view cause_name(StepCause cause) {
  return kCauses[static_cast<std::size_t>(cause)].name;
}

bool is_by_form(const StepMetrics& metrics, const Response& response) {
  const double over = overshoot_of(response.ratio);
  const double rise = rise_time_of(response);
  return std::fabs(metrics.overshoot - over) <= std::max(kOfForm * over, kOfStep) &&
         metrics.rise_time && std::fabs(*metrics.rise_time - rise) <= kOfForm * rise;
}

Result<void> judge_form(TestRun& run, double period, DriveTestResult& result) {
  const DriveRow& row = run.in.rows[result.row];
  if (!row.response || !result.step) {
    return {};
  }
  FormMatch& form = result.form.emplace();
  form.by_form = is_by_form(*result.step, *row.response);
  if (form.by_form) {
    return {};
  }
  TENON_CHECK(Causes(run, period, result).find());
  if (!run.interrupted()) {
    result.reasons.push_back(cause_text(form));
  }
  return {};
}

}  // namespace tenon::tuning
