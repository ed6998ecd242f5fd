// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "tenon/structure/proof.h"

namespace tenon::structure {
namespace {

using physics::Index;
using physics::PhysicsScene;

constexpr double kTolerance = 1e-9;

/// Numbers, collected to be compared one by one.
class Numbers {
 public:
  void add(double value) { values_.push_back(value); }
  void add(const Vec3d& v) {
    for (std::size_t i = 0; i < 3; ++i) {
      add(v[i]);
    }
  }
  void add(const Quatd& q) {
    // Both signs are the same rotation.
    const double sign = q.w < 0 ? -1 : 1;
    for (const double x : {q.w, q.x, q.y, q.z}) {
      add(sign * x);
    }
  }
  void add(const Pose& pose) {
    add(pose.position);
    add(pose.orientation);
  }
  void add(const std::optional<double>& value) {
    add(value ? 1.0 : 0.0);
    add(value.value_or(0));
  }
  void add(const std::vector<double>& numbers) {
    add(static_cast<double>(numbers.size()));
    values_.insert(values_.end(), numbers.begin(), numbers.end());
  }
  bool is_near(const Numbers& other) const {
    return values_.size() == other.values_.size() &&
           std::equal(values_.begin(), values_.end(), other.values_.begin(), near);
  }
  static bool near(double a, double b) {
    const double size = std::max({1e-6, std::fabs(a), std::fabs(b)});
    return a == b || (std::isnan(a) && std::isnan(b)) || std::fabs(a - b) <= kTolerance * size;
  }

 private:
  std::vector<double> values_;
};

double flag(bool value) { return value ? 1 : 0; }

Path leader_of(const PhysicsScene& scene, const physics::Joint& joint) {
  return joint.mimic ? scene.joints[joint.mimic->leader].path : Path();
}

Path body_path(const PhysicsScene& scene, const std::optional<Index>& body) {
  return body ? scene.bodies[*body].path : Path();
}

Numbers numbers_of(const physics::Body& body) {
  Numbers n;
  for (const double x :
       {flag(body.kinematic), flag(body.enabled), flag(body.starts_asleep), body.mass,
        body.linear_damping, body.angular_damping, body.gravity_scale}) {
    n.add(x);
  }
  n.add(body.pose);
  n.add(body.linear_velocity);
  n.add(body.angular_velocity);
  n.add(body.center_of_mass);
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) {
      n.add(body.inertia[row][column]);
    }
  }
  return n;
}

Numbers numbers_of(const PhysicsScene& scene, const physics::Collider& collider) {
  Numbers n;
  const physics::Shape& shape = collider.shape;
  n.add(static_cast<double>(shape.kind));
  n.add(shape.half_extents);
  for (const double x :
       {shape.radius, shape.half_height, static_cast<double>(shape.axis), flag(collider.enabled)}) {
    n.add(x);
  }
  n.add(collider.pose);
  const physics::Material& material =
      collider.material ? scene.materials[*collider.material] : scene.unbound;
  for (const double x : {material.static_friction, material.dynamic_friction, material.restitution,
                         material.density}) {
    n.add(x);
  }
  n.add(collider.contact_offset);
  n.add(collider.rest_offset);
  n.add(static_cast<double>(collider.max_hull_vertices.value_or(-1)));
  const physics::MujocoContact& contact = collider.mujoco;
  n.add(static_cast<double>(contact.condim.value_or(-1)));
  n.add(static_cast<double>(contact.priority.value_or(0)));
  n.add(contact.solmix);
  n.add(contact.solref);
  n.add(contact.solimp);
  n.add(material.torsional_friction);
  n.add(material.rolling_friction);
  n.add(static_cast<double>(collider.face_materials.size()));
  return n;
}

const std::vector<Vec3d>* points_of(const PhysicsScene& scene, const physics::Collider& collider) {
  const physics::Shape& shape = collider.shape;
  const bool has_mesh =
      shape.kind == physics::ShapeKind::ConvexHull || shape.kind == physics::ShapeKind::Mesh;
  return has_mesh && shape.mesh < scene.meshes.size() ? &scene.meshes[shape.mesh].points : nullptr;
}

bool same_points(const std::vector<Vec3d>* a, const std::vector<Vec3d>* b) {
  if (a == nullptr || b == nullptr) {
    return a == b;
  }
  return std::equal(a->begin(), a->end(), b->begin(), b->end(), [](const Vec3d& p, const Vec3d& q) {
    return p == q || std::equal(p.v.begin(), p.v.end(), q.v.begin(), Numbers::near);
  });
}

