// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// What engines and exporters assume about a scene. The reader guarantees it; here it is checked for
// scenes that come as JSON or as bytes. Indices are found by the tables: a field that refers to a
// list is checked wherever it is. Which lists go together is declared below.
#include "tenon/scene/check_scene.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "tenon/base/limits/physics_limits.h"
#include "tenon/scene/fields/list_of.h"

namespace tenon::scene {
namespace {

using tenon::is_finite;
bool is_finite(const Mat3d& m) {
  return std::all_of(m.m.begin(), m.m.end(), [](const auto& row) {
    return std::all_of(row.begin(), row.end(), [](double x) { return std::isfinite(x); });
  });
}

/// Pairs of numbers below `count`, as SetPairs says.
bool are_set_pairs(const SetPairs& pairs, std::size_t count) {
  return std::is_sorted(pairs.begin(), pairs.end()) &&
         std::all_of(pairs.begin(), pairs.end(), [count](const auto& pair) {
           return pair.first <= pair.second && pair.second < count;
         });
}

/// What contradicts itself in one struct by itself; nullptr: nothing.
const char* fault_of(const Tendon& tendon) {
  return tendon.joints.size() == tendon.coefficients.size() ? nullptr
                                                            : "a tendon lacks coefficients";
}
const char* fault_of(const Sensor& sensor) {
  const bool wants_body = sensor.kind != SensorKind::Joint;
  const bool wants_joint =
      sensor.kind == SensorKind::ForceTorque || sensor.kind == SensorKind::Joint;
  if ((wants_body && !sensor.body) || (wants_joint && !sensor.joint)) {
    return "a sensor measures nothing that is there";
  }
  if (sensor.ray_origins.size() != sensor.ray_directions.size()) {
    return "a sensor has other numbers of origins and directions of rays";
  }
  return is_finite(sensor.period) && sensor.period >= 0 ? nullptr
                                                        : "a period is negative or not finite";
}

/// Looks at every index, as deep as it lies.
class Check {
 public:
  explicit Check(const PhysicsScene& scene) : scene_(scene) {}

  /// The first fault.
  const std::optional<Error>& fault() const { return fault_; }

  void whole() {
    const DataView scene = view_of(scene_);
    for (const DataField& field : scene.type->fields) {
      place_ = std::string(field.info->name);
      visit({}, *field.info, scene.member(field));
    }
    place_ = "scenes";
    require(!scene_.scenes.empty(), "there is no scene");
    filter();
  }

 private:
  void require(bool holds, const char* what) {
    if (!holds && !fault_) {
      fault_ =
          Error(ErrorCode::Corrupt, "a physics scene contradicts itself: " + place_ + ": " + what);
    }
  }

  void visit(const OwnerFacts& owner, const FieldInfo& info, DataView value) {
    if (fault_) {
      return;
    }
    switch (value.kind()) {
      case DataKind::Ordinal:
        if (info.refers != List::None && info.refers != List::Meshes) {
          require(value.as<Index>() < size_of(scene_, list_of(owner, info.refers)),
                  "an index is out of range");
        }
        break;
      case DataKind::Pair:
        visit(owner, info, value.first());
        visit(owner, info, value.second());
        break;
      case DataKind::Optional:
      case DataKind::List:
        for (std::size_t i = 0; i < value.size(); ++i) {
          visit(owner, info, value[i]);
        }
        break;
      case DataKind::Struct:
        object(value);
        break;
      case DataKind::Pose:
        require(is_finite(value.as<Pose>()), "a number is not finite");
        break;
      case DataKind::Numbers:
        require(!value.is_a<Vec3d>() || is_finite(value.as<Vec3d>()), "a number is not finite");
        break;
      default:
        break;
    }
  }

  void object(DataView value) {
    own_of(value);
    const std::string around = place_;
    if (const Path* path = path_of(value)) {
      place_ += " <" + (path->empty() ? std::string() : path->str()) + ">";
    }
    const OwnerFacts owner = facts_of(value);
    for (const DataField& field : value.type->fields) {
      visit(owner, *field.info, value.member(field));
    }
    place_ = around;
  }

  // What belongs together in one struct; most have nothing to hold but their indices.

  template <class T>
  bool own_if(DataView value) {
    const T* of = value.get_if<T>();
    if (of != nullptr) {
      own(*of);
    }
    return of != nullptr;
  }

  void own_of(DataView value) {
    const bool is_known =
        own_if<Body>(value) || own_if<MujocoActuator>(value) || own_if<TriangleMesh>(value) ||
        own_if<Shape>(value) || own_if<Collider>(value) || own_if<Joint>(value) ||
        own_if<Tendon>(value) || own_if<Sensor>(value) || own_if<ScalarTrack>(value) ||
        own_if<PoseTrack>(value) || own_if<ShapesTrack>(value) || own_if<GroupState>(value);
    if (!is_known) {
      own_times(value);
    }
  }

  /// Of tracks: as many values as times.
  void own_times(DataView track) {
    const DataField* all = find_field(*track.type, "times");
    if (all == nullptr) {
      return;
    }
    for (const std::string_view name : {"values", "states", "bounds", "gravity"}) {
      if (const DataField* values = find_field(*track.type, name)) {
        times(track.member(*all).as<std::vector<double>>(), track.member(*values).size());
      }
    }
  }

