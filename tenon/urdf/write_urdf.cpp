// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The text is written in one pass, in the order of the model. Numbers are those that the asset had
// before they became floats (source_number.h). URDF has no quaternions: roll, pitch and yaw
// follow from entries of the rotation matrix. With pitch straight up or down only the sum or the
// difference of the other two has a meaning, so yaw is 0 and roll has all of it. An inertia is
// written in the axes of its link.
#include "tenon/urdf/write_urdf.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <utility>
#include <vector>

#include "tenon/base/text/source_number.h"
#include "tenon/urdf/plain_urdf.h"
#include "tenon/urdf/xml_writer.h"

namespace tenon::urdf {

using robot::GeometryKind;
using robot::JointKind;

namespace {

std::string text_of(std::initializer_list<double> numbers) {
  std::string out;
  for (const double number : numbers) {
    out += (out.empty() ? "" : " ") + source_number(number);
  }
  return out;
}

/// Of places [m], directions and angles [rad].
std::string text_of(Vec3d v) {
  drop_noise(v.v);
  return text_of({v[0], v[1], v[2]});
}

const char* type_of(JointKind kind) {
  return kind == JointKind::Ball ? "spherical" : robot::joint_kind_name(kind).data();
}

class UrdfWriter {
 public:
  explicit UrdfWriter(const robot::RobotModel& model) : model_(model) {}

  std::string run() {
    out_.open("robot", {{"name", model_.name}});
    for (const robot::Material& material : model_.materials) {
      write_material(material);
    }
    for (const robot::Link& link : model_.links) {
      write_link(link);
    }
    for (const robot::Joint& joint : model_.joints) {
      write_joint(joint);
    }
    out_.close("robot");
    return out_.take();
  }

 private:
  void write_material(const robot::Material& material) {
    out_.open("material", {{"name", material.name}});
    if (material.color) {
      const Vec4d& c = *material.color;
      out_.empty("color", {{"rgba", text_of({c[0], c[1], c[2], c[3]})}});
    }
    if (!material.texture.empty()) {
      out_.empty("texture", {{"filename", material.texture}});
    }
    out_.close("material");
  }

  void write_origin(const Pose& pose) {
    if (!(pose == Pose{})) {
      out_.empty("origin",
                 {{"xyz", text_of(pose.position)}, {"rpy", text_of(rpy_of(pose.orientation))}});
    }
  }

  void write_inertial(const robot::Inertial& inertial) {
    const Mat3d i = inertial.inertia_in_link();
    std::array<double, 6> tensor = {i[0][0], i[0][1], i[0][2], i[1][1], i[1][2], i[2][2]};
    drop_noise(tensor, 0);
    out_.open("inertial");
    write_origin({inertial.center_of_mass, kIdentityRotation});
    out_.empty("mass", {{"value", text_of({inertial.mass})}});
    out_.empty("inertia", {{"ixx", text_of({tensor[0]})},
                           {"ixy", text_of({tensor[1]})},
                           {"ixz", text_of({tensor[2]})},
                           {"iyy", text_of({tensor[3]})},
                           {"iyz", text_of({tensor[4]})},
                           {"izz", text_of({tensor[5]})}});
    out_.close("inertial");
  }

  void write_geometry(const robot::Geometry& g) {
    const std::string radius = text_of({g.radius});
    const std::string length = text_of({2 * g.half_height});
    out_.open("geometry");
    switch (g.kind) {
      case GeometryKind::Box:
        out_.empty("box", {{"size", text_of(g.half_extents * 2.0)}});
        break;
      case GeometryKind::Sphere:
        out_.empty("sphere", {{"radius", radius}});
        break;
      case GeometryKind::Cylinder:
        out_.empty("cylinder", {{"radius", radius}, {"length", length}});
        break;
      case GeometryKind::Capsule:
        out_.empty("capsule", {{"radius", radius}, {"length", length}});
        break;
      case GeometryKind::Mesh:
        out_.empty("mesh",
                   {{"filename", model_.meshes[g.mesh].written}, {"scale", text_of(g.scale)}});
        break;
      case GeometryKind::Ellipsoid:
      case GeometryKind::Plane:
        break;  // URDF does not support them
    }
    out_.close("geometry");
  }