Numbers numbers_of(const physics::Joint& joint) {
  Numbers n;
  n.add(joint.frame0);
  n.add(joint.frame1);
  for (const double x :
       {static_cast<double>(joint.kind), static_cast<double>(joint.axis), joint.lower, joint.upper,
        joint.cone_angle0, joint.cone_angle1, flag(joint.enabled), flag(joint.collision_enabled),
        flag(joint.exclude_from_articulation), joint.break_force, joint.break_torque,
        joint.armature, joint.friction, joint.damping, joint.stiffness, joint.spring_reference,
        joint.velocity_limit}) {
    n.add(x);
  }
  n.add(joint.initial_position);
  n.add(joint.initial_velocity);
  for (const physics::Limit& limit : joint.limits) {
    for (const double x : {static_cast<double>(limit.dof), limit.lower, limit.upper}) {
      n.add(x);
    }
  }
  for (const physics::Drive& drive : joint.drives) {
    for (const double x :
         {static_cast<double>(drive.dof), flag(drive.acceleration), drive.stiffness, drive.damping,
          drive.max_force, drive.target_position, drive.target_velocity}) {
      n.add(x);
    }
  }
  if (joint.mimic) {
    const physics::Mimic& mimic = *joint.mimic;
    n.add(mimic.multiplier);
    n.add(mimic.offset);
    n.add(mimic.natural_frequency);
    n.add(mimic.damping_ratio);
  }
  for (const std::vector<double>* softness :
       {&joint.mujoco.solref_limit, &joint.mujoco.solimp_limit, &joint.mujoco.solref_friction,
        &joint.mujoco.solimp_friction}) {
    n.add(*softness);
  }
  return n;
}

/// What only MuJoCo's schema says of a mimic. Where a view holds several schemas of one law, that
/// of another one may be read.
Numbers mujoco_numbers_of(const physics::Mimic& mimic) {
  Numbers n;
  n.add({mimic.higher.begin(), mimic.higher.end()});
  n.add(mimic.mujoco_solref);
  n.add(mimic.mujoco_solimp);
  return n;
}

bool same_mimic(const physics::Joint& a, const physics::Joint& b) {
  return !a.mimic || !b.mimic || a.mimic->schema != b.mimic->schema ||
         mujoco_numbers_of(*a.mimic).is_near(mujoco_numbers_of(*b.mimic));
}

Numbers numbers_of(const physics::Tendon& tendon) {
  Numbers n;
  for (const double x : {tendon.stiffness, tendon.damping, tendon.friction, tendon.armature}) {
    n.add(x);
  }
  n.add(tendon.coefficients);
  n.add({tendon.spring_length.begin(), tendon.spring_length.end()});
  n.add(tendon.range ? std::vector<double>(tendon.range->begin(), tendon.range->end())
                     : std::vector<double>());
  for (const physics::TendonStop& stop : tendon.stops) {
    n.add(static_cast<double>(stop.kind));
    n.add(stop.place.pose);
    n.add(stop.radius);
    n.add(stop.divisor);
    n.add(flag(stop.side.has_value()));
    n.add(stop.side ? stop.side->pose : Pose{});
  }
  for (const physics::MujocoSetting& setting : tendon.settings) {
    n.add(setting.numbers);
  }
  return n;
}

/// Joints that a fixed tendon is of, bodies that a spatial one meets.
std::vector<Path> held_by(const PhysicsScene& scene, const physics::Tendon& tendon) {
  std::vector<Path> paths;
  for (const Index joint : tendon.joints) {
    paths.push_back(scene.joints[joint].path);
  }
  for (const physics::TendonStop& stop : tendon.stops) {
    paths.push_back(body_path(scene, stop.place.body));
    paths.push_back(stop.side ? body_path(scene, stop.side->body) : Path());
  }
  return paths;
}

class Comparison {
 public:
  Comparison(const PhysicsScene& expected, const PhysicsScene& found,
             const std::function<Path(Path)>& moved)
      : expected_(expected), found_(found), moved_(moved) {}

  std::optional<Disagreement> run() {
    bodies();
    colliders();
    joints();
    articulations();
    tendons();
    pairs();
    return std::move(first_);
  }

 private:
  void report(Path path, const char* what) {
    if (!first_) {
      first_ = Disagreement{path.str(), "", what};
    }
  }

  template <class Item>
  static std::map<Path, const Item*> by_path(const std::vector<Item>& items) {
    std::map<Path, const Item*> found;
    for (const Item& item : items) {
      found.emplace(item.path, &item);
    }
    return found;
  }

  /// Calls `compare` for each object and its counterpart.
  template <class Item, class Compare>
  void match(const std::vector<Item>& expected, const std::vector<Item>& found, bool move,
             const char* missing, Compare compare) {
    const auto others = by_path(found);
    if (expected.size() != found.size()) {
      const bool fewer = expected.size() > found.size();
      report(fewer || found.empty() ? Path() : found.back().path,
             fewer ? missing : "the source does not simulate so many objects");
    }
    for (const Item& item : expected) {
      const auto other = others.find(move ? moved_(item.path) : item.path);
      if (other == others.end()) {
        report(item.path, missing);
      } else {
        compare(item, *other->second);
      }
    }
  }

