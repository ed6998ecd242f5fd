// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// A NumPy archive: a zip of .npy files, each a short text header and raw little-endian numbers.
#include <algorithm>
#include <bit>
#include <cstring>

#include "tenon/bake/contact_fields.h"
#include "tenon/bake/stage_values.h"
#include "tenon/bake/write_log.h"
#include "tenon/bytes/zip/zip_archive.h"

namespace tenon::bake {
namespace {

static_assert(std::endian::native == std::endian::little);

/// Header of format 1.0, padded so that the data begin at a multiple of 64 bytes.
std::string npy_header(const std::string& type, const std::vector<std::size_t>& shape) {
  std::string dict = "{'descr': '" + type + "', 'fortran_order': False, 'shape': (";
  for (const std::size_t n : shape) {
    dict += std::to_string(n) + ",";
  }
  dict += "), }";
  constexpr std::size_t kPreamble = 10;
  while ((kPreamble + dict.size() + 1) % 64 != 0) {
    dict += ' ';
  }
  dict += '\n';
  std::string header = "\x93NUMPY";
  header += '\x01';
  header += '\0';
  header += static_cast<char>(dict.size() & 0xFFu);
  header += static_cast<char>((dict.size() >> 8u) & 0xFFu);
  return header + dict;
}

std::string npy(const std::vector<double>& numbers, const std::vector<std::size_t>& shape) {
  std::string bytes = npy_header("<f8", shape);
  bytes.append(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(double));
  return bytes;
}

std::string npy(const std::vector<std::int64_t>& numbers, const std::vector<std::size_t>& shape) {
  std::string bytes = npy_header("<i8", shape);
  bytes.append(reinterpret_cast<const char*>(numbers.data()),
               numbers.size() * sizeof(std::int64_t));
  return bytes;
}

std::string npy(const std::vector<std::int64_t>& numbers) { return npy(numbers, {numbers.size()}); }

/// Fixed-width byte strings.
std::string npy(const std::vector<std::string>& texts) {
  std::size_t width = 1;
  for (const std::string& text : texts) {
    width = std::max(width, text.size());
  }
  std::string bytes = npy_header("|S" + std::to_string(width), {texts.size()});
  for (const std::string& text : texts) {
    bytes += text + std::string(width - text.size(), '\0');
  }
  return bytes;
}

template <class T>
std::vector<std::string> paths_of(const std::vector<T>& objects) {
  std::vector<std::string> paths;
  for (const T& object : objects) {
    paths.push_back(object.path.str());
  }
  return paths;
}

std::vector<std::string> kinds_of(const std::vector<scene::Sensor>& sensors) {
  std::vector<std::string> kinds;
  for (const scene::Sensor& sensor : sensors) {
    kinds.emplace_back(sensor_kind_name(sensor.kind));
  }
  return kinds;
}

struct BodyColumns {
  std::vector<double> position;
  std::vector<double> orientation;
  std::vector<double> linear_velocity;
  std::vector<double> angular_velocity;
};

BodyColumns body_columns(const scene::PhysicsScene& scene, const StateRecording& recording) {
  BodyColumns columns;
  for (const engines::BodyState& state : recording.bodies) {
    const engines::BodyState s = in_stage_units(state, scene);
    append(columns.position, s.pose.position);
    const Quatd& q = s.pose.orientation;
    columns.orientation.insert(columns.orientation.end(), {q.w, q.x, q.y, q.z});
    append(columns.linear_velocity, s.linear_velocity);
    append(columns.angular_velocity, s.angular_velocity);
  }
  return columns;
}

struct JointColumns {
  std::vector<double> position;
  std::vector<double> velocity;
  std::vector<std::int64_t> offsets = {0};
};

JointColumns joint_columns(const scene::PhysicsScene& scene, const StateRecording& recording) {
  JointColumns columns;
  for (std::size_t i = 0; i < recording.joint_count; ++i) {
    const std::size_t count =
        recording.frame_count() == 0 ? 0 : recording.joint(0, i).position.size();
    columns.offsets.push_back(columns.offsets.back() + static_cast<std::int64_t>(count));
  }
  for (std::size_t frame = 0; frame < recording.frame_count(); ++frame) {
    for (std::size_t i = 0; i < recording.joint_count; ++i) {
      const engines::JointState s =
          in_stage_units(recording.joint(frame, i), scene.joints[i], scene);
      columns.position.insert(columns.position.end(), s.position.begin(), s.position.end());
      columns.velocity.insert(columns.velocity.end(), s.velocity.begin(), s.velocity.end());
    }
  }
  return columns;
}

using NamedArrays = std::vector<std::pair<std::string, std::string>>;

void add_series(const OutputRecording& outputs, std::size_t frames, NamedArrays& arrays) {
  for (const OutputSeries& series : outputs.series) {
    if (series.vectors) {
      arrays.emplace_back(series.array + ".npy",
                          npy(series.values, {frames, series.offsets.size() - 1, 3}));
      continue;
    }
    arrays.emplace_back(series.array + ".npy", npy(series.values, {frames, series.width()}));
    if (series.of == SeriesOf::Scene) {
      std::vector<std::string> names;
      for (const std::string& label : series.labels) {
        names.push_back(label.substr(1));  // behind the dot
      }
      arrays.emplace_back(series.array + "_names.npy", npy(names));
    } else {
      arrays.emplace_back(
          series.array + "_offsets.npy",
          npy(std::vector<std::int64_t>(series.offsets.begin(), series.offsets.end())));
    }
  }
}

void add_contacts(const scene::PhysicsScene& scene, const OutputRecording& outputs,
                  NamedArrays& arrays) {
  std::vector<std::int64_t> colliders;
  for (const engines::Contact& c : outputs.contacts) {
    for (const scene::Index collider : {c.collider0, c.collider1}) {
      colliders.push_back(static_cast<std::int64_t>(collider));
    }
  }
  const std::size_t count = outputs.contacts.size();
  arrays.emplace_back("collider_paths.npy", npy(paths_of(scene.colliders)));
  arrays.emplace_back("contact_offsets.npy",
                      npy(std::vector<std::int64_t>(outputs.contact_offsets.begin(),
                                                    outputs.contact_offsets.end())));
  arrays.emplace_back("contact_colliders.npy", npy(colliders, {count, 2}));
  for (const ContactField& field : kContactFields) {
    std::vector<double> numbers;
    for (const engines::Contact& c : outputs.contacts) {
      field.append_to(numbers, c, scene);
    }
    const std::vector<std::size_t> shape =
        field.is_vector() ? std::vector<std::size_t>{count, 3} : std::vector<std::size_t>{count};
    arrays.emplace_back(std::string("contact_") + field.array + ".npy", npy(numbers, shape));
  }
}

}  // namespace

Result<std::string> npz_log(const scene::PhysicsScene& scene, const StateRecording& recording) {
  const std::size_t frames = recording.frame_count();
  const std::size_t bodies = recording.body_count;
  const BodyColumns body = body_columns(scene, recording);
  const JointColumns joint = joint_columns(scene, recording);
  const auto coordinates = static_cast<std::size_t>(joint.offsets.back());
  NamedArrays arrays = {
      {"time.npy", npy(recording.times, {frames})},
      {"body_paths.npy", npy(paths_of(scene.bodies))},
      {"position.npy", npy(body.position, {frames, bodies, 3})},
      {"orientation.npy", npy(body.orientation, {frames, bodies, 4})},
      {"linear_velocity.npy", npy(body.linear_velocity, {frames, bodies, 3})},
      {"angular_velocity.npy", npy(body.angular_velocity, {frames, bodies, 3})},
      {"joint_paths.npy", npy(paths_of(scene.joints))},
      {"joint_offsets.npy", npy(joint.offsets)},
      {"joint_position.npy", npy(joint.position, {frames, coordinates})},
      {"joint_velocity.npy", npy(joint.velocity, {frames, coordinates})},
  };
  if (recording.outputs.has_sensors) {
    arrays.emplace_back("sensor_paths.npy", npy(paths_of(scene.sensors)));
    arrays.emplace_back("sensor_kinds.npy", npy(kinds_of(scene.sensors)));
  }
  add_series(recording.outputs, frames, arrays);
  if (recording.outputs.has_contacts) {
    add_contacts(scene, recording.outputs, arrays);
  }
  std::vector<bytes::ZipFile> files;
  for (const auto& [name, contents] : arrays) {
    files.push_back({name, contents});
  }
  return bytes::write_zip(files);
}

}  // namespace tenon::bake
