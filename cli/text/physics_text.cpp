// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Prints each list of the neutral description, an object a line, with limits, drives and mimics
// below their joints. Ranges of angles are shown in degrees, all else stays in SI and radians; a
// range whose lower end is above the upper one means locked.
#include "cli/text/physics_text.h"

#include <cmath>

#include "tenon/base/text/rounded_text.h"
#include "tenon/math/angle.h"
#include "tenon/scene/joint_freedom.h"

namespace tenon::cli {
namespace {

using scene::PhysicsScene;

std::string text(double value) { return rounded_text(value); }

std::string text(const Vec3d& v) {
  return "(" + text(v[0]) + ", " + text(v[1]) + ", " + text(v[2]) + ")";
}

std::string plural(std::size_t count, const char* one, const char* many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

/// Degrees for angles, millimetres would hide scale: metres for lengths.
std::string range(double lower, double upper, bool angular) {
  const auto end = [&](double x) {
    return std::isinf(x) ? std::string("unlimited")
                         : text(angular ? x * kDegreesPerRadian : x) + (angular ? " deg" : " m");
  };
  return lower > upper ? "locked" : end(lower) + " to " + end(upper);
}

std::string shape_text(const PhysicsScene& scene, const scene::Shape& shape) {
  std::string line(scene::shape_name(shape.kind));
  switch (shape.kind) {
    case scene::ShapeKind::Box:
    case scene::ShapeKind::Ellipsoid:
      return line + ", half extents " + text(shape.half_extents) + " m";
    case scene::ShapeKind::Sphere:
      return line + ", radius " + text(shape.radius) + " m";
    case scene::ShapeKind::Capsule:
    case scene::ShapeKind::Cylinder:
    case scene::ShapeKind::Cone:
      return line + ", radius " + text(shape.radius) + " m, half height " +
             text(shape.half_height) + " m";
    case scene::ShapeKind::ConvexHull:
    case scene::ShapeKind::Mesh:
      return line + " of " + std::to_string(scene.meshes[shape.mesh].points.size()) + " points";
    case scene::ShapeKind::Spheres:
      return line + ", " + std::to_string(shape.sphere_radii.size());
    case scene::ShapeKind::Plane:
      break;
  }
  return line;
}

std::string body_line(const scene::Body& body) {
  return "  " + body.path.str() + (body.kinematic ? "  kinematic" : "") + "  mass " +
         text(body.mass) + " kg (" + std::string(scene::mass_source_name(body.mass_source)) +
         "), at " + text(body.pose.position) + " m, centre of mass " + text(body.center_of_mass) +
         " m\n";
}

std::string collider_line(const PhysicsScene& scene, const scene::Collider& collider) {
  std::string line = "  " + collider.path.str() + "  " + shape_text(scene, collider.shape);
  line += collider.body ? ", of " + scene.bodies[*collider.body].path.str() : ", static";
  if (collider.material) {
    line += ", material " + scene.materials[*collider.material].path.str();
  }
  return line + (collider.enabled ? "\n" : ", disabled\n");
}

std::string side(const PhysicsScene& scene, const std::optional<scene::Index>& body) {
  return body ? scene.bodies[*body].path.str() : std::string("world");
}

/// "rotX" and `behind` of joints with several axes; empty for others.
std::string axis_word(const scene::Joint& joint, scene::Dof dof, const char* behind) {
  return scene::has_one_dof(joint) ? std::string() : std::string(scene::dof_name(dof)) + behind;
}

std::string joint_lines(const PhysicsScene& scene, const scene::Joint& joint) {
  std::string lines = "  " + joint.path.str() + "  " +
                      std::string(scene::joint_kind_name(joint.kind)) +
                      (joint.enabled ? "" : " (disabled)") + "  " + side(scene, joint.body0) +
                      " - " + side(scene, joint.body1);
  const bool angular = joint.kind == scene::JointKind::Revolute;
  if (angular || joint.kind == scene::JointKind::Prismatic ||
      joint.kind == scene::JointKind::Distance) {
    lines += ", " + range(joint.lower, joint.upper, angular);
  }
  lines += "\n";
  for (const scene::Limit& limit : joint.limits) {
    lines += "    limit " + std::string(scene::dof_name(limit.dof)) + ": " +
             range(limit.lower, limit.upper, scene::is_angular(limit.dof)) + "\n";
  }
  for (const scene::Drive& drive : joint.drives) {
    lines += "    drive " + std::string(scene::dof_name(drive.dof)) +
             (drive.acceleration ? " (acceleration)" : "") + ": stiffness " +
             text(drive.stiffness) + ", damping " + text(drive.damping) + ", " +
             (std::isinf(drive.max_force) ? std::string("no force limit")
                                          : "at most " + text(drive.max_force)) +
             ", to " + text(drive.target_position) + " at " + text(drive.target_velocity) + "\n";
  }
  for (const scene::Mimic& mimic : joint.mimics) {
    const scene::Joint& leader = scene.joints[mimic.leader];
    lines += "    " + axis_word(joint, mimic.dof, " ") + "follows " +
             axis_word(leader, mimic.leader_dof, " of ") + leader.path.str() + ": " +
             text(mimic.multiplier) + " times, plus " + text(mimic.offset) + " (" + mimic.schema +
             ")\n";
  }
  return lines;
}

std::string sensor_line(const PhysicsScene& scene, const scene::Sensor& sensor) {
  std::string line = "  " + sensor.path.str() + "  " + std::string(sensor_kind_name(sensor.kind));
  if (sensor.body) {
    line += ", of " + scene.bodies[*sensor.body].path.str() + " at " + text(sensor.pose.position) +
            " m";
  }
  if (sensor.kind == scene::SensorKind::ForceTorque) {
    line += ", held by " + scene.joints[*sensor.joint].path.str();
  }
  if (sensor.kind == scene::SensorKind::Rays) {
    line += ", " + plural(sensor.ray_directions.size(), "ray", "rays");
  }
  return line + (sensor.enabled ? "\n" : ", off\n");
}

}  // namespace

std::string physics_text(const PhysicsScene& scene) {
  std::string out = plural(scene.scenes.size(), "scene", "scenes") + "\n";
  for (const scene::Scene& s : scene.scenes) {
    out += "  " + (s.path.empty() ? std::string("(implicit)") : s.path.str()) + "  gravity " +
           text(s.gravity) + " m/s^2\n";
  }
  out += plural(scene.bodies.size(), "body", "bodies") + "\n";
  for (const scene::Body& body : scene.bodies) {
    out += body_line(body);
  }
  out += plural(scene.colliders.size(), "collider", "colliders") + "\n";
  for (const scene::Collider& collider : scene.colliders) {
    out += collider_line(scene, collider);
  }
  out += plural(scene.joints.size(), "joint", "joints") +
         " (forces in N and N m, angles in radians "
         "unless marked)\n";
  for (const scene::Joint& joint : scene.joints) {
    out += joint_lines(scene, joint);
  }
  out += plural(scene.articulations.size(), "articulation", "articulations") + "\n";
  for (const scene::Articulation& articulation : scene.articulations) {
    out += "  " + articulation.path.str() + "  root " + articulation.root.str() +
           (articulation.fixed_base ? ", fixed base, " : ", floating base, ") +
           plural(articulation.links.size(), "link", "links") + "\n";
  }
  if (!scene.sensors.empty()) {
    out += plural(scene.sensors.size(), "sensor", "sensors") + "\n";
    for (const scene::Sensor& sensor : scene.sensors) {
      out += sensor_line(scene, sensor);
    }
  }
  const scene::ColliderPairs apart = scene.disabled_pairs();
  out += (apart.is_cut ? "more than " : "") +
         plural(apart.pairs.size(), "disabled collider pair", "disabled collider pairs") + "\n";
  if (!scene.not_read.empty()) {
    out += "not taken over\n";
    for (const scene::NotRead& row : scene.not_read) {
      out += "  " + row.prim.str() + "  " + row.property + ": " + row.why + "\n";
    }
  }
  return out;
}

}  // namespace tenon::cli
