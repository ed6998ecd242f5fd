// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A metric is a function from one frame of a motion to numbers, of one object or of all together;
// two of them are apart by the length of their difference, rotations by the angle between them.
// Everything else is a walk over frames.
#include "tenon/motions/gaps.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "tenon/math/angle.h"
#include "tenon/math/inertia.h"
#include "tenon/scene/joint_dofs.h"

namespace tenon::motions {
namespace {

using scene::Index;
using scene::PhysicsScene;
using Numbers = std::vector<double>;

/// One motion with the scene that it is of.
struct Told {
  const PhysicsScene& scene;
  const bake::StateRecording& recording;
  bool has_contacts;
  std::vector<scene::FreeRotations> rotations;  ///< (joint_count)

  Told(const Setup& setup, const Motion& motion)
      : scene(setup.scene),
        recording(motion.run.recording),
        has_contacts(motion.has_contacts),
        rotations(scene::wanted_rotations(setup.scene)) {}
};

bool is_moved_by_forces(const scene::Body& body) { return body.enabled && !body.kinematic; }

double energy_of(const Told& told, std::size_t frame) {
  double sum = 0;
  for (Index i = 0; i < told.scene.bodies.size(); ++i) {
    const scene::Body& body = told.scene.bodies[i];
    if (!is_moved_by_forces(body)) {
      continue;
    }
    const engines::BodyState& state = told.recording.body(frame, i);
    const Vec3d center = transform_point(state.pose, body.center_of_mass);
    const Vec3d spin =
        state.angular_velocity * rotate_inertia(state.pose.orientation, body.inertia);
    const Vec3d& gravity = told.scene.scenes[body.scene].gravity;
    sum += body.mass * dot(state.linear_velocity, state.linear_velocity) / 2 +
           dot(state.angular_velocity, spin) / 2 -
           body.mass * body.gravity_scale * dot(gravity, center);
  }
  return sum;
}

Vec3d momentum_of(const Told& told, std::size_t frame) {
  Vec3d sum;
  for (Index i = 0; i < told.scene.bodies.size(); ++i) {
    if (is_moved_by_forces(told.scene.bodies[i])) {
      sum = sum + told.recording.body(frame, i).linear_velocity * told.scene.bodies[i].mass;
    }
  }
  return sum;
}

std::pair<std::size_t, std::size_t> contacts_of(const Told& told, std::size_t frame) {
  const std::vector<std::size_t>& offsets = told.recording.outputs.contact_offsets;
  return frame + 1 < offsets.size() ? std::pair(offsets[frame], offsets[frame + 1])
                                    : std::pair<std::size_t, std::size_t>{0, 0};
}

double deepest_of(const Told& told, std::size_t frame) {
  const auto [begin, end] = contacts_of(told, frame);
  double deepest = 0;
  for (std::size_t i = begin; i < end; ++i) {
    deepest = std::max(deepest, told.recording.outputs.contacts[i].depth);
  }
  return deepest;
}

/// Which coordinates of a joint turn, or slide.
std::vector<std::size_t> coordinates_of(const Told& told, Index joint, bool turning) {
  const scene::JointDofs dofs = scene::joint_dofs(told.scene.joints[joint], told.rotations[joint]);
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < dofs.count(); ++i) {
    const bool angular = i >= dofs.free.size() || scene::is_angular(dofs.free[i].dof);
    if (angular == turning) {
      found.push_back(i);
    }
  }
  return found;
}

/// A metric of one object in one motion, or of all together.
class Reader {
 public:
  Reader(const Told& told, Metric metric, Index object)
      : told_(told), metric_(metric), object_(object) {
    if (metric == Metric::JointAngle || metric == Metric::JointTravel) {
      coordinates_ = coordinates_of(told, object, metric == Metric::JointAngle);
    }
  }

  Numbers at(std::size_t frame) const {
    switch (metric_) {
      case Metric::Position: {
        const Vec3d& position = told_.recording.body(frame, object_).pose.position;
        return {position[0], position[1], position[2]};
      }
      case Metric::Orientation: {
        const Quatd& turn = told_.recording.body(frame, object_).pose.orientation;
        return {turn.w, turn.x, turn.y, turn.z};
      }
      case Metric::JointAngle:
      case Metric::JointTravel:
        return joint_at(frame);
      case Metric::Energy:
        return {energy_of(told_, frame)};
      case Metric::Momentum: {
        const Vec3d momentum = momentum_of(told_, frame);
        return {momentum[0], momentum[1], momentum[2]};
      }
      case Metric::Contacts: {
        const auto [begin, end] = contacts_of(told_, frame);
        return {static_cast<double>(end - begin)};
      }
      case Metric::Penetration:
        return {deepest_of(told_, frame)};
    }
    return {};
  }

