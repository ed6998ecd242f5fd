// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The asset stays where it is and the ground is put below it, so that nothing that hangs on its
// place moves. The floor is level, the ramp descends along a level axis and ends on the floor.
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "tenon/asset/benchmarking/benchmark_run.h"
#include "tenon/base/text/rounded_text.h"
#include "tenon/dynamics/multibody.h"
#include "tenon/math/shortest_turn.h"
#include "tenon/scene/joint_freedom.h"

namespace tenon {
namespace {

using scene::Index;

constexpr double kDropTime = 10;        // [s] at most
constexpr double kFloorMargin = 0.1;    // [m] of contact and of penetration
constexpr double kDropHeights = 2;      // the fall, by the height of the asset
constexpr double kLeastFall = 0.2;      // [m]
constexpr double kRestAfter = 1;        // [s] from contact on
constexpr double kRestFor = 2;          // [s]
constexpr double kRestWithin = 8;       // [s] of contact
constexpr double kRestMotion = 0.02;    // [m]
constexpr double kRampClearance = 0.1;  // [m]
constexpr double kRampLength = 10;      // by the size of the asset
constexpr double kLeastSize = 0.1;      // [m]
constexpr double kRampMargin = 0.02;    // [m] of contact and of penetration
constexpr double kSlide = 0.01;         // [m]
constexpr double kThrown = 0.05;        // [m] from the ramp
constexpr double kThrownFor = 0.1;      // [s]
constexpr double kSlideFor = 3;         // [s]

/// What a drop is about, and how far it is.
struct Drop {
  scene::PhysicsScene scene;
  std::vector<Index> falling;
  std::string why_not;  ///< nothing falls; empty: something does
  std::unique_ptr<engines::Simulation> simulation{};
  std::vector<Pose> poses{};  ///< now (body_count)
  std::string unstable{};     ///< why; empty: it is not
  double floor = 0;           ///< height [m]

  double time() const { return simulation->time(); }
};

/// A joint that ties a tree to the world without being part of it: a distance joint, a loop. By
/// root (body_count).
std::vector<std::optional<Index>> ties_to_world(const scene::PhysicsScene& scene,
                                                const scene::JointForest& forest) {
  std::vector<std::optional<Index>> ties(scene.bodies.size());
  for (Index j = 0; j < scene.joints.size(); ++j) {
    const scene::Joint& joint = scene.joints[j];
    const auto& body = joint.body0 ? joint.body0 : joint.body1;
    const bool holds = joint.kind != scene::JointKind::D6 || !scene::is_plain(joint);
    if (joint.enabled && holds && body && joint.body0.has_value() != joint.body1.has_value()) {
      ties[forest.bodies[*body].root] = j;
    }
  }
  return ties;
}

Drop drop_of(const scene::PhysicsScene& scene) {
  Drop drop{scene, {}, "its bodies are kinematic or disabled"};
  const scene::JointForest forest = scene::joint_forest(scene);
  const auto ties = ties_to_world(scene, forest);
  std::vector<char> falls(scene.bodies.size(), 0);
  for (Index b = 0; b < scene.bodies.size(); ++b) {
    const scene::Body& body = scene.bodies[b];
    const auto& joint = ties[forest.bodies[b].root];
    drop.scene.bodies[b].starts_asleep = false;
    if (body.enabled && !body.kinematic && !forest.bodies[b].fixed && !joint) {
      drop.falling.push_back(b);
      falls[b] = 1;
    } else if (body.enabled && !body.kinematic && joint) {
      drop.why_not = "it hangs on the world by " + scene.joints[*joint].path.str();
    }
  }
  for (scene::Collider& collider : drop.scene.colliders) {
    collider.enabled = collider.enabled && collider.body && falls[*collider.body] != 0;
  }
  drop.poses = dynamics::Multibody(scene).start().bodies;
  return drop;
}

/// One in each physics scene, behind the asset's colliders, whose indices stay.
void add_ground(scene::PhysicsScene& scene, const scene::Shape& shape, const Pose& pose) {
  scene::Material& material = scene.materials.emplace_back();
  material.path = Path::from("/BenchmarkMaterial");
  material.static_friction = 0.5;
  material.dynamic_friction = 0.4;
  for (Index s = 0; s < scene.scenes.size(); ++s) {
    scene::Collider& collider = scene.colliders.emplace_back();
    collider.path = Path::from("/BenchmarkGround" + std::to_string(scene.colliders.size()));
    collider.scene = s;
    collider.shape = shape;
    collider.pose = pose;
    collider.material = static_cast<Index>(scene.materials.size() - 1);
  }
  scene.filter.groups_of_collider.resize(scene.colliders.size());
}

Result<void> begin_drop(BenchmarkRun& run, Drop& drop) {
  scene::Shape plane;
  plane.kind = scene::ShapeKind::Plane;
  const Vec3d& up = drop.scene.up;
  add_ground(drop.scene, plane, {up * drop.floor, shortest_turn({{0, 0, 1}}, up)});
  engines::SimulationOptions options;
  options.time_step = run.time_step;
  TENON_TRY(drop.simulation, run.make(drop.scene, options));
  run.planned += kDropTime;
  return {};
}

/// One step; false: the drop is over.
Result<bool> step_drop(BenchmarkRun& run, const Reach& reach, Drop& drop) {
  if (drop.time() >= kDropTime || !run.go_on()) {
    return false;
  }
  if (auto stepped = drop.simulation->step(); !stepped) {
    if (stepped.error().code() != ErrorCode::Unstable) {
      return std::move(stepped).error();
    }
    drop.unstable = stepped.error().message();
    return false;
  }
  drop.poses = poses_of(*drop.simulation, drop.scene);
  if (!std::isfinite(reach.diagonal(drop.poses))) {
    drop.unstable = "positions are no numbers after " + rounded_text(drop.time(), 3) + " s";
  }
  return drop.unstable.empty();
}

/// It went through the ground, as deep as `depth`.
void fail_depth(const Drop& drop, const Reach& reach, double depth, double most,
                BenchmarkRow& row) {
  const auto foot = [&](Index body) {
    return reach.along(body, drop.poses[body], drop.scene.up).least;
  };
  const Index lowest =
      *std::min_element(drop.falling.begin(), drop.falling.end(),
                        [&](Index first, Index second) { return foot(first) < foot(second); });
  const bool bare =
      std::none_of(drop.scene.colliders.begin(), drop.scene.colliders.end(),
                   [&](const scene::Collider& one) { return one.body == lowest && one.enabled; });
  row.prim = drop.scene.bodies[lowest].path;
  judge_row(row, "depth below the ground", depth, most, "m",
            bare ? "it falls through the ground: the body has no collider that is enabled"
                 : "it falls through the ground: its colliders do not hold it there");
}

// ---- flat ground

/// Since when the box around the asset has stayed within kRestMotion.
class Stillness {
 public:
  void look(double time, const Reach& reach, const std::vector<Pose>& poses) {
    std::array<Span, 3> now;
    double motion = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      Vec3d axis;
      axis[i] = 1;
      now[i] = reach.along(poses, axis);
      motion = std::max(
          {motion, std::fabs(now[i].least - box_[i].least), std::fabs(now[i].most - box_[i].most)});
    }
    if (!(motion <= kRestMotion)) {
      box_ = now;
      before_ = since;
      since = time;
    }
  }
  /// The time in which it last moved by kRestMotion [s].
  double last_motion() const { return since - before_; }

