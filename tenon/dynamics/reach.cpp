// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The first search begins at the given posture, so that the nearest answer is found where it is
// near; further ones begin at drawn postures. Where none reaches the targets, they are looked for
// again without limits, then in any orientation, then one by one, and the first of these that
// succeeds is named as the obstacle.
#include "tenon/dynamics/reach.h"

#include <algorithm>
#include <string>
#include <utility>

#include "tenon/base/limits/physics_limits.h"
#include "tenon/base/limits/pose_limits.h"
#include "tenon/dynamics/drawn_postures.h"
#include "tenon/dynamics/reach_run.h"

namespace tenon::dynamics {
namespace {

constexpr std::size_t kStartsOfTrials = 8;  // to find out what is in the way

Error no_reach(ErrorCode code, const std::string& message, const std::string& fix) {
  return Error(code, message).with_rule("pose.no-reach").with_fix(fix);
}

std::string path_of(const Multibody& multibody, Index body) {
  return multibody.scene().bodies[body].path.str();
}

Result<void> check_targets(const Multibody& multibody, const std::vector<ReachTarget>& targets) {
  if (targets.empty() || targets.size() > limits::kReachTargets) {
    return no_reach(ErrorCode::Limit, std::to_string(targets.size()) + " frames to place",
                    "name one to " + std::to_string(limits::kReachTargets));
  }
  const std::size_t group = multibody.group_of()[targets.front().body];
  for (const ReachTarget& target : targets) {
    if (multibody.group_of()[target.body] != group) {
      return no_reach(ErrorCode::Invalid,
                      "no joint ties " + path_of(multibody, target.body) + " to " +
                          path_of(multibody, targets.front().body),
                      "place frames of one robot at a time");
    }
    const bool is_known =
        is_finite(target.position) &&
        (!target.orientation || is_finite(dot(*target.orientation, *target.orientation)));
    if (!is_known) {
      return no_reach(ErrorCode::Invalid, "a place that is not finite", "give finite numbers");
    }
  }
  std::size_t count = 0;
  for (const Coordinate& coordinate : multibody.coordinates()) {
    count += multibody.group_of()[coordinate.body] == group ? 1U : 0U;
  }
  if (count > limits::kDenseCoordinates) {
    return no_reach(ErrorCode::Limit,
                    std::to_string(count) + " degrees of freedom; at most " +
                        std::to_string(limits::kDenseCoordinates) + " are moved",
                    "take a part of the asset");
  }
  return {};
}

/// How large the robot is: the length that weighs as much as a radian [m].
double length_of(const Multibody& multibody, const Posture& posture,
                 const std::vector<ReachTarget>& targets) {
  const std::size_t group = multibody.group_of()[targets.front().body];
  double longest = 0;
  for (const ReachTarget& target : targets) {
    const Vec3d place = (posture.bodies[target.body] * target.frame).position;
    for (const Index body : multibody.groups()[group].bodies) {
      longest = std::max(longest, length(place - posture.bodies[body].position));
    }
  }
  return std::max(longest, 1e-3);
}

/// The postures that searches begin from.
class Starts {
 public:
  Starts(const Multibody& multibody, const Posture& from, const ReachTask& task, std::uint64_t seed)
      : multibody_(multibody), from_(from), moves_(task.moves), draws_(multibody), seed_(seed) {}

  Posture at(std::size_t number) const {
    if (number == 0) {
      return from_;
    }
    const Posture drawn = draws_.draw(seed_, number);
    std::vector<std::vector<double>> joints = from_.joints;
    for (std::size_t j = 0; j < joints.size(); ++j) {
      if (moves_[j]) {
        joints[j] = drawn.joints[j];
      }
    }
    return multibody_.moved(from_, std::move(joints));
  }

 private:
  const Multibody& multibody_;
  const Posture& from_;
  const std::vector<bool>& moves_;
  DrawnPostures draws_;
  std::uint64_t seed_;
};

/// The first that reaches the targets, else the nearest; and how many searches there were.
std::pair<ReachRun, std::size_t> best_run(const ReachTask& task, const Starts& starts,
                                          std::size_t count) {
  ReachRun best;
  for (std::size_t i = 0; i < count; ++i) {
    ReachRun run = reach_from(task, starts.at(i));
    if (run.reached) {
      return {std::move(run), i + 1};
    }
    if (i == 0 || run.error < best.error) {
      best = std::move(run);
    }
  }
  return {std::move(best), count};
}

ReachObstacle obstacle_of(const ReachTask& task, const Starts& starts, std::size_t count) {
  const std::size_t tries = std::min(count, kStartsOfTrials);
  ReachTask without = task;
  without.limits = KeepLimits::No;
  if (best_run(without, starts, tries).first.reached) {
    return ReachObstacle::Limits;
  }
  without = task;
  bool turned = false;
  for (ReachTarget& target : without.targets) {
    turned = turned || target.orientation.has_value();
    target.orientation.reset();
  }
  if (turned && best_run(without, starts, tries).first.reached) {
    return ReachObstacle::Rotations;
  }
  const bool each_alone =
      task.targets.size() > 1 &&
      std::all_of(task.targets.begin(), task.targets.end(), [&](const ReachTarget& target) {
        ReachTask alone = task;
        alone.targets = {target};
        return best_run(alone, starts, tries).first.reached;
      });
  return each_alone ? ReachObstacle::Together : ReachObstacle::Distance;
}

}  // namespace

Result<Reached> reach(const Multibody& multibody, const Posture& from,
                      const std::vector<ReachTarget>& targets, const ReachOptions& options) {
  TENON_CHECK(check_targets(multibody, targets));
  ReachTask task{&multibody,       targets,       joints_of_frames(multibody, from, targets),
                 options.distance, options.angle, length_of(multibody, from, targets),
                 KeepLimits::Yes};
  for (ReachTarget& target : task.targets) {
    if (target.orientation) {
      target.orientation = normalized(*target.orientation);
    }
  }
  const std::vector<bool> carrying = task.moves;
  for (std::size_t j = 0; j < options.held.size() && j < task.moves.size(); ++j) {
    task.moves[j] = task.moves[j] && !options.held[j];
  }
  if (std::find(task.moves.begin(), task.moves.end(), true) == task.moves.end()) {
    const bool held = std::find(carrying.begin(), carrying.end(), true) != carrying.end();
    return no_reach(ErrorCode::Invalid,
                    (held ? "all joints that move " : "no joint moves ") +
                        path_of(multibody, targets.front().body) + (held ? " are held" : ""),
                    held ? "hold fewer joints" : "name a prim on a link that a joint moves");
  }
  const Starts starts(multibody, from, task, options.seed);
  const std::size_t count = std::clamp<std::size_t>(options.starts, 1, limits::kReachStarts);
  auto [run, tried] = best_run(task, starts, count);
  Reached result{
      std::move(run.posture), std::move(run.gaps), run.reached, tried, ReachObstacle::None, {}};
  result.at_limits = at_limits(multibody, result.posture, task.moves);
  if (!result.reached) {
    result.obstacle = obstacle_of(task, starts, count);
  }
  return result;
}

}  // namespace tenon::dynamics
