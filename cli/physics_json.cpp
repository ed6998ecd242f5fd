// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/physics_json.h"

#include <cmath>
#include <optional>

namespace tenon::cli {
namespace {

using physics::Index;
using physics::PhysicsScene;
using Json = nlohmann::ordered_json;

/// A number; null when it is not finite (unlimited).
Json number(double value) { return std::isfinite(value) ? Json(value + 0.0) : Json(nullptr); }

Json vector(const Vec3d& v) { return {number(v[0]), number(v[1]), number(v[2])}; }

/// Real part first and not negative: q and -q are one rotation.
Json rotation(const Quatd& q) {
  const double sign = q.w < 0 ? -1 : 1;
  return {number(sign * q.w), number(sign * q.x), number(sign * q.y), number(sign * q.z)};
}

Json matrix(const Mat3d& m) {
  Json result = Json::array();
  for (const auto& row : m.m) {
    for (const double x : row) {
      result.push_back(number(x));
    }
  }
  return result;
}

Json path_or_null(const Path& path) { return path.empty() ? Json(nullptr) : Json(path.str()); }

template <class T>
Json path_of(const std::vector<T>& list, const std::optional<Index>& index) {
  return index ? Json(list[*index].path.str()) : Json(nullptr);
}

template <class T>
Json paths_of(const std::vector<T>& list, const std::vector<Index>& indices) {
  Json result = Json::array();
  for (const Index i : indices) {
    result.push_back(list[i].path.str());
  }
  return result;
}

Json settings_json(const std::vector<physics::MujocoSetting>& settings) {
  Json rows = Json::object();
  for (const physics::MujocoSetting& setting : settings) {
    rows[setting.name] = setting.token.empty() ? Json(setting.numbers) : Json(setting.token);
  }
  return rows;
}

Json scenes_json(const PhysicsScene& scene) {
  Json list = Json::array();
  for (const physics::Scene& s : scene.scenes) {
    Json row{{"path", path_or_null(s.path)}, {"gravity", vector(s.gravity)}};
    row["timeStep"] = s.time_step ? number(*s.time_step) : Json(nullptr);
    if (s.mujoco) {
      row["mujoco"] = settings_json(*s.mujoco);
    }
    list.push_back(std::move(row));
  }
  return list;
}

Json bodies_json(const PhysicsScene& scene) {
  Json list = Json::array();
  for (const physics::Body& body : scene.bodies) {
    list.push_back({{"path", body.path.str()},
                    {"kinematic", body.kinematic},
                    {"enabled", body.enabled},
                    {"startsAsleep", body.starts_asleep},
                    {"scene", path_or_null(scene.scenes[body.scene].path)},
                    {"position", vector(body.pose.position)},
                    {"orientation", rotation(body.pose.orientation)},
                    {"linearVelocity", vector(body.linear_velocity)},
                    {"angularVelocity", vector(body.angular_velocity)},
                    {"mass", number(body.mass)},
                    {"centerOfMass", vector(body.center_of_mass)},
                    {"inertia", matrix(body.inertia)},
                    {"massSource", physics::mass_source_name(body.mass_source)},
                    {"linearDamping", number(body.linear_damping)},
                    {"angularDamping", number(body.angular_damping)},
                    {"gravityScale", number(body.gravity_scale)}});
    if (body.instance) {
      list.back()["instance"] = {{"instancer", body.instance->instancer.str()},
                                 {"prim", body.instance->prim.str()},
                                 {"index", body.instance->index}};
    }
  }
  return list;
}

std::string axis_name(physics::Axis axis) {
  return std::string(1, static_cast<char>('X' + static_cast<int>(axis)));
}

void add_triangles(const physics::TriangleMesh& mesh, Json& row) {
  Vec3d low{{INFINITY, INFINITY, INFINITY}};
  Vec3d high = -low;
  for (const Vec3d& p : mesh.points) {
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] = std::fmin(low[i], p[i]);
      high[i] = std::fmax(high[i], p[i]);
    }
  }
  row["points"] = mesh.points.size();
  row["triangles"] = mesh.triangles.size();
  row["lower"] = vector(low);
  row["upper"] = vector(high);
  row["flat"] = mesh.flat;
}

void add_spheres(const physics::Shape& shape, Json& row) {
  row["centers"] = Json::array();
  row["radii"] = Json::array();
  for (std::size_t i = 0; i < shape.sphere_centers.size(); ++i) {
    row["centers"].push_back(vector(shape.sphere_centers[i]));
    row["radii"].push_back(number(shape.sphere_radii[i]));
  }
}