  template <class Shape>
  void write_shape(const char* element, const Shape& shape) {
    if (shape.geometry.kind == GeometryKind::Ellipsoid ||
        shape.geometry.kind == GeometryKind::Plane) {
      return;
    }
    if (shape.name.empty()) {
      out_.open(element);
    } else {
      out_.open(element, {{"name", shape.name}});
    }
    write_origin(shape.pose);
    write_geometry(shape.geometry);
    if (shape.material) {
      out_.empty("material", {{"name", model_.materials[*shape.material].name}});
    }
    out_.close(element);
  }

  void write_link(const robot::Link& link) {
    out_.open("link", {{"name", link.name}});
    if (link.inertial) {
      write_inertial(*link.inertial);
    }
    for (const robot::Visual& visual : link.visuals) {
      write_shape("visual", visual);
    }
    for (const robot::Collider& collider : link.colliders) {
      write_shape("collision", collider);
    }
    out_.close("link");
  }

  /// Readers ask for effort and velocity wherever there is a limit, and take 0 as it is written.
  void write_limit(const robot::Joint& joint) {
    const auto finite = [](double value) { return text_of({std::min(value, kNoUrdfLimit)}); };
    const std::string effort = finite(joint.effort_limit);
    const std::string velocity = finite(joint.velocity_limit);
    if (joint.limit) {
      out_.empty("limit", {{"lower", text_of({joint.limit->lower})},
                           {"upper", text_of({joint.limit->upper})},
                           {"effort", effort},
                           {"velocity", velocity}});
    } else {
      out_.empty("limit", {{"effort", effort}, {"velocity", velocity}});
    }
  }

  void write_axis(const robot::Joint& joint) {
    out_.empty("axis", {{"xyz", text_of(rotate(joint.frame.orientation, joint.axis))}});
  }

  void write_optional(const char* name,
                      std::initializer_list<std::pair<const char*, std::optional<double>>> values) {
    XmlWriter::AttributeList attributes;
    for (const auto& [key, value] : values) {
      if (value) {
        attributes.emplace_back(key, text_of({*value}));
      }
    }
    out_.empty(name, attributes);
  }

  void write_one_axis(const robot::Joint& joint) {
    write_axis(joint);
    write_limit(joint);
    if (joint.damping != 0 || joint.friction != 0) {
      out_.empty("dynamics",
                 {{"damping", text_of({joint.damping})}, {"friction", text_of({joint.friction})}});
    }
    if (const auto& safety = joint.safety) {
      write_optional("safety_controller", {{"soft_lower_limit", safety->soft_lower},
                                           {"soft_upper_limit", safety->soft_upper},
                                           {"k_position", safety->position_gain},
                                           {"k_velocity", safety->velocity_gain}});
    }
    if (joint.calibration) {
      write_optional("calibration", {{"rising", joint.calibration->rising},
                                     {"falling", joint.calibration->falling}});
    }
    if (joint.mimic) {
      out_.empty("mimic", {{"joint", model_.joints[joint.mimic->leader].name},
                           {"multiplier", text_of({joint.mimic->multiplier})},
                           {"offset", text_of({joint.mimic->offset})}});
    }
  }

  void write_joint(const robot::Joint& joint) {
    out_.open("joint", {{"name", joint.name}, {"type", type_of(joint.kind)}});
    write_origin(joint.origin);
    out_.empty("parent", {{"link", model_.links[joint.parent].name}});
    out_.empty("child", {{"link", model_.links[joint.child].name}});
    if (joint.has_one_axis()) {
      write_one_axis(joint);
    } else if (joint.kind == JointKind::Planar) {
      write_axis(joint);
    }
    out_.close("joint");
  }

  const robot::RobotModel& model_;
  XmlWriter out_;
};

}  // namespace

Vec3d rpy_of(const Quatd& q) {
  const double sine = 2 * (q.w * q.y - q.z * q.x);
  if (std::fabs(sine) > 1 - 1e-12) {  // straight up or down: roll and yaw are one angle
    return {{2 * std::atan2(q.x, q.w), std::copysign(std::acos(-1.0) / 2, sine), 0}};
  }
  return {{std::atan2(2 * (q.w * q.x + q.y * q.z), 1 - 2 * (q.x * q.x + q.y * q.y)),
           std::asin(sine),
           std::atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z))}};
}

std::string write_urdf(const robot::RobotModel& model) { return UrdfWriter(model).run(); }

}  // namespace tenon::urdf