  double since = 0;  ///< [s]

 private:
  std::array<Span, 3> box_;
  double before_ = 0;
};

Result<void> fall_on_ground(BenchmarkRun& run, const Reach& reach, Drop& drop, BenchmarkRow& row) {
  const Span start = reach.along(drop.poses, drop.scene.up);
  drop.floor = start.least - std::max(kDropHeights * start.size(), kLeastFall);
  TENON_CHECK(begin_drop(run, drop));
  Stillness still;
  double height = start.least - drop.floor;
  double deepest = 0;
  std::optional<double> contact;
  bool rests = false;
  while (!rests && deepest <= kFloorMargin &&
         drop.time() <= contact.value_or(kDropTime) + kRestWithin) {
    TENON_TRY(const bool goes_on, step_drop(run, reach, drop));
    if (!goes_on) {
      break;
    }
    height = reach.along(drop.poses, drop.scene.up).least - drop.floor;
    deepest = std::max(deepest, -height);
    if (!contact && height <= kFloorMargin) {
      contact = drop.time();
    }
    if (contact && drop.time() >= *contact + kRestAfter) {
      still.look(drop.time(), reach, drop.poses);
      rests = drop.time() >= still.since + kRestFor;
    }
  }
  row.numbers = {{"contact", contact.value_or(std::nan(""))}, {"deepest", deepest}};
  if (deepest > kFloorMargin) {
    fail_depth(drop, reach, deepest, kFloorMargin, row);
  } else if (!contact) {
    judge_row(row, "height above the ground", height, kFloorMargin, "m",
              "it does not come down within 10 s: gravity does not act on it, or it is held");
  } else {
    judge_row(row, "rest after contact", drop.time() - *contact, kRestWithin, "s", "");
    if (!rests) {
      fail_row(row, "it does not come to rest: at the end it moves by 2 cm in " +
                        rounded_text(still.last_motion(), 3) + " s");
    }
  }
  return {};
}

// ---- the ramp

struct Ramp {
  Vec3d downhill;  ///< level
  Vec3d normal;
  double surface = 0;  ///< along `normal` [m]
  Span level;          ///< along `downhill` [m]
};

Ramp add_ramp(const Reach& reach, Drop& drop) {
  const Quatd frame = shortest_turn({{0, 0, 1}}, drop.scene.up);
  const std::array<Vec3d, 3> axes{rotate(frame, {{1, 0, 0}}), rotate(frame, {{0, 1, 0}}),
                                  drop.scene.up};
  std::array<Span, 3> spans;
  double size = kLeastSize;
  for (std::size_t i = 0; i < 3; ++i) {
    spans[i] = reach.along(drop.poses, axes[i]);
    size = std::max(size, spans[i].size());
  }
  const double half = kRampLength * size / 2;
  Ramp ramp{axes[1], (axes[1] + axes[2]) * std::sqrt(0.5), 0, {}};
  // The asset is above its upper end, clear of the highest point below.
  ramp.level.least = spans[1].least - size / 4;
  ramp.level.most = ramp.level.least + 2 * half * std::sqrt(0.5);
  const double rise = ramp.level.middle() - spans[1].least;
  const double height = spans[2].least - kRampClearance - rise;  // of the middle of the ramp
  const Vec3d middle =
      axes[0] * spans[0].middle() + axes[1] * ramp.level.middle() + axes[2] * height;
  ramp.surface = dot(ramp.normal, middle);
  drop.floor = height - ramp.level.size() / 2;
  scene::Shape box;
  box.half_extents = {{2 * half, half, size / 2}};
  add_ground(
      drop.scene, box,
      {middle - ramp.normal * (size / 2), frame * rotation_about({{1, 0, 0}}, -std::atan(1.0))});
  return ramp;
}

/// What a drop on the ramp has come to.
struct Slide {
  bool contact = false;
  double way = 0;               ///< downhill [m]
  double below = 0;             ///< the ramp [m]
  double sunk = 0;              ///< below the floor [m]
  double apart = 0;             ///< the box around it, from the ramp [m]
  double thrown = 0;            ///< for so long [s]
  std::optional<double> since;  ///< it slides [s]