 private:
  Numbers joint_at(std::size_t frame) const {
    const std::vector<double>& all = told_.recording.joint(frame, object_).position;
    Numbers found;
    for (const std::size_t i : coordinates_) {
      if (i < all.size()) {
        found.push_back(all[i]);
      }
    }
    return found;
  }

  const Told& told_;
  Metric metric_;
  Index object_;
  std::vector<std::size_t> coordinates_;
};

double angle_between(const Quatd& a, const Quatd& b) {
  if (a.w == b.w && a.x == b.x && a.y == b.y && a.z == b.z) {
    return 0;  // and not what rounding makes of it
  }
  return length(rotation_vector(conjugate(a) * b));
}

double apart(Metric metric, const Numbers& x, const Numbers& y) {
  if (metric == Metric::Orientation) {
    return angle_between({x[0], x[1], x[2], x[3]}, {y[0], y[1], y[2], y[3]});
  }
  double sum = 0;
  for (std::size_t i = 0; i < std::min(x.size(), y.size()); ++i) {
    sum += (x[i] - y[i]) * (x[i] - y[i]);
  }
  return std::sqrt(sum);
}

/// Frames that both have at the same time, from the first on.
std::size_t common_frames(const Told& a, const Told& b) {
  const std::size_t both = std::min(a.recording.frame_count(), b.recording.frame_count());
  std::size_t count = 0;
  while (count < both && std::abs(a.recording.times[count] - b.recording.times[count]) <= 1e-6) {
    ++count;
  }
  return count;
}

template <class T>
std::vector<std::pair<Index, Index>> paired(const std::vector<T>& a, const std::vector<T>& b) {
  std::map<Path, Index> places;
  for (Index i = 0; i < b.size(); ++i) {
    places.emplace(b[i].path, i);
  }
  std::vector<std::pair<Index, Index>> pairs;
  for (Index i = 0; i < a.size(); ++i) {
    if (const auto found = places.find(a[i].path); found != places.end()) {
      pairs.emplace_back(i, found->second);
    }
  }
  return pairs;
}

template <class T>
std::optional<Index> place_of(const std::vector<T>& list, Path path) {
  for (Index i = 0; i < list.size(); ++i) {
    if (list[i].path == path) {
      return i;
    }
  }
  return std::nullopt;
}

bool is_of_joints(Metric metric) {
  return metric == Metric::JointAngle || metric == Metric::JointTravel;
}

/// The gap of one object, over all frames.
Gap gap_of(const Told& a, const Told& b, Metric metric, std::pair<Index, Index> objects,
           std::size_t frames) {
  const Reader first(a, metric, objects.first);
  const Reader second(b, metric, objects.second);
  Gap gap;
  gap.metric = metric;
  for (std::size_t frame = 0; frame < frames; ++frame) {
    Numbers x = first.at(frame);
    Numbers y = second.at(frame);
    const double here = apart(metric, x, y);
    gap.mean += here / static_cast<double>(frames);
    if (frame == 0 || here > gap.largest) {
      gap.largest = here;
      gap.time = a.recording.times[frame];
      gap.first = std::move(x);
      gap.second = std::move(y);
    }
  }
  return gap;
}

std::optional<Gap> largest_gap(const Told& a, const Told& b, Metric metric) {
  const std::size_t frames = common_frames(a, b);
  if (frames == 0) {
    return std::nullopt;
  }
  if (!info_of(metric).of_objects) {
    return gap_of(a, b, metric, {0, 0}, frames);
  }
  const bool joints = is_of_joints(metric);
  std::optional<Gap> largest;
  for (const auto& pair :
       joints ? paired(a.scene.joints, b.scene.joints) : paired(a.scene.bodies, b.scene.bodies)) {
    Gap gap = gap_of(a, b, metric, pair, frames);
    if (gap.first.empty() || gap.second.empty() || (largest && gap.largest <= largest->largest)) {
      continue;
    }
    gap.object = joints ? a.scene.joints[pair.first].path : a.scene.bodies[pair.first].path;
    largest = std::move(gap);
  }
  return largest;
}

/// [m]
double gyration_radius(const scene::Body& body) {
  const double trace = body.inertia[0][0] + body.inertia[1][1] + body.inertia[2][2];
  const double squared = body.mass > 0 ? trace / (2 * body.mass) : 0;
  return std::isfinite(squared) && squared > 0 ? std::sqrt(squared) : 0;
}

/// Of one frame: how far the body that is farthest is apart.
class Distance {
 public:
  Distance(const Told& a, const Told& b)
      : a_(a), b_(b), pairs_(paired(a.scene.bodies, b.scene.bodies)) {
    for (const auto& [i, unused] : pairs_) {
      radii_.push_back(gyration_radius(a.scene.bodies[i]));
    }
  }