/// Size fields in metres.
void add_sizes(const PhysicsScene& scene, const physics::Shape& shape, Json& row) {
  switch (shape.kind) {
    case physics::ShapeKind::Box:
    case physics::ShapeKind::Ellipsoid:
      row["halfExtents"] = vector(shape.half_extents);
      break;
    case physics::ShapeKind::Sphere:
      row["radius"] = number(shape.radius);
      break;
    case physics::ShapeKind::Capsule:
    case physics::ShapeKind::Cylinder:
    case physics::ShapeKind::Cone:
      row["radius"] = number(shape.radius);
      row["halfHeight"] = number(shape.half_height);
      row["axis"] = axis_name(shape.axis);
      break;
    case physics::ShapeKind::Plane:
      row["axis"] = axis_name(shape.axis);
      break;
    case physics::ShapeKind::ConvexHull:
    case physics::ShapeKind::Mesh:
      add_triangles(scene.meshes[shape.mesh], row);
      if (!shape.pieces.empty()) {
        row["pieces"] = shape.pieces.size();
      }
      break;
    case physics::ShapeKind::Spheres:
      add_spheres(shape, row);
      break;
  }
}

Json colliders_json(const PhysicsScene& scene) {
  Json list = Json::array();
  for (const physics::Collider& collider : scene.colliders) {
    Json row{{"path", collider.path.str()},
             {"body", path_of(scene.bodies, collider.body)},
             {"shape", physics::shape_name(collider.shape.kind)}};
    add_sizes(scene, collider.shape, row);
    row["position"] = vector(collider.pose.position);
    row["orientation"] = rotation(collider.pose.orientation);
    row["material"] = path_of(scene.materials, collider.material);
    row["enabled"] = collider.enabled;
    row["scene"] = path_or_null(scene.scenes[collider.scene].path);
    if (collider.approximation) {
      row["approximation"] = physics::approximation_name(*collider.approximation);
    }
    for (const physics::FaceMaterial& faces : collider.face_materials) {
      row["faceMaterials"].push_back({{"subset", faces.subset.str()},
                                      {"material", path_of(scene.materials, faces.material)},
                                      {"triangles", faces.triangles}});
    }
    if (collider.contact_offset) {
      row["contactOffset"] = number(*collider.contact_offset);
    }
    if (collider.rest_offset) {
      row["restOffset"] = number(*collider.rest_offset);
    }
    if (collider.max_hull_vertices) {
      row["maxHullVertices"] = *collider.max_hull_vertices;
    }
    list.push_back(std::move(row));
  }
  return list;
}

Json materials_json(const PhysicsScene& scene) {
  Json list = Json::array();
  for (const physics::Material& material : scene.materials) {
    list.push_back({{"path", material.path.str()},
                    {"staticFriction", number(material.static_friction)},
                    {"dynamicFriction", number(material.dynamic_friction)},
                    {"restitution", number(material.restitution)},
                    {"density", material.density > 0 ? number(material.density) : Json(nullptr)},
                    {"frictionCombine", physics::combine_name(material.friction_combine)},
                    {"restitutionCombine", physics::combine_name(material.restitution_combine)}});
  }
  return list;
}

Json frame_json(const Pose& pose) {
  return {{"position", vector(pose.position)}, {"orientation", rotation(pose.orientation)}};
}

Json drives_json(const physics::Joint& joint) {
  Json list = Json::array();
  for (const physics::Drive& drive : joint.drives) {
    list.push_back({{"dof", physics::dof_name(drive.dof)},
                    {"type", drive.acceleration ? "acceleration" : "force"},
                    {"stiffness", number(drive.stiffness)},
                    {"damping", number(drive.damping)},
                    {"maxForce", number(drive.max_force)},
                    {"targetPosition", number(drive.target_position)},
                    {"targetVelocity", number(drive.target_velocity)},
                    {"source", drive.source.str()}});
  }
  return list;
}

Json limits_json(const physics::Joint& joint) {
  Json list = Json::array();
  for (const physics::Limit& limit : joint.limits) {
    list.push_back({{"dof", physics::dof_name(limit.dof)},
                    {"lower", number(limit.lower)},
                    {"upper", number(limit.upper)},
                    {"locked", limit.locked()}});
  }
  return list;
}

Json mimic_json(const PhysicsScene& scene, const physics::Joint& joint) {
  if (!joint.mimic) {
    return nullptr;
  }
  const physics::Mimic& mimic = *joint.mimic;
  return {{"leader", scene.joints[mimic.leader].path.str()},
          {"multiplier", number(mimic.multiplier)},
          {"offset", number(mimic.offset)},
          {"higher", {mimic.higher[0], mimic.higher[1], mimic.higher[2]}},
          {"naturalFrequency", number(mimic.natural_frequency)},
          {"dampingRatio", number(mimic.damping_ratio)},
          {"schema", mimic.schema}};
}