  bool failed() const { return below > kRampMargin || sunk > kFloorMargin || thrown >= kThrownFor; }
};

void look_at_slide(const Ramp& ramp, const Reach& reach, const Drop& drop, double time_step,
                   double start, Slide& slide) {
  const Span gap = reach.along(drop.poses, ramp.normal);
  const Span level = reach.along(drop.poses, ramp.downhill);
  const bool above = level.least >= ramp.level.least && level.most <= ramp.level.most;
  slide.below = above ? ramp.surface - gap.most : 0;
  slide.contact =
      slide.contact || (above && gap.least - ramp.surface <= kRampMargin && !slide.failed());
  if (!slide.contact) {
    return;
  }
  slide.way = level.middle() - start;
  const double foot = reach.along(drop.poses, drop.scene.up).least;
  slide.apart = (level.least + foot) * std::sqrt(0.5) - ramp.surface;
  slide.thrown = above && slide.apart > kThrown ? slide.thrown + time_step : 0;
  if (slide.way >= kSlide && !slide.since) {
    slide.since = drop.time();
  }
  if (slide.since) {
    slide.sunk = drop.floor - foot;
  }
}

Result<void> slide_down(BenchmarkRun& run, const Reach& reach, Drop& drop, BenchmarkRow& row) {
  const Ramp ramp = add_ramp(reach, drop);
  const double start = reach.along(drop.poses, ramp.downhill).middle();
  TENON_CHECK(begin_drop(run, drop));
  Slide slide;
  bool goes_on = true;
  while (goes_on && !slide.failed() && drop.time() < slide.since.value_or(kDropTime) + kSlideFor) {
    TENON_TRY(goes_on, step_drop(run, reach, drop));
    look_at_slide(ramp, reach, drop, run.time_step, start, slide);
  }
  row.numbers = {{"slides", slide.since.value_or(std::nan(""))}, {"belowFloor", slide.sunk}};
  if (slide.below > kRampMargin) {
    fail_depth(drop, reach, slide.below, kRampMargin, row);
  } else if (slide.sunk > kFloorMargin) {
    fail_depth(drop, reach, slide.sunk, kFloorMargin, row);
  } else if (slide.thrown >= kThrownFor) {
    judge_row(row, "distance from the ramp", slide.apart, kThrown, "m",
              "it leaves the ramp for 0.1 s: it bounces, or contacts throw it");
  } else {
    judge_row(row, "way down the ramp", slide.way, slide.way, "m", "");
    row.threshold = kSlide;  // at least
    if (!slide.since) {
      fail_row(row, slide.contact
                        ? "it does not slide down: its friction with 0.5 holds it at 45 degrees"
                        : "it does not come to the ramp");
    }
  }
  return {};
}

}  // namespace

Result<BenchmarkResult> run_drop(BenchmarkRun& run, BenchmarkTest test) {
  Drop drop = drop_of(run.scene);
  if (drop.falling.empty()) {
    return skipped_test(test, drop.why_not);
  }
  const Reach reach(drop.scene, drop.falling);
  BenchmarkRow row;
  TENON_CHECK(test == BenchmarkTest::GroundDrop ? fall_on_ground(run, reach, drop, row)
                                                : slide_down(run, reach, drop, row));
  if (!drop.unstable.empty()) {
    fail_row(row, drop.unstable);
  }
  return test_result(test, {std::move(row)});
}

}  // namespace tenon
