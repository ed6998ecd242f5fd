// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// States come first, in columns or keys that are always there. Outputs follow as series that know
// their object, their name and the labels of their numbers, so no writer lists outputs. Contacts
// vary in number: they are a list in lines of JSON, and rows of a second table beside a table.
// Numbers are the shortest that read back the same, so that equal runs give equal bytes.
#include "tenon/bake/write_log.h"

#include <array>
#include <cstddef>
#include <optional>

#include "tenon/bake/contact_fields.h"
#include "tenon/bake/drive_names.h"
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

std::string object_path(const PhysicsScene& scene, SeriesOf of, std::size_t i) {
  return of == SeriesOf::Bodies    ? scene.bodies[i].path.str()
         : of == SeriesOf::Sensors ? scene.sensors[i].path.str()
                                   : scene.joints[i].path.str();
}

void name_series(std::string& text, const PhysicsScene& scene, const OutputSeries& series) {
  for (std::size_t i = 0; i + 1 < series.offsets.size(); ++i) {
    const std::string name =
        (series.of == SeriesOf::Scene ? "" : object_path(scene, series.of, i) + ".") + series.key;
    for (std::size_t k = series.offsets[i]; k < series.offsets[i + 1]; ++k) {
      text += "," + name + series.labels[k];
    }
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
        text += "," + path + what + part_label(k, count);
      }
    }
  }
  for (const OutputSeries& series : recording.outputs.series) {
    name_series(text, scene, series);
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

/// The outputs of one object in one frame, each with a comma before it; sensors read some alone.
std::string json_outputs(const OutputRecording& outputs, SeriesOf of, std::size_t object,
                         std::size_t frame) {
  std::string text;
  for (const OutputSeries& series : outputs.series) {
    const bool has_some =
        series.offsets.size() > object + 1 && series.offsets[object] != series.offsets[object + 1];
    if (series.of == of && (has_some || of != SeriesOf::Sensors)) {
      const auto first =
          series.values.begin() + static_cast<std::ptrdiff_t>(frame * series.width());
      text += ",\"" + series.key + "\":" +
              json_list(std::vector<double>(
                  first + static_cast<std::ptrdiff_t>(series.offsets[object]),
                  first + static_cast<std::ptrdiff_t>(series.offsets[object + 1])));
    }
  }
  return text;
}

/// Outputs of the scene: "energy": {"kinetic": ..}, each with a comma before it.
std::string json_scene_outputs(const OutputRecording& outputs, std::size_t frame) {
  std::string text;
  for (const OutputSeries& series : outputs.series) {
    if (series.of == SeriesOf::Scene) {
      text += ",\"" + series.key + "\":{";
      for (std::size_t k = 0; k < series.width(); ++k) {
        text += (k == 0 ? "\"" : ",\"") + series.labels[k].substr(1) +
                "\":" + shortest(series.values[frame * series.width() + k]);
      }
      text += "}";
    }
  }
  return text;
}

std::string json_contact(const PhysicsScene& scene, const engines::Contact& c) {
  const auto body = [&](const std::optional<scene::Index>& index) {
    return index ? "\"" + scene.bodies[*index].path.str() + "\"" : std::string("null");
  };
  std::string text = "{\"colliders\":[\"" + scene.colliders[c.collider0].path.str() + "\",\"" +
                     scene.colliders[c.collider1].path.str() + "\"],\"bodies\":[" + body(c.body0) +
                     "," + body(c.body1) + "]";
  for (const ContactField& field : kContactFields) {
    const std::vector<double> numbers = field.of(c, scene);
    text += std::string(",\"") + field.key +
            "\":" + (field.is_vector() ? json_list(numbers) : shortest(numbers.front()));
  }
  return text + "}";
}

std::string json_contacts(const PhysicsScene& scene, const OutputRecording& outputs,
                          std::size_t frame) {
  std::string text = ",\"contacts\":[";
  for (std::size_t i = outputs.contact_offsets[frame]; i < outputs.contact_offsets[frame + 1];
       ++i) {
    text +=
        (i == outputs.contact_offsets[frame] ? "" : ",") + json_contact(scene, outputs.contacts[i]);
  }
  return text + "]";
}

std::string json_sensors(const PhysicsScene& scene, const OutputRecording& outputs,
                         std::size_t frame) {
  std::string text = ",\"sensors\":{";
  for (std::size_t i = 0; i < scene.sensors.size(); ++i) {
    const scene::Sensor& sensor = scene.sensors[i];
    if (sensor.enabled) {
      text += (text.back() == '{' ? "\"" : ",\"") + sensor.path.str() + "\":{\"kind\":\"" +
              std::string(sensor_kind_name(sensor.kind)) + "\"" +
              json_outputs(outputs, SeriesOf::Sensors, i, frame) + "}";
    }
  }
  return text + "}";
}

std::string json_body(const BodyState& s, const std::string& outputs) {
  const Quatd& q = s.pose.orientation;
  return "{\"position\":" + json_list(s.pose.position) +
         ",\"orientation\":" + json_list({q.w, q.x, q.y, q.z}) +
         ",\"linearVelocity\":" + json_list(s.linear_velocity) +
         ",\"angularVelocity\":" + json_list(s.angular_velocity) + outputs + "}";
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
    for (const OutputSeries& series : recording.outputs.series) {
      for (std::size_t k = 0; k < series.width(); ++k) {
        add(text, series.values[frame * series.width() + k]);
      }
    }
    text += "\n";
  }
  return text;
}