  void own(const Tendon& tendon) {
    const char* const fault = fault_of(tendon);
    require(fault == nullptr, fault);
  }
  void own(const Sensor& sensor) {
    const char* const fault = fault_of(sensor);
    require(fault == nullptr, fault);
  }
  void own(const Body& body) {
    require(body.mass >= 0 && is_finite(body.mass), "a mass is negative or not finite");
    require(is_finite(body.inertia), "an inertia is not finite");
  }
  void own(const MujocoActuator& actuator) {
    using Target = MujocoActuator::Target;
    require((actuator.kind != Target::Joint || actuator.target < scene_.joints.size()) &&
                (actuator.kind != Target::Tendon || actuator.target < scene_.tendons.size()) &&
                (actuator.kind != Target::Crank || actuator.other_site.has_value()),
            "an actuator acts on nothing that is there");
  }
  void own(const TriangleMesh& mesh) {
    for (const Vec3i& triangle : mesh.triangles) {
      for (const int corner : triangle.v) {
        require(corner >= 0 && static_cast<std::size_t>(corner) < mesh.points.size(),
                "a corner of a triangle is out of range");
      }
    }
  }
  void own(const Shape& shape) {
    require(shape.sphere_centers.size() == shape.sphere_radii.size(), "spheres lack a radius");
    const bool has_mesh = shape.kind == ShapeKind::ConvexHull || shape.kind == ShapeKind::Mesh;
    require((!has_mesh || shape.mesh < scene_.meshes.size()) &&
                std::all_of(shape.pieces.begin(), shape.pieces.end(),
                            [this](Index i) { return i < scene_.meshes.size(); }),
            "a shape has no mesh");
    require(is_finite(shape.radius) && is_finite(shape.half_height), "a size is not finite");
  }
  void own(const Collider& collider) {
    const Shape& shape = collider.shape;
    for (const FaceMaterial& faces : collider.face_materials) {
      require(shape.kind == ShapeKind::Mesh && shape.mesh < scene_.meshes.size() &&
                  std::all_of(
                      faces.triangles.begin(), faces.triangles.end(),
                      [&](Index i) { return i < scene_.meshes[shape.mesh].triangles.size(); }),
              "triangles with a material of their own are not there");
    }
  }
  void own(const Joint& joint) {
    unsigned followed = 0;  // a bit for each degree of freedom
    for (const Mimic& mimic : joint.mimics) {
      const unsigned dof = 1u << static_cast<unsigned>(mimic.dof);
      require((followed & dof) == 0, "a degree of freedom follows twice");
      followed |= dof;
    }
  }

  void times(const std::vector<double>& all, std::size_t values) {
    require(!all.empty() && all.size() == values, "times and values are not as many");
    require(std::is_sorted(all.begin(), all.end()) &&
                std::all_of(all.begin(), all.end(), [](double t) { return std::isfinite(t); }),
            "times do not ascend");
  }
  void own(const ScalarTrack& track) {
    times(track.times, track.values.size());
    require(track.joint < scene_.joints.size() &&
                track.drive < scene_.joints[track.joint].drives.size(),
            "a drive that changes is not there");
  }
  void own(const PoseTrack& track) {
    times(track.times, track.poses.size());
    require(track.body || track.collider || track.joint, "a track of poses is of nothing");
    require(track.side == 0 || track.side == 1, "a joint has two sides");
  }
  void own(const ShapesTrack& track) {
    times(track.times, track.shapes.size());
    for (const BodyShapes& shapes : track.shapes) {
      require(shapes.poses.size() == track.colliders.size() &&
                  shapes.shapes.size() == track.colliders.size(),
              "shapes that move are not as many as their colliders");
    }
  }
  void own(const GroupState& state) {
    const std::size_t groups = scene_.filter.group_paths.size();
    require(is_finite(state.time) && state.group_pair_off.size() == groups * groups &&
                state.ungrouped_off.size() == groups,
            "a table of groups has another size");
  }

  void filter() {
    place_ = "filter";
    const CollisionFilter& filter = scene_.filter;
    const std::size_t groups = filter.group_paths.size();
    // Without groups the lists of them may be absent.
    require(filter.groups_of_collider.size() == scene_.colliders.size() ||
                (groups == 0 && filter.groups_of_collider.empty()),
            "not every collider has a list of groups");
    for (const std::vector<Index>& of : filter.groups_of_collider) {
      require(std::all_of(of.begin(), of.end(), [groups](Index i) { return i < groups; }),
              "a group is out of range");
    }
    require(
        filter.group_pair_off.size() == groups * groups && filter.ungrouped_off.size() == groups,
        "a table of groups has another size");
    require(filter.sets_of_collider.size() <= scene_.colliders.size(),
            "there are more lists of sets than colliders");
    // A set has a collider or more of its own; that bounds how many there can be.
    const std::size_t count = limits::kSetsOfCollider * scene_.colliders.size();
    for (const std::vector<Index>& of : filter.sets_of_collider) {
      require(std::all_of(of.begin(), of.end(), [count](Index i) { return i < count; }) &&
                  of.size() <= limits::kSetsOfCollider && std::is_sorted(of.begin(), of.end()),
              "the sets of a collider are out of range");
    }
    const char* const fault = "a pair of sets is out of range or not in order";
    require(are_set_pairs(filter.sets_off, count), fault);
    require(are_set_pairs(filter.permanent_sets_off, count), fault);
    for (const JointPairs& pairs : filter.joint_pairs) {
      require(are_set_pairs(pairs.sets, count), fault);
    }
  }

  const PhysicsScene& scene_;
  std::string place_;
  std::optional<Error> fault_;
};

}  // namespace

Result<void> check_scene(const PhysicsScene& scene) {
  Check check(scene);
  check.whole();
  if (check.fault()) {
    return *check.fault();
  }
  return {};
}

}  // namespace tenon::scene