void add_joint_settings(const physics::Joint& joint, Json& row) {
  row["armature"] = number(joint.armature);
  row["friction"] = number(joint.friction);
  row["damping"] = number(joint.damping);
  row["stiffness"] = number(joint.stiffness);
  row["velocityLimit"] = number(joint.velocity_limit);
  row["initialPosition"] = joint.initial_position ? number(*joint.initial_position) : Json(nullptr);
  row["initialVelocity"] = joint.initial_velocity ? number(*joint.initial_velocity) : Json(nullptr);
}

Json joints_json(const PhysicsScene& scene) {
  Json list = Json::array();
  for (const physics::Joint& joint : scene.joints) {
    const bool has_axis = joint.kind == physics::JointKind::Revolute ||
                          joint.kind == physics::JointKind::Prismatic ||
                          joint.kind == physics::JointKind::Spherical;
    Json row{{"path", joint.path.str()},
             {"type", physics::joint_kind_name(joint.kind)},
             {"body0", path_of(scene.bodies, joint.body0)},
             {"body1", path_of(scene.bodies, joint.body1)},
             {"frame0", frame_json(joint.frame0)},
             {"frame1", frame_json(joint.frame1)},
             {"axis", has_axis ? Json(axis_name(joint.axis)) : Json(nullptr)},
             {"lower", number(joint.lower)},
             {"upper", number(joint.upper)}};
    if (joint.kind == physics::JointKind::Spherical) {
      row["coneAngle0"] = number(joint.cone_angle0);
      row["coneAngle1"] = number(joint.cone_angle1);
    }
    row["drives"] = drives_json(joint);
    row["limits"] = limits_json(joint);
    row["mimic"] = mimic_json(scene, joint);
    row["enabled"] = joint.enabled;
    row["collisionEnabled"] = joint.collision_enabled;
    row["excludeFromArticulation"] = joint.exclude_from_articulation;
    row["breakForce"] = number(joint.break_force);
    row["breakTorque"] = number(joint.break_torque);
    row["articulation"] = path_of(scene.articulations, joint.articulation);
    add_joint_settings(joint, row);
    list.push_back(std::move(row));
  }
  return list;
}

Json articulations_json(const PhysicsScene& scene) {
  Json list = Json::array();
  for (const physics::Articulation& articulation : scene.articulations) {
    list.push_back({{"path", articulation.path.str()},
                    {"root", articulation.root.str()},
                    {"fixedBase", articulation.fixed_base},
                    {"links", paths_of(scene.bodies, articulation.links)},
                    {"joints", paths_of(scene.joints, articulation.joints)},
                    {"loopJoints", paths_of(scene.joints, articulation.loop_joints)},
                    {"selfCollision", articulation.self_collision}});
  }
  return list;
}

Json pairs_json(const PhysicsScene& scene) {
  Json list = Json::array();
  for (const auto& [a, b] : scene.disabled_pairs()) {
    list.push_back({scene.colliders[a].path.str(), scene.colliders[b].path.str()});
  }
  return list;
}

Json switch_json(const PhysicsScene& scene, const physics::SwitchTrack& track) {
  switch (track.what) {
    case physics::Switch::BodyEnabled:
      return {{"body", scene.bodies[track.object].path.str()}, {"value", "enabled"}};
    case physics::Switch::BodyKinematic:
      return {{"body", scene.bodies[track.object].path.str()}, {"value", "kinematic"}};
    case physics::Switch::ColliderEnabled:
      return {{"collider", scene.colliders[track.object].path.str()}, {"value", "enabled"}};
    case physics::Switch::JointEnabled:
      return {{"joint", scene.joints[track.object].path.str()}, {"value", "enabled"}};
    case physics::Switch::JointCollision:
      break;
  }
  return {{"joint", scene.joints[track.object].path.str()}, {"value", "collisionEnabled"}};
}

/// Which bodies are parts of others, and what that makes them weigh.
Json nesting_json(const PhysicsScene& scene, const physics::NestingState& state) {
  Json row{{"time", number(state.time)}, {"carried", Json::array()}, {"masses", Json::array()}};
  for (const physics::CarriedBody& carried : state.carried) {
    row["carried"].push_back({{"body", scene.bodies[carried.body].path.str()},
                              {"carrier", scene.bodies[carried.carrier].path.str()}});
  }
  for (const auto& [body, mass] : state.masses) {
    row["masses"].push_back({{"body", scene.bodies[body].path.str()},
                             {"mass", number(mass.mass)},
                             {"centerOfMass", vector(mass.center_of_mass)}});
  }
  return row;
}