std::string jsonl_log(const PhysicsScene& scene, const StateRecording& recording) {
  const OutputRecording& outputs = recording.outputs;
  std::string text;
  for (std::size_t frame = 0; frame < recording.frame_count(); ++frame) {
    text += "{\"time\":" + shortest(recording.times[frame]) + ",\"bodies\":{";
    for (std::size_t i = 0; i < recording.body_count; ++i) {
      text += (i == 0 ? "\"" : ",\"") + scene.bodies[i].path.str() + "\":" +
              json_body(in_stage_units(recording.body(frame, i), scene),
                        json_outputs(outputs, SeriesOf::Bodies, i, frame));
    }
    text += "},\"joints\":{";
    for (std::size_t i = 0; i < recording.joint_count; ++i) {
      const JointState s = in_stage_units(recording.joint(frame, i), scene.joints[i], scene);
      text += (i == 0 ? "\"" : ",\"") + scene.joints[i].path.str() +
              "\":{\"position\":" + json_list(s.position) +
              ",\"velocity\":" + json_list(s.velocity) +
              json_outputs(outputs, SeriesOf::Joints, i, frame) + "}";
    }
    text += "}" + json_scene_outputs(outputs, frame);
    text += outputs.has_sensors ? json_sensors(scene, outputs, frame) : "";
    text += (outputs.has_contacts ? json_contacts(scene, outputs, frame) : "") + "}\n";
  }
  return text;
}

std::string contacts_csv(const PhysicsScene& scene, const StateRecording& recording) {
  std::string text = "time,collider0,collider1,body0,body1";
  for (const ContactField& field : kContactFields) {
    if (field.is_vector()) {
      name_columns(text, field.key, "");
    } else {
      text += std::string(",") + field.key;
    }
  }
  text += "\n";
  const OutputRecording& outputs = recording.outputs;
  for (std::size_t frame = 0; frame < recording.frame_count(); ++frame) {
    for (std::size_t i = outputs.contact_offsets[frame]; i < outputs.contact_offsets[frame + 1];
         ++i) {
      const engines::Contact& c = outputs.contacts[i];
      text += shortest(recording.times[frame]) + "," + scene.colliders[c.collider0].path.str() +
              "," + scene.colliders[c.collider1].path.str();
      for (const auto& body : {c.body0, c.body1}) {
        text += "," + (body ? scene.bodies[*body].path.str() : std::string());
      }
      for (const ContactField& field : kContactFields) {
        for (const double number : field.of(c, scene)) {
          add(text, number);
        }
      }
      text += "\n";
    }
  }
  return text;
}

std::string contacts_path(const std::string& log) {
  const std::string ending = ".csv";
  return (ends_with(log, ending) ? log.substr(0, log.size() - ending.size()) : log) +
         ".contacts.csv";
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
