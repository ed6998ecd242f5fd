// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// One sample holds all instances, so each frame writes whole arrays, in which those without a
// moving body stay as at the start. With row vectors the world of a body is its place in the
// prototype times scale, pose and world of the instancer. Both outer factors are taken off by their
// inverses and the scale by dividing rows; the rigid part of the rest is the pose. An instance has
// one pose, so an instance with several bodies cannot be written. No opinion counts on an instancer
// inside an instance.
#include "tenon/bake/instance_arrays.h"

#include <map>
#include <string>

#include "tenon/bake/over_specs.h"
#include "tenon/physics/point_instancers.h"
#include "tenon/stage/transform_at.h"

namespace tenon::bake {
namespace {

using layer::Value;

/// What the arrays say at the start, and what moves.
struct Instancer {
  stage::Prim prim;
  physics::InstancerReading reading;
  std::map<std::uint32_t, std::size_t> body_of;  ///< by index into the arrays
  bool crowded = false;                          ///< some instance has several bodies
};

void report(const stage::Prim& prim, const std::string& why, Diagnostics& diagnostics) {
  Diagnostic finding = prim.located(
      Severity::Warning, "bake.instanced-body",
      "the bodies of the point instancer <" + prim.path().str() + "> cannot be animated: " + why);
  finding.fix = "give each prototype one body, and keep point instancers out of instances";
  diagnostics.add(std::move(finding));
}

/// Instancers with bodies that move, by path.
std::map<Path, Instancer> instancers_of(const stage::Stage& stage, const scene::PhysicsScene& scene,
                                        Diagnostics& diagnostics) {
  std::map<Path, Instancer> found;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const scene::Body& body = scene.bodies[i];
    if (!body.instance || body.kinematic) {
      continue;
    }
    Instancer& instancer = found[body.instance->instancer];
    instancer.prim = stage.prim(body.instance->instancer);
    instancer.crowded = !instancer.body_of.emplace(body.instance->index, i).second ||
                        body.instance->nested || instancer.crowded;
  }
  for (auto at = found.begin(); at != found.end();) {
    const bool proxy = at->second.prim.is_instance_proxy();
    if (proxy || at->second.crowded) {
      report(at->second.prim,
             proxy ? "it is inside an instance" : "an instance holds several of them", diagnostics);
      at = found.erase(at);
    } else {
      ++at;
    }
  }
  return found;
}

/// The arrays of all instances, where they are drawn or not, at the start.
struct Placement {
  std::vector<Vec3f> positions;
  std::vector<Quatf> orientations;
};

void put(const Pose& pose, std::size_t i, Placement& frame) {
  frame.positions[i] = to_float(pose.position);
  frame.orientations[i] = to_float(pose.orientation);
}

Placement start_of(const Instancer& instancer) {
  Placement frame;
  const std::vector<Pose>& poses = instancer.reading.poses;
  frame.positions.resize(poses.size());
  frame.orientations.resize(poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    put(poses[i], i, frame);
  }
  return frame;
}

/// Scale, rotation and translation that bring a body to its world pose: rotation and translation,
/// the scale being authored.
Pose placement_of(const Mat4d& body_to_top, const Mat4d& world, const Mat4d& instancer_world,
                  const Vec3d& scale) {
  Mat4d local = inverse(body_to_top) * world * inverse(instancer_world);
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) {
      local[row][column] /= scale[row] != 0 ? scale[row] : 1;
    }
  }
  return rigid_part(local);
}

class ArrayWriter {
 public:
  ArrayWriter(const stage::Stage& stage, const scene::PhysicsScene& scene,
              const PoseRecording& recording, const BodyTransforms& transforms, layer::Layer& layer)
      : stage_(stage),
        scene_(scene),
        recording_(recording),
        transforms_(transforms),
        layer_(layer) {}

  void write(const Instancer& instancer) {
    layer::TimeSamples positions;
    layer::TimeSamples orientations;
    Placement frame = start_of(instancer);
    for (std::size_t i = 0; i < recording_.frame_count(); ++i) {
      const double code =
          scene_.start_time_code + recording_.times[i] * scene_.time_codes_per_second;
      place(instancer, i, code, frame);
      positions.set(code, Value(layer::Array<Vec3f>(frame.positions)));
      orientations.set(code, Value(layer::Array<Quatf>(frame.orientations)));
    }
    const Path path = instancer.prim.path();
    over_attribute(layer_, path, "positions", "point3f[]").set("timeSamples", Value(positions));
    over_attribute(layer_, path, "orientationsf", "quatf[]")
        .set("timeSamples", Value(orientations));
    for (const char* name : {"velocities", "angularVelocities", "accelerations"}) {
      if (instancer.prim.attribute(name).has_authored_value()) {
        over_attribute(layer_, path, name, "vector3f[]").set("default", Value(layer::ValueBlock{}));
      }
    }
  }

 private:
  void place(const Instancer& instancer, std::size_t at, double code, Placement& frame) const {
    const Mat4d world = transforms_.world_of_prim(instancer.prim, recording_, at, code);
    for (const physics::ArrayInstance& instance : instancer.reading.instances) {
      const auto body = instancer.body_of.find(instance.index);
      if (body == instancer.body_of.end()) {
        continue;
      }
      const scene::InstanceSource& source = *scene_.bodies[body->second].instance;
      const Mat4d in_instance =
          stage::local_to_ancestor(stage_.prim(source.prim), source.prototype.parent(), code);
      const Pose pose =
          placement_of(in_instance, transforms_.world_of_body(body->second, recording_, at), world,
                       instance.scale);
      put(pose, instance.index, frame);
    }
  }

  const stage::Stage& stage_;
  const scene::PhysicsScene& scene_;
  const PoseRecording& recording_;
  const BodyTransforms& transforms_;
  layer::Layer& layer_;
};

}  // namespace

void write_instance_arrays(const stage::Stage& stage, const scene::PhysicsScene& scene,
                           const PoseRecording& recording, const BodyTransforms& transforms,
                           layer::Layer& layer, Diagnostics& diagnostics) {
  Diagnostics said;  // while the scene was read
  const physics::AttributeValues values(stage::Time(scene.start_time_code),
                                        physics::LayerContents{.animated = true},
                                        physics::ValueTypes::Strict, said);
  for (auto& [path, instancer] : instancers_of(stage, scene, diagnostics)) {
    instancer.reading = physics::read_point_instancer(values, instancer.prim);
    ArrayWriter(stage, scene, recording, transforms, layer).write(instancer);
  }
}

}  // namespace tenon::bake
