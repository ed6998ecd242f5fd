// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Numbers and operations that are well formed but cannot be meant: sizes that are not positive, a
// mass of zero with moments of inertia, gravity that does not point down, targets of drives that no
// gain pulls to, joints that break at once, operations that no order names.
#include <algorithm>
#include <cmath>
#include <string_view>

#include "tenon/check/joint_state.h"
#include "tenon/check/subject.h"
#include "tenon/layer/fields.h"
#include "tenon/math/quaternion.h"
#include "tenon/physics/attribute_values.h"

namespace tenon::check {
namespace {

using scene::Drive;
using scene::Joint;

constexpr std::string_view kOperation = "xformOp:";

/// A length of a shape, which is positive; `may_be_zero` of capsules, which are balls then.
struct SizeOfShape {
  const char* type;
  const char* name;
  bool may_be_zero = false;
};

constexpr SizeOfShape kSizesOfShapes[] = {{"Cube", "size"},
                                          {"Sphere", "radius"},
                                          {"Capsule", "radius"},
                                          {"Capsule", "height", true},
                                          {"Cylinder", "radius"},
                                          {"Cylinder", "height"},
                                          {"Cone", "radius"},
                                          {"Cone", "height"},
                                          {"Capsule_1", "height", true},
                                          {"Cylinder_1", "height"},
                                          {"Capsule_1", "radiusTop", true},
                                          {"Capsule_1", "radiusBottom", true},
                                          {"Cylinder_1", "radiusTop", true},
                                          {"Cylinder_1", "radiusBottom", true}};

/// Moments of inertia that are not all 0.
bool authors_moments(const stage::Prim& prim) {
  const stage::Attribute inertia = prim.attribute("physics:diagonalInertia");
  const auto moments = inertia.has_authored_value() ? inertia.get_as<Vec3f>() : std::nullopt;
  return moments && !(to_double(*moments) == Vec3d{});
}

/// Which way is down on the stage; nothing where it does not say so itself.
std::optional<Vec3d> authored_down(const stage::Stage& stage) {
  if (!stage.has_authored_metadata(layer::fields::upAxis)) {
    return std::nullopt;
  }
  const auto axis = stage.metadata(layer::fields::upAxis);
  const Token* up = axis.get<Token>();
  constexpr std::string_view kAxes = "XYZ";
  const std::size_t at =
      up == nullptr || up->view().size() != 1 ? std::string_view::npos : kAxes.find(up->view());
  if (at == std::string_view::npos) {
    return std::nullopt;
  }
  Vec3d down;
  down[at] = -1;
  return down;
}

bool is_along_an_axis(const Vec3d& unit) {
  return std::any_of(unit.v.begin(), unit.v.end(),
                     [](double part) { return std::fabs(part) > 0.999; });
}

std::string text_of(const Vec3d& v) {
  return "(" + digits(v[0]) + ", " + digits(v[1]) + ", " + digits(v[2]) + ")";
}

/// Three components, or three times the one number of a rotation about an axis.
std::optional<Vec3d> components_of(const layer::Value& value) {
  if (const auto* wide = value.get<Vec3d>()) {
    return *wide;
  }
  if (const auto* narrow = value.get<Vec3f>()) {
    return to_double(*narrow);
  }
  const std::optional<double> number = physics::number_of(value);
  return number ? std::optional<Vec3d>({{*number, *number, *number}}) : std::nullopt;
}

/// The operation would change nothing: a rest of another tool.
bool is_idle(Token name, const layer::Value& value) {
  const std::string_view kind = name.view().substr(kOperation.size());
  if (const std::optional<Vec3d> parts = components_of(value)) {
    const double neutral = kind.starts_with("scale") ? 1 : 0;
    return *parts == Vec3d{{neutral, neutral, neutral}};
  }
  if (const auto* turn = value.get<Quatf>()) {
    return to_double(*turn) == kIdentityRotation;
  }
  if (const auto* turn = value.get<Quatd>()) {
    return *turn == kIdentityRotation;
  }
  const auto* matrix = value.get<Mat4d>();
  return matrix != nullptr && *matrix == Mat4d::identity();
}

/// The order has the operation, inverted or not.
bool is_ordered(const layer::Array<Token>& order, Token name) {
  constexpr std::string_view kInverted = "!invert!";
  return std::any_of(order.begin(), order.end(), [&](Token entry) {
    const std::string_view text = entry.view();
    return entry == name ||
           (text.starts_with(kInverted) && text.substr(kInverted.size()) == name.view());
  });
}

}  // namespace

// S-52
void check_size_of_shapes(const Subject& subject, Reporter& report) {
  for (const scene::Collider& collider : subject.scene.colliders) {
    const stage::Prim prim = subject.stage.prim(collider.path);
    for (const SizeOfShape& size : kSizesOfShapes) {
      const std::optional<double> value =
          prim && prim.type_name() == size.type ? authored_number(prim, size.name) : std::nullopt;
      if (value && (*value < 0 || (*value == 0 && !size.may_be_zero))) {
        report.at(prim, size.name,
                  std::string(size.name) + " is " + digits(*value) +
                      (*value < 0 ? ", and lengths are positive: it counts without its sign here"
                                  : ": the shape has no extent and touches nothing"),
                  "author a positive number");
      }
    }
  }
}

// S-41: zero means unset, and then what the colliders weigh.
void check_zero_mass(const Subject& subject, Reporter& report) {
  const Token mass("physics:mass");
  for (const scene::Body& body : subject.scene.bodies) {
    const stage::Prim prim = subject.stage.prim(body.path);
    if (authors_moments(prim) && authored_number(prim, mass) == 0.0 &&
        body.mass_source != scene::MassSource::Authored) {
      report.at(prim, mass,
                "the body has moments of inertia and a mass of 0, which means that none is "
                "authored: it weighs " +
                    digits(body.mass) + " kg",
                "author the mass that the moments belong to");
    }
  }
}

// S-41: the schema's way to leave the mass open; some exporters mean a body without mass.
void check_unset_mass(const Subject& subject, Reporter& report) {
  const Token name("physics:mass");
  for (const scene::Body& body : subject.scene.bodies) {
    const stage::Prim prim = subject.stage.prim(body.path);
    if (prim && !body.kinematic && authored_number(prim, name) == 0.0 &&
        body.mass_source != scene::MassSource::Authored && !authors_moments(prim)) {
      report.at(prim, name,
                "a mass of 0 means that none is authored: the body weighs " + digits(body.mass) +
                    " kg by its colliders",
                "author the mass, or remove physics:mass");
    }
  }
}

// S-14
void check_gravity_direction(const Subject& subject, Reporter& report) {
  const Token name("physics:gravityDirection");
  const std::optional<Vec3d> down = authored_down(subject.stage);
  for (const stage::Prim& prim : subject.prims) {
    if (!down || prim.type_name() != "PhysicsScene" || !prim.attribute(name).has_authored_value() ||
        authored_number(prim, "physics:gravityMagnitude") == 0.0) {
      continue;
    }
    const auto authored = prim.attribute(name).get_as<Vec3f>();
    const Vec3d direction = authored ? to_double(*authored) : Vec3d{};
    if (!(length(direction) > 0) || !std::isfinite(length(direction))) {
      continue;
    }
    const Vec3d unit = direction * (1 / length(direction));
    if (is_along_an_axis(unit) && dot(unit, *down) < 0.5) {
      report.at(prim, name,
                "gravity points along " + text_of(direction) + ", " +
                    (dot(unit, *down) < -0.5 ? "up" : "to the side") + ": down is " +
                    text_of(*down) + " on this stage",
                "author " + text_of(*down) + ", leave it out, which means down, or correct upAxis");
    }
  }
}

// S-102
void check_target_without_gain(const Subject& subject, Reporter& report) {
  for (const Joint& joint : subject.scene.joints) {
    for (const Drive& drive : joint.drives) {
      const bool place = drive.target_position != 0 && drive.stiffness == 0 && drive.damping != 0;
      const bool speed = drive.target_velocity != 0 && drive.damping == 0 && drive.stiffness != 0;
      if (place || speed) {
        report.at(subject.stage.prim(drive.source),
                  std::string("the drive has a target ") +
                      (place ? "position and no stiffness" : "velocity and no damping") +
                      ": nothing pulls to it",
                  place ? "author stiffness, or remove targetPosition"
                        : "author damping, or remove targetVelocity");
      }
    }
  }
}

// S-93
void check_break_at_once(const Subject& subject, Reporter& report) {
  for (const Joint& joint : subject.scene.joints) {
    if (joint.enabled && (joint.break_force == 0 || joint.break_torque == 0)) {
      const char* name = joint.break_force == 0 ? "physics:breakForce" : "physics:breakTorque";
      report.at(subject.stage.prim(joint.path), name,
                std::string(name) + " is 0: the joint breaks as soon as it carries anything",
                "author the break force, or clear it, so that the joint never breaks");
    }
  }
}

void check_unordered_op(const Subject& subject, Reporter& report) {
  const Token order_name("xformOpOrder");
  for (const stage::Prim& prim : subject.prims) {
    const std::vector<Token>& authored = prim.unordered_property_names();
    const auto is_operation = [](Token name) { return name.view().starts_with(kOperation); };
    if (std::none_of(authored.begin(), authored.end(), is_operation) || !prim.is_a("Xformable")) {
      continue;
    }
    const auto order = prim.attribute(order_name).get_as<layer::Array<Token>>();
    const layer::Array<Token> ordered = order.value_or(layer::Array<Token>());
    const auto is_left_out = [&](Token name) {
      return is_operation(name) && !is_ordered(ordered, name);
    };
    if (std::none_of(authored.begin(), authored.end(), is_left_out)) {
      continue;
    }
    for (const Token name : prim.authored_property_names()) {
      const stage::Attribute operation = prim.attribute(name);
      if (is_left_out(name) && operation.has_authored_value() && !is_idle(name, operation.get())) {
        report.at(prim, name, name.str() + " has no effect: xformOpOrder does not name it",
                  "add it to xformOpOrder, or remove it");
      }
    }
  }
}

}  // namespace tenon::check
