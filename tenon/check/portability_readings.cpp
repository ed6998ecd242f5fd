// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Values that PhysX and Newton read differently from the schema: velocities, gravity, materials,
// filters, shapes. Each rule was found by running its scene (tests/check/scenes) in ovphysx 0.7 or
// Newton 1.8 on the CPU; tests/engines_beside runs such scenes again.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include "tenon/check/subject.h"
#include "tenon/math/angle.h"
#include "tenon/math/transform.h"
#include "tenon/stage/transform_at.h"

namespace tenon::check {
namespace {

using scene::Body;
using scene::Collider;
using scene::Index;

constexpr double kSameSpeed = 1e-4;  ///< [m/s] and [rad/s]
constexpr double kUnitGravity = 1e-3;
constexpr double kSameFriction = 0.01;

std::optional<Vec3d> authored_vector(const stage::Prim& prim, Token name) {
  const stage::Attribute attribute = prim.attribute(name);
  const auto found = attribute.has_authored_value() ? attribute.get_as<Vec3f>() : std::nullopt;
  return found ? std::optional<Vec3d>(Vec3d{{(*found)[0], (*found)[1], (*found)[2]}})
               : std::nullopt;
}

/// The authored velocities in SI units, as if they were given along the world's axes.
struct Velocities {
  Vec3d linear;
  Vec3d angular;
};

std::optional<Velocities> authored_velocities(const Subject& subject, const Body& body) {
  const stage::Prim prim = subject.stage.prim(body.path);
  if (!prim || body.kinematic) {
    return std::nullopt;
  }
  const Vec3d zero;
  const Vec3d linear = authored_vector(prim, "physics:velocity").value_or(zero);
  const Vec3d angular = authored_vector(prim, "physics:angularVelocity").value_or(zero);
  return Velocities{linear * subject.scene.meters_per_unit, angular * (1 / kDegreesPerRadian)};
}

bool starts_otherwise(const Body& body, const Velocities& velocities) {
  return length(body.linear_velocity - velocities.linear) > kSameSpeed ||
         length(body.angular_velocity - velocities.angular) > kSameSpeed;
}

std::string vector_text(const Vec3d& v) {
  const auto part = [&](std::size_t i) {
    return digits(std::fabs(v[i]) < kSameSpeed * length(v) ? 0 : v[i]);
  };
  return "(" + part(0) + ", " + part(1) + ", " + part(2) + ")";
}

void report_velocities(const Subject& subject, const Body& body, const Velocities& other,
                       const std::string& who, Reporter& report) {
  const bool linear = length(body.linear_velocity - other.linear) > kSameSpeed;
  report.at(subject.stage.prim(body.path), linear ? "physics:velocity" : "physics:angularVelocity",
            who + ": the body starts with " +
                (linear ? vector_text(other.linear) + " m/s there, with " +
                              vector_text(body.linear_velocity) + " here"
                        : vector_text(other.angular) + " rad/s there, with " +
                              vector_text(body.angular_velocity) + " here"),
            "leave the body and the prims above it unturned and unscaled");
}

bool something_moves(const scene::PhysicsScene& scene) {
  return std::any_of(scene.bodies.begin(), scene.bodies.end(),
                     [](const Body& body) { return !body.kinematic; });
}

/// Materials that colliders which touch things have.
std::set<Index> used_materials(const scene::PhysicsScene& scene) {
  std::set<Index> used;
  for (const Collider& collider : scene.colliders) {
    if (collider.enabled && collider.material) {
      used.insert(*collider.material);
    }
  }
  return used;
}

std::string merge_name(const stage::Prim& prim) {
  return prim.attribute("physics:mergeGroup").get_as<std::string>().value_or("");
}

/// Shapes that a shear changes beyond what portability.stretched-sphere says.
bool keeps_shear(const scene::Shape& shape) {
  return shape.kind != scene::ShapeKind::Plane && shape.kind != scene::ShapeKind::Ellipsoid &&
         shape.kind != scene::ShapeKind::Spheres;
}

double largest_half(const scene::Shape& shape) {
  return std::fmax(std::fmax(shape.half_extents[0], shape.half_extents[1]), shape.half_extents[2]);
}

}  // namespace

// S-30
void check_physx_velocity(const Subject& subject, Reporter& report) {
  for (const Body& body : subject.scene.bodies) {
    const auto world = authored_velocities(subject, body);
    if (world && starts_otherwise(body, *world) &&
        subject.has_finding("body.velocity-space", body.path.str())) {
      report_velocities(subject, body, *world, "PhysX takes velocities along the axes of the world",
                        report);
    }
  }
}

// S-30
void check_newton_velocity(const Subject& subject, Reporter& report) {
  for (const Body& body : subject.scene.bodies) {
    const auto world = authored_velocities(subject, body);
    if (!world || !subject.has_finding("body.velocity-space", body.path.str())) {
      continue;
    }
    const Velocities own{rotate(body.pose.orientation, world->linear),
                         rotate(body.pose.orientation, world->angular)};
    if (starts_otherwise(body, own)) {
      report_velocities(subject, body, own, "Newton takes velocities along the body's own axes",
                        report);
    }
  }
}

// S-14, S-15
void check_physx_gravity(const Subject& subject, Reporter& report) {
  for (const scene::Scene& scene : subject.scene.scenes) {
    const stage::Prim prim = subject.stage.prim(scene.path);
    if (!prim) {
      continue;
    }
    const double size = length(authored_vector(prim, "physics:gravityDirection").value_or(Vec3d()));
    const double magnitude = authored_number(prim, "physics:gravityMagnitude").value_or(0);
    if (magnitude < 0) {
      report.at(
          prim, "physics:gravityMagnitude",
          std::isinf(magnitude)
              ? "PhysX takes an authored magnitude as it is, and its bodies have no position"
              : "PhysX takes a negative magnitude as it is: bodies fall upwards there, with " +
                    digits(length(scene.gravity)) + " m/s^2 downwards here",
          "leave the magnitude out, or author a positive one");
    } else if (size > 0 && std::fabs(size - 1) > kUnitGravity && length(scene.gravity) > 0) {
      report.at(prim, "physics:gravityDirection",
                "PhysX multiplies gravity by the length of its direction: " +
                    digits(size * length(scene.gravity)) + " m/s^2 there, " +
                    digits(length(scene.gravity)) + " here",
                "author a direction of length 1");
    }
  }
}

// S-27
void check_physx_kinematic(const Subject& subject, Reporter& report) {
  for (const Body& body : subject.scene.bodies) {
    if (subject.has_finding("body.kinematic-velocity", body.path.str())) {
      report.at(subject.stage.prim(body.path), "physics:velocity",
                "PhysX takes the velocity of a kinematic body as one of its surface, which carries "
                "what lies on it; here it has no effect",
                "apply PhysxSurfaceVelocityAPI, or remove the velocity");
    }
  }
}

// S-71
void check_physx_static_friction(const Subject& subject, Reporter& report) {
  for (const Index index : used_materials(subject.scene)) {
    const scene::Material& material = subject.scene.materials[index];
    if (material.static_friction > material.dynamic_friction * (1 + kSameFriction) &&
        something_moves(subject.scene)) {
      report.at(subject.stage.prim(material.path), "physics:staticFriction",
                "PhysX holds what rests by the static friction of " +
                    digits(material.static_friction) + "; here, on MuJoCo, the dynamic one of " +
                    digits(material.dynamic_friction) + " counts from the start",
                "author both coefficients alike");
    }
  }
}

// S-72
void check_newton_friction(const Subject& subject, Reporter& report) {
  double least = kInfinity;
  double most = -kInfinity;
  const scene::Material* largest = nullptr;
  for (const Index index : used_materials(subject.scene)) {
    const scene::Material& material = subject.scene.materials[index];
    least = std::fmin(least, material.dynamic_friction);
    if (material.dynamic_friction > most) {
      most = material.dynamic_friction;
      largest = &material;
    }
  }
  if (largest != nullptr && most > least + kSameFriction && something_moves(subject.scene)) {
    report.at(subject.stage.prim(largest->path), "physics:dynamicFriction",
              "of the frictions of two materials Newton's MuJoCo solver takes the larger: " +
                  digits(most) + " and " + digits(least) + " are " + digits(most) + " there, " +
                  digits((most + least) / 2) + " here",
              "give what touches one another the same friction");
  }
}

void check_newton_restitution(const Subject& subject, Reporter& report) {
  for (const Index index : used_materials(subject.scene)) {
    const scene::Material& material = subject.scene.materials[index];
    if (material.restitution > 0 && something_moves(subject.scene)) {
      report.at(subject.stage.prim(material.path), "physics:restitution",
                "Newton's MuJoCo solver leaves the restitution of " + digits(material.restitution) +
                    " out: nothing bounces there",
                "author contacts of MuJoCo (mjc:solref) for that engine");
    }
  }
}

// S-29
void check_newton_sleep(const Subject& subject, Reporter& report) {
  for (const Body& body : subject.scene.bodies) {
    if (body.starts_asleep && !body.kinematic) {
      report.at(subject.stage.prim(body.path), "physics:startsAsleep",
                "Newton ignores physics:startsAsleep: the body moves from the start there",
                "place the body where it rests by itself");
    }
  }
}

// S-78, S-79
void check_physx_groups(const Subject& subject, Reporter& report) {
  std::map<std::string, std::size_t> merged;
  for (const stage::Prim& prim : subject.prims) {
    if (prim.type_name() == "PhysicsCollisionGroup") {
      merged[merge_name(prim)] += 1;
    }
  }
  for (const stage::Prim& prim : subject.prims) {
    if (prim.type_name() != "PhysicsCollisionGroup") {
      continue;
    }
    if (authored_flag(prim, "physics:invertFilteredGroups").value_or(false)) {
      report.at(
          prim, "physics:invertFilteredGroups",
          "PhysX ignores the inversion: the groups that this one lists are those that it does "
          "not touch there, and the only ones that it touches here",
          "list the groups that it is not to touch");
    }
    if (!merge_name(prim).empty() && merged[merge_name(prim)] > 1) {
      report.at(prim, "physics:mergeGroup",
                "PhysX ignores physics:mergeGroup: the groups keep their own members and filters",
                "author one group with all members");
    }
  }
}

// S-53
void check_physx_ellipsoids(const Subject& subject, Reporter& report) {
  for (const Collider& collider : subject.scene.colliders) {
    if (collider.enabled && collider.shape.kind == scene::ShapeKind::Ellipsoid) {
      report.at(subject.stage.prim(collider.path),
                "PhysX makes a ball of the stretched sphere, of its largest radius, " +
                    digits(largest_half(collider.shape)) + " m",
                "scale the sphere evenly, or use a mesh with the approximation convexHull");
    }
  }
}

// S-33, S-56
void check_physx_shear(const Subject& subject, Reporter& report) {
  std::set<Path> told;  // a mesh of several pieces has several colliders
  stage::TransformCache worlds(stage::Time{});
  for (const Collider& collider : subject.scene.colliders) {
    const stage::Prim prim = subject.stage.prim(collider.path);
    if (!prim || !collider.enabled || !keeps_shear(collider.shape)) {
      continue;
    }
    const Mat4d world = worlds.local_to_world(prim);
    if (factor(world).sheared && told.insert(collider.path).second) {
      const auto stretch = [&](const Vec3d& axis) {
        return digits(length(axis * upper_left(world)));
      };
      report.at(prim,
                "PhysX leaves the shear out: it stretches the collider along its own axes by " +
                    stretch({{1, 0, 0}}) + ", " + stretch({{0, 1, 0}}) + " and " +
                    stretch({{0, 0, 1}}) + ", and keeps them at right angles",
                "remove the non-uniform scale above the turned collider");
    }
  }
}

// S-40
void check_physx_mass_between(const Subject& subject, Reporter& report) {
  for (const stage::Prim& prim : subject.prims) {
    if (subject.has_finding("mass.between", prim.path().str())) {
      report.at(prim,
                "PhysX ignores a PhysicsMassAPI between a body and its colliders, which counts "
                "here",
                "apply it to the body or to the colliders");
    }
  }
}

// S-58
void check_physx_points(const Subject& subject, Reporter& report) {
  for (const Collider& collider : subject.scene.colliders) {
    if (collider.enabled && collider.shape.kind == scene::ShapeKind::Spheres) {
      report.at(subject.stage.prim(collider.path),
                "PhysX makes no collider of Points: what they touch here passes through there",
                "use a Sphere for each point");
    }
  }
}

void check_physx_tendons(const Subject& subject, Reporter& report) {
  const auto& joints = subject.scene.joints;
  for (const scene::Tendon& tendon : subject.scene.tendons) {
    for (const Index index : tendon.joints) {
      const stage::Prim prim = subject.stage.prim(joints[index].path);
      const bool is_branch = prim && !prim.api_instances("PhysxTendonAxisAPI").empty() &&
                             prim.api_instances("PhysxTendonAxisRootAPI").empty();
      const bool follows =
          std::any_of(tendon.joints.begin(), tendon.joints.end(), [&](Index other) {
            return joints[other].body1 && joints[other].body1 == joints[index].body0;
          });
      if (is_branch && !follows) {
        report.at(prim,
                  "PhysX leaves this joint out of its tendon: its parent link is not the child of "
                  "another joint of the tendon",
                  "let the tendon run from joint to joint along the links, or use a mimic");
      }
    }
  }
}

}  // namespace tenon::check