  double at(std::size_t frame) const {
    double farthest = 0;
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      const Pose& x = a_.recording.body(frame, pairs_[i].first).pose;
      const Pose& y = b_.recording.body(frame, pairs_[i].second).pose;
      farthest = std::max(farthest, length(x.position - y.position) +
                                        radii_[i] * angle_between(x.orientation, y.orientation));
    }
    return farthest;
  }

 private:
  const Told& a_;
  const Told& b_;
  std::vector<std::pair<Index, Index>> pairs_;
  std::vector<double> radii_;
};

}  // namespace

const std::vector<MetricInfo>& metrics() {
  static const std::vector<MetricInfo> kMetrics = {
      {Metric::Position, "position", "m", "mm", 1e3, true},
      {Metric::Orientation, "orientation", "rad", "deg", 180 / kPi, true},
      {Metric::JointAngle, "jointAngle", "rad", "deg", 180 / kPi, true},
      {Metric::JointTravel, "jointTravel", "m", "mm", 1e3, true},
      {Metric::Energy, "energy", "J", "J", 1, false},
      {Metric::Momentum, "momentum", "kg m/s", "kg m/s", 1, false},
      {Metric::Contacts, "contacts", "", "", 1, false},
      {Metric::Penetration, "penetration", "m", "mm", 1e3, false},
  };
  return kMetrics;
}

const MetricInfo& info_of(Metric metric) { return metrics()[static_cast<std::size_t>(metric)]; }

std::optional<Metric> metric_named(std::string_view name) {
  for (const MetricInfo& info : metrics()) {
    if (info.name == name) {
      return info.metric;
    }
  }
  return std::nullopt;
}

std::vector<Gap> gaps(const Setup& a, const Motion& a_motion, const Setup& b,
                      const Motion& b_motion) {
  const Told first(a, a_motion);
  const Told second(b, b_motion);
  std::vector<Gap> found;
  for (const MetricInfo& info : metrics()) {
    const bool of_contacts = info.metric == Metric::Contacts || info.metric == Metric::Penetration;
    if (of_contacts && !(first.has_contacts && second.has_contacts)) {
      continue;
    }
    if (auto gap = largest_gap(first, second, info.metric)) {
      found.push_back(*std::move(gap));
    }
  }
  return found;
}

double distance(const Setup& a, const Motion& a_motion, const Setup& b, const Motion& b_motion,
                double until) {
  const Told first(a, a_motion);
  const Told second(b, b_motion);
  const Distance apart(first, second);
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t frame = 0; frame < common_frames(first, second); ++frame) {
    if (first.recording.times[frame] <= until + 1e-9) {
      sum += apart.at(frame);
      ++count;
    }
  }
  return count == 0 ? 0 : sum / static_cast<double>(count);
}

double moment_of_largest_distance(const Setup& a, const Motion& a_motion, const Setup& b,
                                  const Motion& b_motion) {
  const Told first(a, a_motion);
  const Told second(b, b_motion);
  const Distance apart(first, second);
  double largest = 0;
  double time = 0;
  for (std::size_t frame = 0; frame < common_frames(first, second); ++frame) {
    if (const double here = apart.at(frame); here > largest) {
      largest = here;
      time = first.recording.times[frame];
    }
  }
  return time;
}

Figures figures_of(const Setup& setup, const Motion& motion) {
  const Told told(setup, motion);
  Figures figures;
  const std::size_t frames = told.recording.frame_count();
  if (frames == 0) {
    return figures;
  }
  figures.energy_start = energy_of(told, 0);
  figures.energy_end = energy_of(told, frames - 1);
  for (std::size_t frame = 0; frame < frames; ++frame) {
    const auto [begin, end] = contacts_of(told, frame);
    figures.mean_contacts += static_cast<double>(end - begin) / static_cast<double>(frames);
    figures.deepest = std::max(figures.deepest, deepest_of(told, frame));
  }
  return figures;
}

std::vector<std::vector<double>> series_of(const Setup& setup, const Motion& motion, Metric metric,
                                           Path object) {
  const Told told(setup, motion);
  std::optional<Index> place = 0;
  if (info_of(metric).of_objects) {
    place = is_of_joints(metric) ? place_of(setup.scene.joints, object)
                                 : place_of(setup.scene.bodies, object);
  }
  std::vector<std::vector<double>> series;
  if (place) {
    const Reader reader(told, metric, *place);
    for (std::size_t frame = 0; frame < told.recording.frame_count(); ++frame) {
      series.push_back(reader.at(frame));
    }
  }
  return series;
}

}  // namespace tenon::motions
