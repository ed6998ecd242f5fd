// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Each series knows how one frame of it is read; logs of every format then walk the series and need
// not know what an output is. Contacts vary in number and are kept as they come. How many numbers a
// joint has does not change while a simulation runs.
#include "tenon/bake/record_outputs.h"

#include <algorithm>
#include <array>
#include <utility>

#include "tenon/bake/drive_names.h"
#include "tenon/bake/sensor_series.h"
#include "tenon/bake/stage_values.h"
#include "tenon/base/limits/run_limits.h"
#include "tenon/math/angle.h"

namespace tenon::bake {
namespace {

using engines::Outputs;
using scene::Index;

constexpr std::pair<const char*, bool Outputs::*> kLogOutputs[] = {
    {"contacts", &Outputs::contacts},   {"efforts", &Outputs::efforts},
    {"reactions", &Outputs::reactions}, {"accelerations", &Outputs::accelerations},
    {"energy", &Outputs::work},         {"sensors", &Outputs::sensors},
};

constexpr std::pair<const char*, double engines::Work::*> kWorkParts[] = {
    {".drives", &engines::Work::drives},     {".applied", &engines::Work::applied},
    {".contacts", &engines::Work::contacts}, {".constraints", &engines::Work::constraints},
    {".damping", &engines::Work::damping},   {".springs", &engines::Work::springs},
    {".changes", &engines::Work::changes},
};
static_assert(sizeof(engines::Work) == std::size(kWorkParts) * sizeof(double));

OutputSeries empty_series(SeriesOf of, const char* key, const char* array) {
  OutputSeries series;
  series.of = of;
  series.key = key;
  series.array = array;
  series.offsets = {0};
  return series;
}

OutputSeries vector_series(SeriesOf of, const char* key, const char* array, std::size_t count) {
  OutputSeries series = empty_series(of, key, array);
  series.vectors = true;
  for (std::size_t i = 0; i < count; ++i) {
    series.labels.insert(series.labels.end(), {".x", ".y", ".z"});
    series.offsets.push_back(series.width());
  }
  return series;
}

}  // namespace

std::vector<std::string> log_output_names() {
  std::vector<std::string> names;
  for (const auto& [name, member] : kLogOutputs) {
    names.emplace_back(name);
  }
  return names;
}

Outputs outputs_named(const std::vector<std::string>& names) {
  Outputs outputs;
  for (const auto& [name, member] : kLogOutputs) {
    outputs.*member = std::find(names.begin(), names.end(), name) != names.end();
  }
  return outputs;
}

std::vector<std::string> names_of(const Outputs& outputs) {
  std::vector<std::string> names;
  for (const auto& [name, member] : kLogOutputs) {
    if (outputs.*member) {
      names.emplace_back(name);
    }
  }
  return names;
}

OutputRecorder::OutputRecorder(const engines::Simulation& simulation,
                               const scene::PhysicsScene& scene, const Outputs& wanted,
                               OutputRecording& recording)
    : simulation_(simulation), scene_(scene), recording_(recording) {
  recording_.has_contacts = wanted.contacts;
  if (wanted.efforts) {
    add_efforts();
  }
  if (wanted.reactions) {
    add_reactions();
  }
  if (wanted.accelerations) {
    add_accelerations();
  }
  if (wanted.work) {
    add_energy();
  }
  if (wanted.sensors) {
    add_sensors();
  }
}

Result<void> OutputRecorder::begin() { return sensors_ ? sensors_->restart() : Result<void>(); }

Result<void> OutputRecorder::after_step() {
  return sensors_ ? sensors_->after_step() : Result<void>();
}

void OutputRecorder::add(OutputSeries series, Read read) {
  recording_.series.push_back(std::move(series));
  reads_.push_back(std::move(read));
}

void OutputRecorder::add_efforts() {
  OutputSeries series = empty_series(SeriesOf::Joints, "driveEffort", "drive_effort");
  for (const scene::Joint& joint : scene_.joints) {
    for (std::size_t k = 0; k < joint.drives.size(); ++k) {
      series.labels.push_back(drive_label(joint, k));
    }
    series.offsets.push_back(series.width());
  }
  add(std::move(series), [this](Numbers& values) -> Result<void> {
    for (Index j = 0; j < scene_.joints.size(); ++j) {
      TENON_TRY(const Numbers efforts, simulation_.drive_efforts(j));
      values.insert(values.end(), efforts.begin(), efforts.end());
    }
    return {};
  });
}

void OutputRecorder::add_reactions() {
  const auto reader = [this](Vec3d engines::Wrench::* part) -> Read {
    return [this, part](Numbers& values) -> Result<void> {
      for (Index j = 0; j < scene_.joints.size(); ++j) {
        TENON_TRY(const engines::Wrench wrench, simulation_.joint_reaction(j));
        append(values, wrench.*part);
      }
      return {};
    };
  };
  const std::size_t count = scene_.joints.size();
  add(vector_series(SeriesOf::Joints, "reactionForce", "reaction_force", count),
      reader(&engines::Wrench::force));
  add(vector_series(SeriesOf::Joints, "reactionTorque", "reaction_torque", count),
      reader(&engines::Wrench::torque));
}

void OutputRecorder::add_accelerations() {
  const auto reader = [this](Vec3d engines::BodyAcceleration::* part, double unit) -> Read {
    return [this, part, unit](Numbers& values) -> Result<void> {
      for (Index i = 0; i < scene_.bodies.size(); ++i) {
        TENON_TRY(const engines::BodyAcceleration found, simulation_.body_acceleration(i));
        append(values, found.*part * unit);
      }
      return {};
    };
  };
  const std::size_t count = scene_.bodies.size();
  add(vector_series(SeriesOf::Bodies, "linearAcceleration", "linear_acceleration", count),
      reader(&engines::BodyAcceleration::linear, 1 / scene_.meters_per_unit));
  add(vector_series(SeriesOf::Bodies, "angularAcceleration", "angular_acceleration", count),
      reader(&engines::BodyAcceleration::angular, kDegreesPerRadian));
  OutputSeries joints = empty_series(SeriesOf::Joints, "acceleration", "joint_acceleration");
  for (Index j = 0; j < scene_.joints.size(); ++j) {
    const std::size_t axes = simulation_.joint_state(j).position.size();
    for (std::size_t k = 0; k < axes; ++k) {
      joints.labels.push_back(part_label(k, axes));
    }
    joints.offsets.push_back(joints.width());
  }
  add(std::move(joints), [this](Numbers& values) -> Result<void> {
    for (Index j = 0; j < scene_.joints.size(); ++j) {
      TENON_TRY(const Numbers found, simulation_.joint_acceleration(j));
      const Numbers shown = in_stage_units({found, found}, scene_.joints[j], scene_).velocity;
      values.insert(values.end(), shown.begin(), shown.end());
    }
    return {};
  });
}

void OutputRecorder::add_energy() {
  OutputSeries energy = empty_series(SeriesOf::Scene, "energy", "energy");
  energy.labels = {".kinetic", ".potential"};
  energy.offsets.push_back(energy.width());
  add(std::move(energy), [this](Numbers& values) -> Result<void> {
    const engines::Energy now = simulation_.energy();
    values.insert(values.end(), {now.kinetic, now.potential});
    return {};
  });
  if (!simulation_.can(engines::Ability::Work)) {
    return;
  }
  OutputSeries work = empty_series(SeriesOf::Scene, "work", "work");
  for (const auto& [label, member] : kWorkParts) {
    work.labels.emplace_back(label);
  }
  work.offsets.push_back(work.width());
  add(std::move(work), [this](Numbers& values) -> Result<void> {
    TENON_TRY(const engines::Work done, simulation_.work());
    for (const auto& [label, member] : kWorkParts) {
      values.push_back(done.*member);
    }
    return {};
  });
}

void OutputRecorder::add_sensors() {
  sensors_.emplace(scene_, simulation_);
  recording_.has_sensors = true;
  for (SensorSeries& one : sensor_series(scene_, simulation_)) {
    add(std::move(one.series), [this, read = std::move(one.read)](Numbers& values) -> Result<void> {
      read(sensors_->readings(), values);
      return {};
    });
  }
}

Result<void> OutputRecorder::read_contacts() {
  TENON_TRY(const std::vector<engines::Contact> contacts, simulation_.contacts());
  std::vector<engines::Contact>& all = recording_.contacts;
  if (contacts.size() > limits::kRecordedContacts - all.size()) {
    return Error(ErrorCode::Limit, "the run records more than " +
                                       std::to_string(limits::kRecordedContacts) + " contacts")
        .with_rule("sim.record-too-long")
        .with_fix("give a lower --fps or a shorter --duration");
  }
  all.insert(all.end(), contacts.begin(), contacts.end());
  recording_.contact_offsets.push_back(all.size());
  return {};
}

Result<void> OutputRecorder::add_frame() {
  if (recording_.has_contacts) {
    TENON_CHECK(read_contacts());
  }
  for (std::size_t i = 0; i < reads_.size(); ++i) {
    TENON_CHECK(reads_[i](recording_.series[i].values));
  }
  return {};
}

}  // namespace tenon::bake
