// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/diff/physics_facts.h"

namespace tenon::diff {
namespace {

using physics::Index;
using physics::PhysicsScene;

std::string body_name(const PhysicsScene& scene, const std::optional<Index>& body) {
  return body ? scene.bodies[*body].path.str() : std::string("world");
}

void add_pose(FactList& facts, const Pose& pose) {
  facts.vector("position", "m", pose.position).rotation("orientation", pose.orientation);
}

std::vector<double> flat(const std::vector<Vec3d>& points) {
  std::vector<double> numbers;
  numbers.reserve(3 * points.size());
  for (const Vec3d& point : points) {
    numbers.insert(numbers.end(), point.v.begin(), point.v.end());
  }
  return numbers;
}

void add_mesh(FactList& facts, const physics::TriangleMesh& mesh) {
  std::vector<double> corners;
  corners.reserve(3 * mesh.triangles.size());
  for (const Vec3i& triangle : mesh.triangles) {
    corners.insert(corners.end(), triangle.v.begin(), triangle.v.end());
  }
  facts.number("points of the mesh", "", static_cast<double>(mesh.points.size()))
      .number("triangles of the mesh", "", static_cast<double>(mesh.triangles.size()))
      .numbers("coordinates of the points", "m", flat(mesh.points))
      .numbers("corners of the triangles", "", std::move(corners));
}

void add_shape(FactList& facts, const PhysicsScene& scene, const physics::Shape& shape) {
  static constexpr const char* kAxes[] = {"X", "Y", "Z"};
  using physics::ShapeKind;
  facts.word("shape", std::string(physics::shape_name(shape.kind)));
  switch (shape.kind) {
    case ShapeKind::Box:
    case ShapeKind::Ellipsoid:
      facts.vector("half extents", "m", shape.half_extents);
      return;
    case ShapeKind::Sphere:
      facts.number("radius", "m", shape.radius);
      return;
    case ShapeKind::Capsule:
    case ShapeKind::Cylinder:
    case ShapeKind::Cone:
      facts.number("radius", "m", shape.radius).number("half height", "m", shape.half_height);
      facts.word("axis of the shape", kAxes[static_cast<int>(shape.axis)]);
      return;
    case ShapeKind::Plane:
      facts.word("axis of the shape", kAxes[static_cast<int>(shape.axis)]);
      return;
    case ShapeKind::ConvexHull:
    case ShapeKind::Mesh:
      add_mesh(facts, scene.meshes[shape.mesh]);
      return;
    case ShapeKind::Spheres:
      facts.numbers("centres of the spheres", "m", flat(shape.sphere_centers));
      facts.numbers("radii of the spheres", "m", shape.sphere_radii);
      return;
  }
}

std::string listed(const PhysicsScene& scene, const std::vector<Index>& joints) {
  std::string text;
  for (const Index joint : joints) {
    text += (text.empty() ? "" : ", ") + scene.joints[joint].path.str();
  }
  return text;
}

/// Units of a degree of freedom.
struct Units {
  const char* position;
  const char* velocity;
  const char* force;
  const char* stiffness;
  const char* damping;
  const char* inertia;
};
constexpr Units kAngular{"rad", "rad/s", "N m", "N m/rad", "N m s/rad", "kg m^2"};
constexpr Units kLinear{"m", "m/s", "N", "N/m", "N s/m", "kg"};

const Units& units_of(physics::Dof dof) { return physics::is_angular(dof) ? kAngular : kLinear; }

const Units& units_of(const physics::Joint& joint) {
  const bool linear =
      joint.kind == physics::JointKind::Prismatic || joint.kind == physics::JointKind::Distance;
  return linear ? kLinear : kAngular;
}

void add_drives(FactList& facts, const physics::Joint& joint) {
  for (const physics::Drive& drive : joint.drives) {
    const Units& units = units_of(drive.dof);
    const std::string name = "drive " + std::string(physics::dof_name(drive.dof)) + " ";
    const auto number = [&](const char* what, const char* unit, double value) {
      facts.number((name + what).c_str(), unit, value);
    };
    facts.word((name + "type").c_str(), drive.acceleration ? "acceleration" : "force");
    number("stiffness", units.stiffness, drive.stiffness);
    number("damping", units.damping, drive.damping);
    number("maximum force", units.force, drive.max_force);
    number("target position", units.position, drive.target_position);
    number("target velocity", units.velocity, drive.target_velocity);
  }
}

void add_mimic(FactList& facts, const PhysicsScene& scene, const physics::Joint& joint) {
  if (!joint.mimic) {
    return;
  }
  const physics::Mimic& mimic = *joint.mimic;
  facts.word("mimic leader", scene.joints[mimic.leader].path.str())
      .number("mimic multiplier", "", mimic.multiplier)
      .number("mimic offset", units_of(joint).position, mimic.offset)
      .number("mimic natural frequency", "rad/s", mimic.natural_frequency)
      .number("mimic damping ratio", "", mimic.damping_ratio)
      .numbers("mimic higher coefficients", "", {mimic.higher.begin(), mimic.higher.end()})
      .numbers("mimic solref of MuJoCo", "", mimic.mujoco_solref)
      .numbers("mimic solimp of MuJoCo", "", mimic.mujoco_solimp);
}

void add_limits(FactList& facts, const physics::Joint& joint) {
  const Units& units = units_of(joint);
  facts.number("lower limit", units.position, joint.lower)
      .number("upper limit", units.position, joint.upper)
      .number("cone angle 0", "rad", joint.cone_angle0)
      .number("cone angle 1", "rad", joint.cone_angle1)
      .number("velocity limit", units.velocity, joint.velocity_limit);
  for (const physics::Limit& limit : joint.limits) {
    const std::string name(physics::dof_name(limit.dof));
    facts.number((name + " lower limit").c_str(), units_of(limit.dof).position, limit.lower);
    facts.number((name + " upper limit").c_str(), units_of(limit.dof).position, limit.upper);
  }
}

}  // namespace

FactList& FactList::number(const char* name, const char* unit, double value) {
  return numbers(name, unit, {value});
}

FactList& FactList::numbers(const char* name, const char* unit, std::vector<double> values) {
  facts_.push_back({name, unit, std::move(values), {}, false});
  return *this;
}

FactList& FactList::vector(const char* name, const char* unit, const Vec3d& value) {
  return numbers(name, unit, {value.v.begin(), value.v.end()});
}

FactList& FactList::rotation(const char* name, const Quatd& value) {
  facts_.push_back({name, "", {value.w, value.x, value.y, value.z}, {}, true});
  return *this;
}

FactList& FactList::word(const char* name, std::string value) {
  facts_.push_back({name, "", {}, std::move(value), false});
  return *this;
}

Facts facts_of(const physics::Scene& scene) {
  FactList facts;
  facts.vector("gravity", "m/s^2", scene.gravity);
  if (scene.time_step) {
    facts.number("time step", "s", *scene.time_step);
  }
  if (scene.mujoco) {
    add_mujoco(facts, *scene.mujoco);
  }
  return facts.take();
}

Facts facts_of(const physics::Body& body) {
  FactList facts;
  std::vector<double> inertia;
  for (const auto& row : body.inertia.m) {
    inertia.insert(inertia.end(), row.begin(), row.end());
  }
  facts.flag("kinematic", body.kinematic)
      .flag("enabled", body.enabled)
      .flag("starts asleep", body.starts_asleep);
  add_pose(facts, body.pose);
  facts.number("mass", "kg", body.mass)
      .vector("centre of mass", "m", body.center_of_mass)
      .numbers("inertia", "kg m^2", std::move(inertia))
      .word("mass is", std::string(physics::mass_source_name(body.mass_source)))
      .vector("linear velocity", "m/s", body.linear_velocity)
      .vector("angular velocity", "rad/s", body.angular_velocity)
      .number("linear damping", "1/s", body.linear_damping)
      .number("angular damping", "1/s", body.angular_damping)
      .number("gravity scale", "", body.gravity_scale);
  return facts.take();
}

Facts facts_of(const physics::Material& material) {
  FactList facts;
  facts.number("static friction", "", material.static_friction)
      .number("dynamic friction", "", material.dynamic_friction)
      .number("restitution", "", material.restitution)
      .number("density", "kg/m^3", material.density);
  if (material.torsional_friction) {
    facts.number("torsional friction", "m", *material.torsional_friction);
  }
  if (material.rolling_friction) {
    facts.number("rolling friction", "m", *material.rolling_friction);
  }
  return facts.take();
}

Facts facts_of(const PhysicsScene& scene, const physics::Collider& collider) {
  FactList facts;
  facts.word("body", body_name(scene, collider.body));
  add_shape(facts, scene, collider.shape);
  add_pose(facts, collider.pose);
  facts.word("material",
             collider.material ? scene.materials[*collider.material].path.str() : "none");
  facts.flag("enabled", collider.enabled);
  if (collider.approximation) {
    facts.word("approximation", std::string(physics::approximation_name(*collider.approximation)));
  }
  if (collider.contact_offset) {
    facts.number("contact offset", "m", *collider.contact_offset);
  }
  if (collider.rest_offset) {
    facts.number("rest offset", "m", *collider.rest_offset);
  }
  if (collider.max_hull_vertices) {
    facts.number("most vertices of the hull", "", *collider.max_hull_vertices);
  }
  add_mujoco(facts, collider.mujoco);
  for (const physics::FaceMaterial& faces : collider.face_materials) {
    facts.word(("material of " + faces.subset.name().str()).c_str(),
               faces.material ? scene.materials[*faces.material].path.str() : "none");
  }
  return facts.take();
}

Facts facts_of(const PhysicsScene& scene, const physics::Joint& joint) {
  static constexpr const char* kAxes[] = {"X", "Y", "Z"};
  const Units& units = units_of(joint);
  FactList facts;
  facts.word("kind", std::string(physics::joint_kind_name(joint.kind)))
      .word("body 0", body_name(scene, joint.body0))
      .word("body 1", body_name(scene, joint.body1))
      .word("axis", kAxes[static_cast<int>(joint.axis)])
      .vector("position in body 0", "m", joint.frame0.position)
      .rotation("orientation in body 0", joint.frame0.orientation)
      .vector("position in body 1", "m", joint.frame1.position)
      .rotation("orientation in body 1", joint.frame1.orientation);
  add_limits(facts, joint);
  add_drives(facts, joint);
  add_mimic(facts, scene, joint);
  facts.flag("enabled", joint.enabled)
      .flag("bodies collide", joint.collision_enabled)
      .flag("excluded from the articulation", joint.exclude_from_articulation)
      .number("break force", "N", joint.break_force)
      .number("break torque", "N m", joint.break_torque)
      .number("armature", units.inertia, joint.armature)
      .number("friction", units.force, joint.friction)
      .number("damping", units.damping, joint.damping)
      .number("stiffness", units.stiffness, joint.stiffness)
      .number("rest position of the spring", units.position, joint.spring_reference);
  if (joint.initial_position) {
    facts.number("initial position", units.position, *joint.initial_position);
  }
  if (joint.initial_velocity) {
    facts.number("initial velocity", units.velocity, *joint.initial_velocity);
  }
  add_mujoco(facts, joint.mujoco);
  return facts.take();
}

Facts facts_of(const PhysicsScene& scene, const physics::Articulation& articulation) {
  std::string links;
  for (const Index link : articulation.links) {
    links += (links.empty() ? "" : ", ") + scene.bodies[link].path.str();
  }
  FactList facts;
  facts.word("root", articulation.root.str())
      .flag("fixed to the world", articulation.fixed_base)
      .flag("self-collision", articulation.self_collision)
      .word("links", links)
      .word("joints", listed(scene, articulation.joints))
      .word("joints of loops", listed(scene, articulation.loop_joints));
  return facts.take();
}

}  // namespace tenon::diff
