// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/bake/write_log.h"

#include <array>

#include "tenon/bake/stage_values.h"
#include "tenon/base/text/text_number.h"

namespace tenon::bake {
namespace {

using engines::BodyState;
using engines::JointState;
using scene::PhysicsScene;

constexpr std::array<const char*, 3> kAxes = {".x", ".y", ".z"};

void name_columns(std::string& text, const std::string& path, const char* what) {
  for (const char* axis : kAxes) {
    text += "," + path + what + axis;
  }
}

std::string csv_header(const PhysicsScene& scene, const StateRecording& recording) {
  std::string text = "time";
  for (const scene::Body& body : scene.bodies) {
    const std::string path = body.path.str();
    name_columns(text, path, ".position");
    text += "," + path + ".orientation.w";
    name_columns(text, path, ".orientation");
    name_columns(text, path, ".linearVelocity");
    name_columns(text, path, ".angularVelocity");
  }
  for (std::size_t i = 0; i < scene.joints.size() && recording.frame_count() > 0; ++i) {
    const std::string path = scene.joints[i].path.str();
    const std::size_t count = recording.joint(0, i).position.size();
    for (const char* what : {".position", ".velocity"}) {
      for (std::size_t k = 0; k < count; ++k) {
        text += "," + path + what + (count == 1 ? "" : "." + std::to_string(k));
      }
    }
  }
  return text + "\n";
}

void add(std::string& text, double number) { text += "," + shortest(number); }
void add(std::string& text, const Vec3d& v) {
  for (const double number : v.v) {
    add(text, number);
  }
}

std::string json_list(const std::vector<double>& numbers) {
  std::string text = "[";
  for (const double number : numbers) {
    text += (text.size() > 1 ? "," : "") + shortest(number);
  }
  return text + "]";
}

std::string json_list(const Vec3d& v) {
  return json_list(std::vector<double>(v.v.begin(), v.v.end()));
}

std::string json_body(const BodyState& s) {
  const Quatd& q = s.pose.orientation;
  return "{\"position\":" + json_list(s.pose.position) +
         ",\"orientation\":" + json_list({q.w, q.x, q.y, q.z}) +
         ",\"linearVelocity\":" + json_list(s.linear_velocity) +
         ",\"angularVelocity\":" + json_list(s.angular_velocity) + "}";
}

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

}  // namespace

std::string csv_log(const PhysicsScene& scene, const StateRecording& recording) {
  std::string text = csv_header(scene, recording);
  for (std::size_t frame = 0; frame < recording.frame_count(); ++frame) {
    text += shortest(recording.times[frame]);
    for (std::size_t i = 0; i < recording.body_count; ++i) {
      const BodyState s = in_stage_units(recording.body(frame, i), scene);
      add(text, s.pose.position);
      const Quatd& q = s.pose.orientation;
      add(text, q.w);
      add(text, Vec3d{{q.x, q.y, q.z}});
      add(text, s.linear_velocity);
      add(text, s.angular_velocity);
    }
    for (std::size_t i = 0; i < recording.joint_count; ++i) {
      const JointState s = in_stage_units(recording.joint(frame, i), scene.joints[i], scene);
      for (const auto* numbers : {&s.position, &s.velocity}) {
        for (const double number : *numbers) {
          add(text, number);
        }
      }
    }
    text += "\n";
  }
  return text;
}

std::string jsonl_log(const PhysicsScene& scene, const StateRecording& recording) {
  std::string text;
  for (std::size_t frame = 0; frame < recording.frame_count(); ++frame) {
    text += "{\"time\":" + shortest(recording.times[frame]) + ",\"bodies\":{";
    for (std::size_t i = 0; i < recording.body_count; ++i) {
      text += (i == 0 ? "\"" : ",\"") + scene.bodies[i].path.str() +
              "\":" + json_body(in_stage_units(recording.body(frame, i), scene));
    }
    text += "},\"joints\":{";
    for (std::size_t i = 0; i < recording.joint_count; ++i) {
      const JointState s = in_stage_units(recording.joint(frame, i), scene.joints[i], scene);
      text += (i == 0 ? "\"" : ",\"") + scene.joints[i].path.str() +
              "\":{\"position\":" + json_list(s.position) +
              ",\"velocity\":" + json_list(s.velocity) + "}";
    }
    text += "}}\n";
  }
  return text;
}

Result<std::string> log_for(const std::string& path, const PhysicsScene& scene,
                            const StateRecording& recording) {
  if (ends_with(path, ".csv")) {
    return csv_log(scene, recording);
  }
  if (ends_with(path, ".jsonl")) {
    return jsonl_log(scene, recording);
  }
  if (ends_with(path, ".npz")) {
    return npz_log(scene, recording);
  }
  return Error(ErrorCode::Invalid, "\"" + path + "\" does not say what kind of log to write")
      .with_fix("end the name in .csv, .jsonl or .npz");
}

}  // namespace tenon::bake
