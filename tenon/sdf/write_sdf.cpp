// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The text is written in one pass, in the order of the model. A link has a pose relative to the
// link that carries it, so that poses are the origins of joints; a joint is in its child. Roll,
// pitch and yaw are written as people read them; close to straight up or down, where they lose
// digits, the quaternion is. A limit that a joint lacks is not written: SDFormat has none then.
#include "tenon/sdf/write_sdf.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <string>
#include <vector>

#include "tenon/base/text/source_number.h"
#include "tenon/sdf/plain_sdf.h"
#include "tenon/urdf/write_urdf.h"
#include "tenon/urdf/xml_writer.h"

namespace tenon::sdf {

using robot::GeometryKind;
using robot::Index;
using robot::JointKind;

namespace {

constexpr double kFarAway = 1e9;  // what counts as no limit [m, rad, N, N m, m/s, rad/s]

/// The name of the space of Drake's own elements, as Drake declares it; nothing is fetched.
constexpr const char* kDrake = "drake.mit.edu";

std::string numbers_text(std::initializer_list<double> numbers) {
  std::string out;
  for (const double number : numbers) {
    out += (out.empty() ? "" : " ") + source_number(number);
  }
  return out;
}

/// Of places [m], directions and angles [rad].
std::string vector_text(Vec3d v) {
  drop_noise(v.v);
  return numbers_text({v[0], v[1], v[2]});
}

const char* sdf_type(JointKind kind) {
  return kind == JointKind::Ball ? "ball" : robot::joint_kind_name(kind).data();
}

class SdfWriter {
 public:
  explicit SdfWriter(const robot::RobotModel& model)
      : model_(model), carriers_(carriers_of(model)), carried_by_(model.links.size(), nullptr) {
    for (const robot::Joint& joint : model.joints) {
      carried_by_[joint.child] = &joint;
    }
  }

  std::string run() {
    const robot::Link& root = model_.links[carriers_.root];
    has_world_link_ = carriers_.root_is_world && !(root.visuals.empty() && root.colliders.empty());
    out_.open("sdf", {{"version", "1.11"}, {"xmlns:drake", kDrake}});
    out_.open("model", {{"name", model_.name}});
    if (!carriers_.root_is_world) {
      write_pose(model_.root_pose);
    }
    out_.leaf("self_collide", model_.self_collision ? "true" : "false");
    for (Index i = 0; i < model_.links.size(); ++i) {
      write_part(i);
    }
    for (const robot::Joint& joint : model_.joints) {
      const bool is_frame = carriers_.is_frame[joint.child] != 0;
      if (!is_frame && joint.kind != JointKind::Floating) {
        write_joint(joint);
      }
    }
    out_.close("model");
    out_.close("sdf");
    return out_.take();
  }

 private:
  /// No link of the text, but the world that joints name.
  bool is_unwritten_world(Index link) const {
    return carriers_.root_is_world && link == carriers_.root && !has_world_link_;
  }

  void write_pose(const Pose& pose, const urdf::XmlWriter::AttributeList& attributes = {}) {
    if (pose == Pose{} && attributes.empty()) {
      return;
    }
    const Quatd& q = pose.orientation;
    const double sine = 2 * (q.w * q.y - q.z * q.x);
    constexpr double kUpright = 1 - 1e-6;
    if (std::fabs(sine) < kUpright) {
      out_.leaf("pose", vector_text(pose.position) + " " + vector_text(urdf::rpy_of(q)),
                attributes);
      return;
    }
    urdf::XmlWriter::AttributeList form = attributes;
    form.emplace_back("rotation_format", "quat_xyzw");
    std::array<double, 4> turn{q.x, q.y, q.z, q.w};
    drop_noise(turn);
    out_.leaf("pose",
              vector_text(pose.position) + " " + numbers_text({turn[0], turn[1], turn[2], turn[3]}),
              form);
  }

  /// A link, or the frame that it becomes.
  void write_part(Index number) {
    const robot::Link& link = model_.links[number];
    if (carriers_.is_frame[number] != 0) {
      write_frame(link.name, carriers_.link[number], carriers_.pose[number]);
    } else if (!is_unwritten_world(number)) {
      write_link(number);
    }
    for (const robot::Site& site : link.sites) {
      write_frame(site.name, carriers_.link[number], carriers_.pose[number] * site.pose);
    }
  }

  void write_frame(const std::string& name, Index link, const Pose& pose) {
    if (is_unwritten_world(link)) {
      out_.open("frame", {{"name", name}});
      write_pose(model_.root_pose * pose);
    } else {
      out_.open("frame", {{"name", name}, {"attached_to", model_.links[link].name}});
      write_pose(pose);
    }
    out_.close("frame");
  }

