// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Nobody's schema has a word for MuJoCo's sensors, so their attributes are MuJoCo's own names
// behind "tenon:mujoco:sensor". What they are of is said by relationships, which follow a prim that
// is renamed.
#include "tenon/convert/mujoco_sensors.h"

#include <optional>
#include <string>

namespace tenon::convert {
namespace {

using layer::Value;
using robot::MujocoSensor;
using robot::MujocoThing;

constexpr const char* kType = "TenonMujocoSensor";

Token sensor_name(const std::string& word) { return Token("tenon:mujoco:sensor:" + word); }

class MujocoSensorWriter {
 public:
  MujocoSensorWriter(const Source& source, const MeasuredPrims& prims, PhysicsScope& physics)
      : source_(source), prims_(prims), physics_(physics) {}

  void write(const MujocoSensor& sensor) {
    const std::optional<Path> object = prim_of(sensor.object);
    const std::optional<Path> reference = prim_of(sensor.reference);
    const std::optional<Path> instrument = instrument_of(sensor);
    if (!object || !reference || !instrument) {
      const MujocoThing& lost = !object      ? sensor.object
                                : !reference ? sensor.reference
                                             : sensor.instrument;
      physics_.layer().report({}, Severity::Warning, "convert.sensor",
                              "the sensor \"" + sensor.name + "\" (" + sensor.kind +
                                  ") is skipped: \"" + lost.name + "\" is not converted as such",
                              "");
      return;
    }
    LayerBuilder& builder = physics_.builder();
    const Path prim =
        physics_.define(sensor.name.empty() ? sensor.kind : sensor.name, Token(kType));
    builder.set_custom(prim, "tenon:mujoco:sensor", "token", Value(Token(sensor.kind)));
    write_thing(prim, "object", sensor.object, *object);
    write_thing(prim, "reference", sensor.reference, *reference);
    if (!instrument->empty()) {
      builder.set_relationship(prim, sensor_name("instrument"), {*instrument});
    }
    for (const robot::MujocoSetting& setting : sensor.settings) {
      builder.set_custom(prim, sensor_name(setting.name), "double[]",
                         Value(layer::Array<double>(setting.numbers)));
    }
  }

 private:
  void write_thing(Path prim, const std::string& role, const MujocoThing& thing, Path path) {
    if (!thing.kind.empty()) {
      physics_.builder().set_custom(prim, sensor_name(role + "Type"), "token",
                                    Value(Token(thing.kind)));
      physics_.builder().set_relationship(prim, sensor_name(role), {path});
    }
  }

  /// Empty: it is nothing; none: it has no prim.
  std::optional<Path> prim_of(const MujocoThing& thing) const {
    if (thing.name.empty()) {
      return Path();
    }
    if (thing.kind == "body" || thing.kind == "xbody") {
      return link_prim(thing.name);
    }
    if (thing.kind == "joint") {
      return joint_prim(thing.name);
    }
    const auto found_in = [&](const auto& map) {
      const auto at = map.find(thing.name);
      return at == map.end() ? std::nullopt : std::optional(at->second);
    };
    if (thing.kind == "site") {
      return found_in(prims_.shapes.sites);
    }
    if (thing.kind == "camera") {
      return found_in(prims_.shapes.cameras);
    }
    if (thing.kind == "tendon") {
      return found_in(prims_.mujoco.tendons);
    }
    if (thing.kind == "actuator") {
      const auto drive = found_in(prims_.joints.actuators);
      return drive ? drive : found_in(prims_.mujoco.actuators);
    }
    return thing.kind == "geom" ? shape_prim(thing.name) : std::nullopt;
  }

  std::optional<Path> link_prim(const std::string& name) const {
    for (robot::Index i = 0; i < source_.model.links.size(); ++i) {
      if (source_.model.links[i].name == name) {
        return prims_.links[i].path;
      }
    }
    return std::nullopt;
  }

  std::optional<Path> joint_prim(const std::string& name) const {
    for (robot::Index i = 0; i < source_.model.joints.size(); ++i) {
      if (source_.model.joints[i].name == name && !prims_.joints.joints[i].empty()) {
        return prims_.joints.joints[i];
      }
    }
    return std::nullopt;
  }

  /// The visual, else the collider in its place.
  std::optional<Path> shape_prim(const std::string& name) const {
    for (const std::string& at : {name, name + "_collider"}) {
      if (const auto found = prims_.shapes.shapes.find(at); found != prims_.shapes.shapes.end()) {
        return found->second;
      }
    }
    return std::nullopt;
  }

  /// Empty: it has none.
  std::optional<Path> instrument_of(const MujocoSensor& sensor) const {
    if (sensor.instrument.kind != "site") {
      return prim_of(sensor.instrument);
    }
    const auto at = prims_.instruments.find({sensor.instrument.name, sensor.instrument_kind});
    return at == prims_.instruments.end() ? std::nullopt : std::optional(at->second);
  }

  const Source& source_;
  const MeasuredPrims& prims_;
  PhysicsScope& physics_;
};

}  // namespace

void write_mujoco_sensors(const Source& source, const MeasuredPrims& prims, PhysicsScope& physics) {
  MujocoSensorWriter writer(source, prims, physics);
  for (const MujocoSensor& sensor : source.model.mujoco.sensors) {
    writer.write(sensor);
  }
}

}  // namespace tenon::convert
