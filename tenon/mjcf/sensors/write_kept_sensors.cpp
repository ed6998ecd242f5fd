// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A MuJoCo sensor that the asset has as a prim is written back as it is, and the instrument that
// measures it in runs is not written beside it. Its object is found by the path of the prim, as all
// things in the spec are named. The instrument may have been moved or sized since: then the sensor
// measures at a site for the instrument.
#include "tenon/mjcf/sensors/write_kept_sensors.h"

#include <algorithm>
#include <cmath>

#include "tenon/engines/mujoco/build/sensor_fields.h"
#include "tenon/mjcf/sensors/write_instrument_site.h"
#include "tenon/mjcf/write_actuators.h"
#include "tenon/mjcf/write_elements.h"

namespace tenon::mjcf {
namespace {

using engines::mujoco::read_quaternion;
using engines::mujoco::read_vector;
using engines::mujoco::sensor_kind;
using engines::mujoco::set_sensor_numbers;
using engines::mujoco::thing_kind;
using scene::MujocoSensor;
using scene::Sensor;

constexpr double kSamePlace = 1e-6;  // [m], and of a turn: prims have floats

}  // namespace

KeptSensorWriter::KeptSensorWriter(const scene::PhysicsScene& scene,
                                   const engines::mujoco::Model& model,
                                   const std::map<std::string, mjsGeom*>& geoms, mjSpec& spec,
                                   Diagnostics& diagnostics)
    : scene_(scene), model_(model), geoms_(geoms), spec_(spec), diagnostics_(diagnostics) {}

std::set<Path> KeptSensorWriter::add(const std::vector<MujocoSensor>& sensors) {
  std::set<Path> written;
  for (const MujocoSensor& from : sensors) {
    const Sensor* instrument = instrument_of(from);
    if (const std::string fault = fault_of(from, instrument); !fault.empty()) {
      report_left_out(diagnostics_, from.path, "", fault + "; the sensor is skipped");
      continue;
    }
    if (mjsElement* element = add(from)) {
      made_.push_back({&from, element});
      if (instrument != nullptr) {
        written.insert(instrument->path);
      }
    }
  }
  return written;
}

const Sensor* KeptSensorWriter::instrument_of(const MujocoSensor& from) const {
  const auto at = std::find_if(
      scene_.sensors.begin(), scene_.sensors.end(),
      [&](const Sensor& sensor) { return from.instrument && sensor.path == *from.instrument; });
  return at == scene_.sensors.end() ? nullptr : &*at;
}

std::string KeptSensorWriter::fault_of(const MujocoSensor& from, const Sensor* instrument) const {
  if (!sensor_kind(from.kind)) {
    return "MuJoCo has no sensor \"" + from.kind + "\"";
  }
  if (from.instrument && instrument == nullptr) {
    return "the asset does not measure it any more";
  }
  return instrument != nullptr && !instrument->enabled ? "<" + instrument->path.str() + "> is off"
                                                       : std::string();
}

/// nullptr, and a finding, where the model has nothing that it can be of.
mjsElement* KeptSensorWriter::add(const MujocoSensor& from) {
  mjsSensor* made = mjs_addSensor(&spec_);
  const std::string fault = make(from, *made);
  if (!fault.empty()) {
    report_left_out(diagnostics_, from.path, "", fault + "; the sensor is skipped");
    mjs_delete(&spec_, made->element);
    return nullptr;
  }
  return made->element;
}

std::string KeptSensorWriter::make(const MujocoSensor& from, mjsSensor& made) {
  mjs_setName(made.element, from.path.str().c_str());
  made.type = *sensor_kind(from.kind);
  if (std::string fault = set_object(from, made); !fault.empty()) {
    return fault;
  }
  for (const scene::VendorSetting& setting : from.settings) {
    if (!set_sensor_numbers(made, setting.name, setting.numbers)) {
      report_left_out(diagnostics_, from.path, ("tenon:mujoco:sensor:" + setting.name).c_str(),
                      "MuJoCo's sensors have no numbers of that name and length; they are "
                      "skipped");
    }
  }
  return {};
}

/// A fault, or nothing.
std::string KeptSensorWriter::set_object(const MujocoSensor& from, mjsSensor& made) {
  const auto set = [&](const MujocoSensor::Thing& thing, mjtObj& kind, mjString* name) {
    kind = thing_kind(thing.kind);
    const std::string found = thing.kind.empty() ? "" : name_of(kind, thing.prim);
    mjs_setString(name, found.c_str());
    return thing.kind.empty() || !found.empty();
  };
  const auto missing = [](const MujocoSensor::Thing& thing) {
    return "the model has no " + thing.kind + " at <" + thing.prim.str() + ">";
  };
  if (!set(from.object, made.objtype, made.objname)) {
    return missing(from.object);
  }
  if (!set(from.reference, made.reftype, made.refname)) {
    return missing(from.reference);
  }
  const Sensor* instrument = instrument_of(from);
  if (instrument != nullptr && instrument->body && made.objtype == mjOBJ_SITE &&
      !is_at(*instrument, mjs_getString(made.objname))) {
    mjs_setString(made.objname, instrument_site(scene_, model_, spec_, *instrument).c_str());
  }
  return {};
}

/// Whether an instrument measures at a site, and in its volume.
bool KeptSensorWriter::is_at(const Sensor& instrument, const std::string& site) const {
  mjsElement* element = mjs_findElement(&spec_, mjOBJ_SITE, site.c_str());
  if (element == nullptr) {
    return false;
  }
  const mjsSite& found = *mjs_asSite(element);
  const Pose pose = instrument_pose(model_, instrument);
  const double turn =
      std::fabs(dot(normalized(pose.orientation), normalized(read_quaternion(found.quat))));
  const bool same_size = instrument.kind != scene::SensorKind::Contact ||
                         std::fabs(found.size[0] - instrument.radius) <= kSamePlace;
  return same_size && length(pose.position - read_vector(found.pos)) <= kSamePlace &&
         turn >= 1 - kSamePlace;
}

/// Of a thing in the spec; empty: there is none.
std::string KeptSensorWriter::name_of(mjtObj kind, Path prim) const {
  switch (kind) {
    case mjOBJ_BODY:
    case mjOBJ_XBODY:
      return body_name(prim);
    case mjOBJ_JOINT:
      return joint_name(prim);
    case mjOBJ_GEOM:
      return geom_name(prim);
    default:
      return mjs_findElement(&spec_, kind, prim.str().c_str()) != nullptr ? prim.str()
                                                                          : std::string();
  }
}

/// The world, where no body is at or above the prim.
std::string KeptSensorWriter::body_name(Path prim) const {
  for (Path at = prim; at.is_prim(); at = at.parent()) {
    if (mjs_findBody(&spec_, at.str().c_str()) != nullptr) {
      return at == prim ? prim.str() : std::string();  // empty: a part of a body
    }
  }
  return "world";
}

std::string KeptSensorWriter::joint_name(Path prim) const {
  for (std::size_t i = 0; i < scene_.joints.size(); ++i) {
    const scene::Joint& joint = scene_.joints[i];
    if (joint.path == prim && !model_.joints[i].reversed) {
      return joint_element(spec_, joint);
    }
  }
  return {};
}

/// What is only seen has a name where a sensor needs it.
std::string KeptSensorWriter::geom_name(Path prim) const {
  std::string path = prim.str();
  if (mjs_findElement(&spec_, mjOBJ_GEOM, path.c_str()) != nullptr) {
    return path;
  }
  const auto shown = geoms_.find(path);
  if (shown == geoms_.end()) {
    return {};
  }
  mjsElement* geom = shown->second->element;
  if (std::string(mjs_getString(mjs_getName(geom))).empty()) {
    mjs_setName(geom, path.c_str());
  }
  return mjs_getString(mjs_getName(geom));
}

Result<bool> KeptSensorWriter::retry(const Compiles& compiles) {
  for (const Made& made : made_) {
    mjs_delete(&spec_, made.element);
  }
  TENON_TRY(const bool without, compiles());
  std::vector<Made> again = without ? std::move(made_) : std::vector<Made>();
  made_.clear();
  for (const Made& made : again) {
    mjsElement* element = add(*made.from);
    TENON_TRY(const bool fits, compiles());
    if (!fits) {
      std::string words = mjs_getError(&spec_);
      std::replace(words.begin(), words.end(), '\n', ' ');
      report_left_out(diagnostics_, made.from->path, "", "MuJoCo refuses the sensor: " + words);
      mjs_delete(&spec_, element);
    }
  }
  return without;
}

}  // namespace tenon::mjcf
