// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What sensors of a MJCF model read after it was converted, beside MuJoCo's own sensordata of the
// model as it is. Both take the same steps. Forces and accelerations here are those of a step, seen
// at its beginning, where MuJoCo's step leaves its own; states are those at its end, for which
// MuJoCo is asked anew. The damping of joints, which steps take implicitly, keeps the former apart.
#include <cmath>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "tenon/asset/convert_file.h"
#include "tenon/engines/mujoco/model.h"
#include "tenon/make_simulation.h"
#include "tenon/physics/read_physics.h"
#include "tests/convert/read_with_mujoco.h"

namespace tenon {
namespace {

using engines::SensorReading;

constexpr double kStep = 0.0005;  // [s], that of the file
constexpr std::size_t kSteps = 2000;
constexpr std::size_t kStepsBetween = 100;

/// How far readings were from MuJoCo's at most, by sensor; and the largest of MuJoCo's.
struct Gap {
  double apart = 0;
  double size = 0;
};

using Values = std::map<std::string, std::vector<double>>;

Values mujoco_values(const mjModel& model, const mjData& data) {
  Values values;
  for (int i = 0; i < model.nsensor; ++i) {
    const double* first = data.sensordata + model.sensor_adr[i];
    values[mj_id2name(&model, mjOBJ_SENSOR, i)].assign(first, first + model.sensor_dim[i]);
  }
  return values;
}

std::vector<double> list_of(const Vec3d& v) { return {v.v.begin(), v.v.end()}; }

Values own_values(const scene::PhysicsScene& scene, const engines::World& world) {
  const std::vector<SensorReading> readings = *world.sensors();
  Values values;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const SensorReading& r = readings[i];
    const std::string name(scene.sensors[i].path.name().view());
    switch (scene.sensors[i].kind) {
      case scene::SensorKind::Imu:
        values["acceleration"] = list_of(r.linear_acceleration);
        values["gyro"] = list_of(r.angular_velocity);
        values["orientation"] = {r.orientation.w, r.orientation.x, r.orientation.y,
                                 r.orientation.z};
        break;
      case scene::SensorKind::Frame:
        values["place"] = list_of(r.position);
        values["pace"] = list_of(r.linear_velocity);
        values["spin"] = list_of(r.angular_velocity);
        break;
      case scene::SensorKind::Rays:
        values["range"] = r.distances;
        break;
      case scene::SensorKind::ForceTorque:
        values["force"] = list_of(r.wrench.force);
        values["torque"] = list_of(r.wrench.torque);
        break;
      case scene::SensorKind::Contact:
        values["touch"] = {r.normal_force};
        break;
      case scene::SensorKind::Joint:
        if (name == "turn") {
          values["angle"] = r.joint.position;
          values["speed"] = r.joint.velocity;
        } else {
          values["effort"] = r.efforts;
        }
        break;
    }
  }
  return values;
}

void compare(const Values& own, const Values& theirs, std::map<std::string, Gap>& gaps) {
  for (const auto& [name, wanted] : theirs) {
    Gap& gap = gaps[name];
    const auto found = own.find(name);
    const bool there = found != own.end() && found->second.size() == wanted.size();
    double sign = 1;
    if (there && name == "orientation") {  // q and -q are one
      double product = 0;
      for (std::size_t i = 0; i < 4; ++i) {
        product += found->second[i] * wanted[i];
      }
      sign = product < 0 ? -1 : 1;
    }
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      const double apart = there ? std::fabs(sign * found->second[i] - wanted[i]) : INFINITY;
      gap.apart = std::max(gap.apart, apart);
      gap.size = std::max(gap.size, std::fabs(wanted[i]));
    }
  }
}

bool is_state(const std::string& name) {
  return name == "gyro" || name == "orientation" || name == "angle" || name == "speed" ||
         name == "place" || name == "range" || name == "pace" || name == "spin";
}

/// As a share of the largest reading.
double tolerance_of(const std::string& name) {
  return is_state(name) ? 1e-7 : name == "effort" ? 5e-4 : 1e-4;
}

int judge(const std::map<std::string, Gap>& gaps) {
  int faults = gaps.size() == 13 ? 0 : 1;
  for (const auto& [name, gap] : gaps) {
    const bool near = gap.apart <= tolerance_of(name) * gap.size && gap.size > 1e-3;
    std::printf("%-14s largest %-10.5g apart %-10.3g%s\n", name.c_str(), gap.size, gap.apart,
                near ? "" : "  TOO FAR");
    faults += near ? 0 : 1;
  }
  return faults > 0 ? 1 : 0;
}

Result<engines::World> world_of(const scene::PhysicsScene& scene, Diagnostics& findings) {
  engines::SimulationOptions options{.time_step = kStep};
  options.outputs.sensors = true;
  return make_world("mujoco", scene, options, findings);
}

int run(const std::string& path) {
  Diagnostics findings;
  auto converted = convert_file(path, {}, findings);
  if (!converted) {
    std::printf("%s\n", converted.error().to_string().c_str());
    return 1;
  }
  const auto stage = stage::Stage::open(
      std::make_shared<const layer::Layer>(std::move(converted->layer)), nullptr, {});
  const scene::PhysicsScene scene = physics::read_physics(*stage, {}, findings);
  auto world = world_of(scene, findings);
  const engines::mujoco::ModelPtr model = read_with_mujoco(path, [](mjSpec&) {});
  if (!world || model == nullptr) {
    std::printf("%s\n", world ? "no model" : world.error().to_string().c_str());
    return 1;
  }
  const engines::mujoco::DataPtr data(mj_makeData(model.get()));
  std::map<std::string, Gap> gaps;
  for (std::size_t done = 0; done < kSteps; done += kStepsBetween) {
    if (!world->step(kStepsBetween)) {
      return 1;
    }
    for (std::size_t i = 0; i < kStepsBetween; ++i) {
      mj_step(model.get(), data.get());
    }
    Values theirs = mujoco_values(*model, *data);
    mj_forward(model.get(), data.get());
    for (const auto& [name, values] : mujoco_values(*model, *data)) {
      if (is_state(name)) {
        theirs[name] = values;
      }
    }
    if (done >= kSteps / 4) {  // the ball lies
      compare(own_values(scene, *world), theirs, gaps);
    }
  }
  return judge(gaps);
}

}  // namespace
}  // namespace tenon

int main() { return tenon::run("tests/convert/mjcf/sensors.xml"); }
