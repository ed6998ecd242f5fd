// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What does not move has no channel. Rotations go by the shorter way, so that players interpolate
// as they should; they are shorts when compressed, and positions are rounded to 4 micrometres, so
// that their last bytes are alike.
#include <algorithm>
#include <cmath>

#include "tenon/glb/glb_parts.h"

namespace tenon::glb {
namespace {

constexpr double kStill = 1e-6;             // metres, and parts of quaternions
constexpr double kRounding = 1.0 / 262144;  // metres

Quatd shorter_way(const Quatd& from, const Quatd& to) {
  return dot(from, to) < 0 ? Quatd{-to.x, -to.y, -to.z, -to.w} : to;
}

double furthest(const Quatd& a, const Quatd& b) {
  return std::max(
      {std::fabs(a.x - b.x), std::fabs(a.y - b.y), std::fabs(a.z - b.z), std::fabs(a.w - b.w)});
}

std::int16_t signed_short(double value) {
  return static_cast<std::int16_t>(std::lround(std::clamp(value, -1.0, 1.0) * 32767));
}

/// One body's positions and orientations.
struct Course {
  std::vector<Vec3d> positions;
  std::vector<Quatd> turns;
  bool moves = false;
  bool rotates = false;
};

Course course_of(const bake::PoseRecording& motion, std::size_t body) {
  Course course;
  for (std::size_t frame = 0; frame < motion.frame_count(); ++frame) {
    const Pose& pose = motion.pose(frame, body);
    course.positions.push_back(pose.position);
    course.turns.push_back(frame == 0 ? pose.orientation
                                      : shorter_way(course.turns.back(), pose.orientation));
    course.moves = course.moves || length(pose.position - course.positions[0]) > kStill;
    course.rotates = course.rotates || furthest(course.turns.back(), course.turns[0]) > kStill;
  }
  return course;
}

int write_times(const std::vector<double>& times, GlbBuffer& buffer) {
  std::string bytes;
  for (const double time : times) {
    append_bytes(bytes, static_cast<float>(time));
  }
  Elements elements{Component::Float, "SCALAR", 4, false, false};
  elements.least = {static_cast<float>(times.front())};
  elements.most = {static_cast<float>(times.back())};
  return buffer.add(bytes, elements);
}

int write_positions(const std::vector<Vec3d>& positions, GlbBuffer& buffer) {
  std::string bytes;
  for (const Vec3d& position : positions) {
    for (const double part : position.v) {
      const double rounded = std::round(part / kRounding) * kRounding;
      append_bytes(bytes, static_cast<float>(buffer.compressed() ? rounded : part));
    }
  }
  return buffer.add(bytes, {Component::Float, "VEC3", 12, false, false});
}

int write_turns(const std::vector<Quatd>& turns, GlbBuffer& buffer) {
  std::string bytes;
  for (const Quatd& q : turns) {
    for (const double part : {q.x, q.y, q.z, q.w}) {
      if (buffer.compressed()) {
        append_bytes(bytes, signed_short(part));
      } else {
        append_bytes(bytes, static_cast<float>(part));
      }
    }
  }
  return buffer.compressed() ? buffer.add(bytes, {Component::Short, "VEC4", 8, true, false})
                             : buffer.add(bytes, {Component::Float, "VEC4", 16, false, false});
}

}  // namespace

GltfJson motion_of_bodies(const bake::PoseRecording& motion, int first_node, GlbBuffer& buffer) {
  GltfJson channels = GltfJson::array();
  GltfJson samplers = GltfJson::array();
  if (motion.frame_count() < 2) {
    return nullptr;
  }
  const int times = write_times(motion.times, buffer);
  const auto add = [&](int node, const char* path, int values) {
    channels.push_back(
        {{"sampler", samplers.size()}, {"target", {{"node", node}, {"path", path}}}});
    samplers.push_back({{"input", times}, {"output", values}});
  };
  for (std::size_t body = 0; body < motion.body_count; ++body) {
    const Course course = course_of(motion, body);
    const int node = first_node + static_cast<int>(body);
    // The last frame of a motion without any is one body's: a file shows how long it lasts.
    const bool alone = body + 1 == motion.body_count && channels.empty();
    if (course.moves || alone) {
      add(node, "translation", write_positions(course.positions, buffer));
    }
    if (course.rotates) {
      add(node, "rotation", write_turns(course.turns, buffer));
    }
  }
  if (channels.empty()) {
    return nullptr;
  }
  return {{"name", "motion"}, {"channels", std::move(channels)}, {"samplers", std::move(samplers)}};
}

}  // namespace tenon::glb