  void write_link(Index number) {
    const robot::Link& link = model_.links[number];
    out_.open("link", {{"name", link.name}});
    write_place(number);
    if (link.inertial) {
      write_inertial(*link.inertial);
    }
    if (link.gravity_scale == 0) {
      out_.leaf("gravity", "false");
    }
    for (const robot::Visual& visual : link.visuals) {
      out_.open("visual", {{"name", visual.name}});
      write_pose(visual.pose);
      write_geometry(visual.geometry, nullptr);
      if (visual.material) {
        write_material(model_.materials[*visual.material]);
      }
      out_.close("visual");
    }
    for (const robot::Collider& collider : link.colliders) {
      out_.open("collision", {{"name", collider.name}});
      write_pose(collider.pose);
      write_geometry(collider.geometry, &collider.approximation);
      write_surface(collider.surface);
      out_.close("collision");
    }
    out_.close("link");
    if (carriers_.root_is_world && number == carriers_.root) {
      hold(link.name);
    }
  }

  /// A link with the shapes of what stands still.
  void hold(const std::string& link) {
    out_.open("joint", {{"name", link + "_to_world"}, {"type", "fixed"}});
    out_.leaf("parent", "world");
    out_.leaf("child", link);
    out_.close("joint");
  }

  /// Relative to the link that carries it.
  void write_place(Index number) {
    const robot::Joint* joint = carried_by_[number];
    if (joint == nullptr) {
      write_pose(carriers_.root_is_world ? model_.root_pose : Pose{});
      return;
    }
    const Index parent = carriers_.link[joint->parent];
    const Pose pose = carriers_.pose[joint->parent] * joint->origin;
    if (is_unwritten_world(parent)) {
      write_pose(model_.root_pose * pose);
    } else {
      write_pose(pose, {{"relative_to", model_.links[parent].name}});
    }
  }

  void write_inertial(const robot::Inertial& inertial) {
    const Mat3d i = inertial.inertia_in_link();
    std::array<double, 6> tensor = {i[0][0], i[0][1], i[0][2], i[1][1], i[1][2], i[2][2]};
    drop_noise(tensor, 0);
    constexpr std::array<const char*, 6> kNames = {"ixx", "ixy", "ixz", "iyy", "iyz", "izz"};
    out_.open("inertial");
    write_pose({inertial.center_of_mass, kIdentityRotation});
    out_.leaf("mass", numbers_text({inertial.mass}));
    out_.open("inertia");
    for (std::size_t k = 0; k < kNames.size(); ++k) {
      out_.leaf(kNames[k], numbers_text({tensor[k]}));
    }
    out_.close("inertia");
    out_.close("inertial");
  }

  /// `collides_as` of a collider; null for what is only seen.
  void write_geometry(const robot::Geometry& g, const robot::Approximation* collides_as) {
    const std::string radius = numbers_text({g.radius});
    const std::string length = numbers_text({2 * g.half_height});
    const std::string kind(robot::geometry_name(g.kind));
    out_.open("geometry");
    if (g.kind == GeometryKind::Mesh) {
      write_mesh(g, collides_as);
      out_.close("geometry");
      return;
    }
    out_.open(kind.c_str());
    switch (g.kind) {
      case GeometryKind::Box:
        out_.leaf("size", vector_text(g.half_extents * 2.0));
        break;
      case GeometryKind::Sphere:
        out_.leaf("radius", radius);
        break;
      case GeometryKind::Cylinder:
      case GeometryKind::Capsule:
        out_.leaf("radius", radius);
        out_.leaf("length", length);
        break;
      case GeometryKind::Ellipsoid:
        out_.leaf("radii", vector_text(g.half_extents));
        break;
      case GeometryKind::Plane:
        out_.leaf("normal", "0 0 1");
        if (g.half_extents[0] > 0 && g.half_extents[1] > 0) {
          out_.leaf("size", numbers_text({2 * g.half_extents[0], 2 * g.half_extents[1]}));
        }
        break;
      case GeometryKind::Mesh:
        break;
    }
    out_.close(kind.c_str());
    out_.close("geometry");
  }

  void write_mesh(const robot::Geometry& g, const robot::Approximation* collides_as) {
    const bool is_hull = collides_as != nullptr && *collides_as == robot::Approximation::Hull;
    const bool is_pieces =
        collides_as != nullptr && *collides_as == robot::Approximation::Decomposition;
    out_.open("mesh", is_hull ? urdf::XmlWriter::AttributeList{{"optimization", "convex_hull"}}
                      : is_pieces
                          ? urdf::XmlWriter::AttributeList{{"optimization", "convex_decomposition"}}
                          : urdf::XmlWriter::AttributeList{});
    out_.leaf("uri", model_.meshes[g.mesh].written);
    if (!(g.scale == Vec3d{{1, 1, 1}})) {
      out_.leaf("scale", vector_text(g.scale));
    }
    out_.close("mesh");
  }