/// Switches, bounds, gravity and groups that follow samples.
void add_changes(const PhysicsScene& scene, Json& list) {
  const auto add = [&](Json row, std::size_t samples, bool held) {
    row["samples"] = samples;
    row["held"] = held;
    list.push_back(std::move(row));
  };
  for (const physics::SwitchTrack& track : scene.switch_tracks) {
    add(switch_json(scene, track), track.times.size(), true);
  }
  for (const physics::BoundsTrack& track : scene.bounds_tracks) {
    add({{"joint", scene.joints[track.joint].path.str()}, {"value", "limits"}}, track.times.size(),
        track.held);
  }
  for (const physics::GravityTrack& track : scene.gravity_tracks) {
    add({{"scene", scene.scenes[track.scene].path.str()}, {"value", "gravity"}}, track.times.size(),
        track.held);
  }
  for (const physics::ShapesTrack& track : scene.shapes_tracks) {
    Json row{{"body", scene.bodies[track.body].path.str()}, {"value", "shapes"}};
    for (const physics::Index i : track.colliders) {
      row["colliders"].push_back(scene.colliders[i].path.str());
    }
    row["lastMass"] = number(track.shapes.back().mass);
    row["lastCenterOfMass"] = vector(track.shapes.back().center_of_mass);
    add(std::move(row), track.times.size(), true);
  }
  if (!scene.nesting_states.empty()) {
    Json row{{"value", "nesting"}, {"states", Json::array()}};
    for (const physics::NestingState& state : scene.nesting_states) {
      row["states"].push_back(nesting_json(scene, state));
    }
    add(std::move(row), scene.nesting_states.size(), true);
  }
  if (!scene.group_states.empty()) {
    add({{"value", "collisionGroups"}}, scene.group_states.size(), true);
  }
}

Json tracks_json(const PhysicsScene& scene) {
  Json list = Json::array();
  for (const physics::ScalarTrack& track : scene.scalar_tracks) {
    constexpr const char* kNames[] = {"targetPosition", "targetVelocity", "stiffness", "damping",
                                      "maxForce"};
    list.push_back({{"joint", scene.joints[track.joint].path.str()},
                    {"drive", track.drive},
                    {"value", kNames[static_cast<std::size_t>(track.what)]},
                    {"samples", track.times.size()},
                    {"held", track.held}});
  }
  for (const physics::PoseTrack& track : scene.pose_tracks) {
    Json row = track.body ? Json{{"body", scene.bodies[*track.body].path.str()}}
               : track.joint
                   ? Json{{"joint", scene.joints[*track.joint].path.str()}, {"side", track.side}}
                   : Json{{"collider", scene.colliders[*track.collider].path.str()}};
    row["value"] = "pose";
    row["samples"] = track.times.size();
    row["held"] = track.held;
    list.push_back(std::move(row));
  }
  add_changes(scene, list);
  return list;
}

Json place_json(const PhysicsScene& scene, const physics::TendonStop::Place& place) {
  return {{"path", place.path.str()},
          {"body", path_of(scene.bodies, place.body)},
          {"position", vector(place.pose.position)}};
}

Json tendons_json(const PhysicsScene& scene) {
  constexpr const char* kKinds[] = {"site", "sphere", "cylinder", "pulley"};
  Json list = Json::array();
  for (const physics::Tendon& tendon : scene.tendons) {
    Json row{{"path", tendon.path.str()},
             {"joints", paths_of(scene.joints, tendon.joints)},
             {"coefficients", tendon.coefficients},
             {"stiffness", number(tendon.stiffness)},
             {"damping", number(tendon.damping)},
             {"friction", number(tendon.friction)},
             {"armature", number(tendon.armature)},
             {"springLength", tendon.spring_length},
             {"settings", settings_json(tendon.settings)}};
    row["range"] = tendon.range ? Json(*tendon.range) : Json(nullptr);
    row["stops"] = Json::array();
    for (const physics::TendonStop& stop : tendon.stops) {
      Json at{{"kind", kKinds[static_cast<std::size_t>(stop.kind)]}};
      if (stop.kind == physics::TendonStop::Kind::Pulley) {
        at["divisor"] = stop.divisor;
      } else {
        at["place"] = place_json(scene, stop.place);
        at["radius"] = stop.radius;
        at["side"] = stop.side ? place_json(scene, *stop.side) : Json(nullptr);
      }
      row["stops"].push_back(std::move(at));
    }
    list.push_back(std::move(row));
  }
  return list;
}

}  // namespace

Json physics_json(const PhysicsScene& scene) {
  Json body = Json::object();
  body["scenes"] = scenes_json(scene);
  body["bodies"] = bodies_json(scene);
  body["colliders"] = colliders_json(scene);
  body["materials"] = materials_json(scene);
  body["joints"] = joints_json(scene);
  body["articulations"] = articulations_json(scene);
  body["tendons"] = tendons_json(scene);
  body["disabledPairs"] = pairs_json(scene);
  body["animated"] = tracks_json(scene);
  body["notRead"] = Json::array();
  for (const physics::NotRead& row : scene.not_read) {
    body["notRead"].push_back(
        {{"prim", row.prim.str()}, {"property", row.property}, {"why", row.why}});
  }
  return body;
}

}  // namespace tenon::cli