  void bodies() {
    match(expected_.bodies, found_.bodies, false, "the rigid body is missing",
          [this](const physics::Body& a, const physics::Body& b) {
            const bool same = numbers_of(a).is_near(numbers_of(b));
            const Vec3d& g = expected_.scenes[a.scene].gravity;
            const Vec3d& h = found_.scenes[b.scene].gravity;
            Numbers gravity_a;
            gravity_a.add(g);
            Numbers gravity_b;
            gravity_b.add(h);
            if (!same) {
              report(a.path, "the rigid body has other mass, pose or motion");
            } else if (!gravity_a.is_near(gravity_b)) {
              report(a.path, "the rigid body has other gravity");
            }
          });
  }

  void colliders() {
    match(expected_.colliders, found_.colliders, true, "the collider is missing",
          [this](const physics::Collider& a, const physics::Collider& b) {
            if (body_path(expected_, a.body) != body_path(found_, b.body)) {
              report(a.path, "the collider belongs to another body");
            } else if (!numbers_of(expected_, a).is_near(numbers_of(found_, b)) ||
                       !same_points(points_of(expected_, a), points_of(found_, b))) {
              report(a.path, "the collider has another shape, pose or material");
            }
          });
  }

  void joints() {
    match(expected_.joints, found_.joints, false, "the joint is missing",
          [this](const physics::Joint& a, const physics::Joint& b) {
            if (body_path(expected_, a.body0) != body_path(found_, b.body0) ||
                body_path(expected_, a.body1) != body_path(found_, b.body1)) {
              report(a.path, "the joint connects other bodies");
            } else if (leader_of(expected_, a) != leader_of(found_, b)) {
              report(a.path, "the joint follows another joint");
            } else if (!numbers_of(a).is_near(numbers_of(b)) || !same_mimic(a, b)) {
              report(a.path, "the joint has other frames, limits, drives or settings");
            }
          });
  }

  /// By their roots: one prim may hold several trees that stand on the ground side by side.
  void articulations() {
    std::map<Path, const physics::Articulation*> others;
    for (const physics::Articulation& other : found_.articulations) {
      others.emplace(other.root, &other);
    }
    for (const physics::Articulation& a : expected_.articulations) {
      const auto at = others.find(a.root);
      if (at == others.end()) {
        report(a.path, "the articulation is missing, or has another root");
        continue;
      }
      const physics::Articulation& b = *at->second;
      if (a.path != b.path || a.fixed_base != b.fixed_base || a.links.size() != b.links.size() ||
          a.joints.size() != b.joints.size() || a.self_collision != b.self_collision) {
        report(a.path, "the articulation has other links or joints");
      }
    }
    if (expected_.articulations.size() != found_.articulations.size()) {
      report(Path(), "the source has another number of articulations");
    }
  }

  void tendons() {
    match(expected_.tendons, found_.tendons, false, "the tendon is missing",
          [this](const physics::Tendon& a, const physics::Tendon& b) {
            if (held_by(expected_, a) != held_by(found_, b)) {
              report(a.path, "the tendon is of other joints or bodies");
            } else if (!numbers_of(a).is_near(numbers_of(b))) {
              report(a.path, "the tendon has another path or other settings");
            }
          });
  }

  using PathPairs = std::set<std::pair<Path, Path>>;

  static PathPairs pairs_of(const PhysicsScene& scene, const std::function<Path(Path)>& map) {
    PathPairs pairs;
    for (const auto& [a, b] : scene.disabled_pairs()) {
      const Path first = map(scene.colliders[a].path);
      const Path second = map(scene.colliders[b].path);
      pairs.insert(std::minmax(first, second));
    }
    return pairs;
  }

  void pairs() {
    const PathPairs a = pairs_of(expected_, moved_);
    const PathPairs b = pairs_of(found_, [](Path path) { return path; });
    std::vector<std::pair<Path, Path>> apart;
    std::set_symmetric_difference(a.begin(), a.end(), b.begin(), b.end(),
                                  std::back_inserter(apart));
    if (!apart.empty()) {
      report(apart.front().first, "the colliders that may not touch are others");
    }
  }

  const PhysicsScene& expected_;
  const PhysicsScene& found_;
  const std::function<Path(Path)>& moved_;
  std::optional<Disagreement> first_;
};

}  // namespace

std::optional<Disagreement> compare_physics(const PhysicsScene& expected, const PhysicsScene& found,
                                            const std::function<Path(Path)>& moved) {
  return Comparison(expected, found, moved).run();
}

}  // namespace tenon::structure