  void write_material(const robot::Material& material) {
    if (!material.color) {
      return;
    }
    Vec4d c = *material.color;
    for (std::size_t k = 0; k < 4; ++k) {
      c[k] = std::clamp(c[k], 0.0, 1.0);  // readers refuse others
    }
    const std::string color = numbers_text({c[0], c[1], c[2], c[3]});
    out_.open("material");
    out_.leaf("ambient", color);
    out_.leaf("diffuse", color);
    out_.close("material");
  }

  void write_surface(const robot::Surface& surface) {
    const bool is_soft = surface.contact_stiffness.has_value();
    if (!surface.dynamic_friction && !surface.restitution && !is_soft) {
      return;
    }
    out_.open("surface");
    if (surface.dynamic_friction) {
      const std::string mu = numbers_text({*surface.dynamic_friction});
      out_.open("friction");
      out_.open("ode");
      out_.leaf("mu", mu);
      out_.leaf("mu2", mu);
      out_.close("ode");
      out_.close("friction");
    }
    if (surface.restitution) {
      out_.open("bounce");
      out_.leaf("restitution_coefficient", numbers_text({*surface.restitution}));
      out_.close("bounce");
    }
    if (is_soft) {
      out_.open("contact");
      out_.open("ode");
      out_.leaf("kp", numbers_text({*surface.contact_stiffness}));
      out_.leaf("kd", numbers_text({surface.contact_damping.value_or(0)}));
      out_.close("ode");
      out_.close("contact");
    }
    out_.close("surface");
  }

  void leaf_below(const char* name, double value) {
    if (std::fabs(value) < kFarAway) {
      out_.leaf(name, numbers_text({value}));
    }
  }

  void write_limit(const robot::Joint& joint) {
    out_.open("limit");
    if (joint.limit) {
      leaf_below("lower", joint.limit->lower);
      leaf_below("upper", joint.limit->upper);
    }
    leaf_below("effort", joint.effort_limit);
    leaf_below("velocity", joint.velocity_limit);
    out_.close("limit");
  }

  void write_dynamics(const robot::Joint& joint) {
    if (joint.damping == 0 && joint.friction == 0 && joint.stiffness == 0) {
      return;
    }
    out_.open("dynamics");
    out_.leaf("damping", numbers_text({joint.damping}));
    out_.leaf("friction", numbers_text({joint.friction}));
    if (joint.stiffness != 0) {
      out_.leaf("spring_reference", numbers_text({joint.spring_reference}));
      out_.leaf("spring_stiffness", numbers_text({joint.stiffness}));
    }
    out_.close("dynamics");
  }

  void write_axis(const robot::Joint& joint) {
    out_.open("axis");
    out_.leaf("xyz", vector_text(joint.axis));
    if (joint.mimic) {
      out_.open("mimic", {{"joint", model_.joints[joint.mimic->leader].name}});
      out_.leaf("multiplier", numbers_text({joint.mimic->multiplier}));
      out_.leaf("offset", numbers_text({joint.mimic->offset}));
      out_.leaf("reference", "0");
      out_.close("mimic");
    }
    write_limit(joint);
    write_dynamics(joint);
    out_.close("axis");
  }

  void write_joint(const robot::Joint& joint) {
    const Index parent = carriers_.link[joint.parent];
    out_.open("joint", {{"name", joint.name}, {"type", sdf_type(joint.kind)}});
    write_pose(joint.frame);
    out_.leaf("parent", is_unwritten_world(parent) ? "world" : model_.links[parent].name);
    out_.leaf("child", model_.links[joint.child].name);
    if (joint.has_one_axis()) {
      write_axis(joint);
    }
    if (joint.armature != 0) {
      out_.leaf("drake:rotor_inertia", numbers_text({joint.armature}));
      out_.leaf("drake:gear_ratio", "1");
    }
    out_.close("joint");
  }

  const robot::RobotModel& model_;
  Carriers carriers_;
  std::vector<const robot::Joint*> carried_by_;  // (link_count)
  bool has_world_link_ = false;
  urdf::XmlWriter out_;
};

}  // namespace

std::string write_sdf(const robot::RobotModel& model) { return SdfWriter(model).run(); }

}  // namespace tenon::sdf
