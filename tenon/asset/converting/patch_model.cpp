// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A property belongs to a rule, and a rule writes all that it is about, once for each prim. What a
// rule cannot say without guessing is left, with the reason: an element that has no name of its
// own, a coordinate that counts from a reference, an actuator with a gear where the drive has none.
#include "tenon/asset/converting/patch_model.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "tenon/asset/converting/model_text.h"
#include "tenon/asset/converting/patch_seen.h"
#include "tenon/math/angle.h"

namespace tenon {
namespace {

using scene::Index;
using scene::PhysicsScene;
using Numbers = std::vector<double>;

template <class T>
const T* at_path(const std::vector<T>& list, Path path) {
  const auto at =
      std::find_if(list.begin(), list.end(), [&](const T& item) { return item.path == path; });
  return at == list.end() ? nullptr : &*at;
}

bool all_finite(const Numbers& numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](double n) { return std::isfinite(n); });
}

constexpr const char* kNoElement = "the model has no element of its name";

/// The text, and its new contents.
struct Patching {
  ModelText text;
  const PhysicsScene& scene;
  const scene::MujocoParts& parts;
  const robot::RobotModel& seen;
  const std::function<std::string(Path)>& name_of;
};

// Bodies.
const scene::Body* body_of(Patching& at, Path prim, pugi::xml_node& node) {
  node = at.text.named("body", at.name_of(prim));
  return node ? at_path(at.scene.bodies, prim) : nullptr;
}

std::string why_not_weighed(Patching& at) {
  const pugi::xml_node compiler = at.text.section("compiler");
  if (std::string_view(compiler.attribute("inertiafromgeom").value()) == "true") {
    return "the model takes masses from shapes alone";
  }
  return compiler.attribute("settotalmass").as_double(-1) > 0 ? "the model sets its total mass"
                                                              : "";
}

/// All of it, as the body's shapes give none of it then.
std::string write_inertia(Patching& at, Path prim) {
  pugi::xml_node node;
  const scene::Body* body = body_of(at, prim, node);
  if (body == nullptr) {
    return kNoElement;
  }
  if (const std::string why = why_not_weighed(at); !why.empty()) {
    return why;
  }
  const Vec3d center = body->center_of_mass;
  const Mat3d& inertia = body->inertia;
  const Numbers moments{inertia[0][0], inertia[1][1], inertia[2][2],
                        inertia[0][1], inertia[0][2], inertia[1][2]};
  if (!std::isfinite(body->mass) || !all_finite(moments)) {
    return "it is not a finite number";
  }
  pugi::xml_node inertial = node.child("inertial");
  inertial = inertial ? inertial : node.prepend_child("inertial");
  for (const char* other : {"quat", "diaginertia", "axisangle", "xyaxes", "zaxis", "euler"}) {
    inertial.remove_attribute(other);
  }
  at.text.set_numbers(inertial, "pos", {center[0], center[1], center[2]});
  at.text.set_numbers(inertial, "mass", {body->mass});
  at.text.set_numbers(inertial, "fullinertia", moments);
  return {};
}

std::string write_mass(Patching& at, Path prim) {
  pugi::xml_node node;
  const scene::Body* body = body_of(at, prim, node);
  if (body == nullptr) {
    return kNoElement;
  }
  if (const std::string why = why_not_weighed(at); !why.empty()) {
    return why;
  }
  if (const pugi::xml_node inertial = node.child("inertial")) {
    at.text.set_numbers(inertial, "mass", {body->mass});
    return {};
  }
  return write_inertia(at, prim);
}

std::string write_weight(Patching& at, Path prim) {
  pugi::xml_node node;
  const scene::Body* body = body_of(at, prim, node);
  if (body == nullptr || !std::isfinite(body->gravity_scale)) {
    return kNoElement;
  }
  at.text.set_numbers(node, "gravcomp", {1 - body->gravity_scale});
  return {};
}

// Joints.
const scene::Joint* joint_of(Patching& at, Path prim, pugi::xml_node& node) {
  const scene::Joint* joint = at_path(at.scene.joints, prim);
  node = at.text.named("joint", at.name_of(prim));
  return node ? joint : nullptr;
}

bool counts_in_degrees(Patching& at, const scene::Joint& joint) {
  const std::string_view angle = at.text.section("compiler").attribute("angle").value();
  return joint.kind != scene::JointKind::Prismatic && angle != "radian";
}

std::string write_limits(Patching& at, Path prim) {
  pugi::xml_node node;
  const scene::Joint* joint = joint_of(at, prim, node);
  if (joint == nullptr) {
    return kNoElement;
  }
  if (!at.text.value(node, "ref").empty()) {
    return "the coordinate of the joint counts from a reference";
  }
  const double unit = counts_in_degrees(at, *joint) ? kDegreesPerRadian : 1;
  const Numbers range{joint->lower * unit, joint->upper * unit};
  if (!all_finite(range) || range[0] >= range[1]) {
    return "it is not a range";
  }
  at.text.set_numbers(node, "range", range);
  if (at.text.value(node, "limited") != "true") {
    ModelText::set(node, "limited", "true");
  }
  return {};
}

std::string write_joint(Patching& at, Path prim, const char* attribute,
                        double scene::Joint::* member) {
  pugi::xml_node node;
  const scene::Joint* joint = joint_of(at, prim, node);
  if (joint == nullptr) {
    return kNoElement;
  }
  if (!std::isfinite(joint->*member)) {
    return "it is not a finite number";
  }
  at.text.set_numbers(node, attribute, {joint->*member});
  return {};
}
std::string write_armature(Patching& at, Path prim) {
  return write_joint(at, prim, "armature", &scene::Joint::armature);
}
std::string write_damping(Patching& at, Path prim) {
  return write_joint(at, prim, "damping", &scene::Joint::damping);
}
std::string write_joint_friction(Patching& at, Path prim) {
  return write_joint(at, prim, "frictionloss", &scene::Joint::friction);
}

std::string write_stiffness(Patching& at, Path prim) {
  pugi::xml_node node;
  const scene::Joint* joint = joint_of(at, prim, node);
  if (joint == nullptr) {
    return kNoElement;
  }
  if (!at.text.value(node, "ref").empty()) {
    return "the coordinate of the joint counts from a reference";
  }
  const double unit = counts_in_degrees(at, *joint) ? kDegreesPerRadian : 1;
  at.text.set_numbers(node, "stiffness", {joint->stiffness});
  at.text.set_numbers(node, "springref", {joint->spring_reference * unit});
  return {};
}

std::string write_softness(Patching& at, Path prim) {
  pugi::xml_node node;
  const scene::Joint* joint = joint_of(at, prim, node);
  if (joint == nullptr) {
    return kNoElement;
  }
  const scene::MujocoSoftness& soft = joint->parts.mujoco;
  const std::pair<const char*, const Numbers*> lists[] = {
      {"solreflimit", &soft.solref_limit},
      {"solimplimit", &soft.solimp_limit},
      {"solreffriction", &soft.solref_friction},
      {"solimpfriction", &soft.solimp_friction}};
  for (const auto& [attribute, list] : lists) {
    if (!list->empty() && all_finite(*list)) {
      at.text.set_numbers(node, attribute, *list);
    }
  }
  return {};
}

/// Where the model says it now: at the actuator or at the joint.
std::string write_effort(Patching& at, pugi::xml_node actuator, pugi::xml_node joint, double effort,
                         double gear) {
  const Numbers force = at.text.numbers(actuator, "forcerange");
  const Numbers of_joint = at.text.numbers(joint, "actuatorfrcrange");
  if (!std::isfinite(effort)) {
    return force.empty() && of_joint.empty() ? "" : "it has no end any more";
  }
  if (!force.empty()) {
    const double most = effort / std::fabs(gear);
    at.text.set_numbers(actuator, "forcerange", {-most, most});
  } else {
    at.text.set_numbers(joint, "actuatorfrcrange", {-effort, effort});
  }
  return {};
}

std::string write_gains(Patching& at, pugi::xml_node node, double stiffness, double damping) {
  const std::string_view tag = node.name();
  if (tag == "position") {
    at.text.set_numbers(node, "kp", {stiffness});
    at.text.set_numbers(node, "kv", {damping});
    node.remove_attribute("dampratio");
    return {};
  }
  if (tag == "velocity") {
    at.text.set_numbers(node, "kv", {damping});
    return stiffness == 0 ? "" : "its actuator has no stiffness";
  }
  Numbers bias = at.text.numbers(node, "biasprm");
  bias.resize(std::max<std::size_t>(bias.size(), 3), 0);
  if (bias[0] != 0 && bias[1] == 0) {
    return "its actuator has a bias of its own";
  }
  const Numbers gains = at.text.numbers(node, "gainprm");
  const double gain = gains.empty() ? 1 : gains[0];
  if (bias[1] != 0 && gain == -bias[1]) {  // controls stay what they are
    at.text.set_numbers(node, "gainprm", {stiffness});
  } else if (bias[1] == 0 && bias[2] != 0 && gain == -bias[2]) {
    at.text.set_numbers(node, "gainprm", {damping});
  }
  const double start = bias[0] == 0 ? 0 : bias[0] / -bias[1] * stiffness;
  at.text.set_numbers(node, "biasprm", {start, 0 - stiffness, 0 - damping});
  return {};
}

std::string write_spring(Patching& at, const scene::Joint& joint, const scene::Drive& drive) {
  const std::string name = at.name_of(joint.path);
  const pugi::xml_node node = at.text.spring_of(name);
  const pugi::xml_node turned = at.text.named("joint", name);
  if (!node || !turned || joint.drives.size() != 1 || drive.acceleration) {
    return "the model has no single spring and damper for it";
  }
  const Numbers gears = at.text.numbers(node, "gear");
  const double gear = gears.empty() ? 1 : gears[0];
  if (gear == 0) {
    return "its actuator has no gear";
  }
  const std::string why =
      write_gains(at, node, drive.stiffness / (gear * gear), drive.damping / (gear * gear));
  return why.empty() ? write_effort(at, node, turned, drive.max_force, gear) : why;
}

// Actuators.
/// Of a joint, or of the actuator that is the drive of one.
std::string write_drive(Patching& at, Path prim) {
  for (const scene::Joint& joint : at.scene.joints) {
    for (const scene::Drive& drive : joint.drives) {
      if (drive.source == prim || joint.path == prim) {
        return write_spring(at, joint, drive);
      }
    }
  }
  return "nothing drives it";
}

const scene::MujocoActuator* motor_of(Patching& at, Path prim, pugi::xml_node& node) {
  node = at.text.named("actuator", at.name_of(prim));
  return at_path(at.parts.actuators, prim);
}

/// The drive of a joint here and in the text.
bool is_spring_motor(Patching& at, const scene::MujocoActuator& motor, pugi::xml_node node) {
  return motor.drive && at.text.is_spring(node);
}

std::string write_actuator(Patching& at, Path prim) {
  pugi::xml_node node;
  const scene::MujocoActuator* motor = motor_of(at, prim, node);
  if (motor == nullptr || !node) {
    return kNoElement;
  }
  if (is_spring_motor(at, *motor, node)) {
    return write_drive(at, prim);
  }
  const auto set = [&](const char* attribute, const auto& numbers) {
    at.text.set_numbers(node, attribute, Numbers(numbers.begin(), numbers.end()));
  };
  const std::string_view tag = node.name();
  if (tag == "motor" && (motor->gain[0] != 1 || motor->bias_type != "none")) {
    node.set_name("general");
  } else if (tag != "motor" && tag != "general") {
    return "its actuator is of a kind of its own";
  }
  if (node.name() == std::string_view("general")) {
    set("gainprm", motor->gain);
  }
  if (motor->bias_type != "none") {
    set("biasprm", motor->bias);
  }
  set("gear", motor->gear);
  if (motor->force_range) {
    set("forcerange", *motor->force_range);
  }
  return {};
}

std::string write_control_range(Patching& at, Path prim) {
  pugi::xml_node node;
  const scene::MujocoActuator* motor = motor_of(at, prim, node);
  if (motor == nullptr || !node || !motor->control_range || is_spring_motor(at, *motor, node)) {
    return "the controls of its actuator are measured in another way";
  }
  at.text.set_numbers(node, "ctrlrange", {(*motor->control_range)[0], (*motor->control_range)[1]});
  return {};
}

// The world.
std::string write_gravity(Patching& at, Path prim) {
  const scene::Scene* world = at_path(at.scene.scenes, prim);
  if (world == nullptr || at.scene.scenes.size() != 1) {
    return "the asset has several scenes";
  }
  const Vec3d& gravity = world->gravity;
  at.text.set_numbers(at.text.section("option"), "gravity", {gravity[0], gravity[1], gravity[2]});
  return {};
}

std::string write_time_step(Patching& at, Path prim) {
  const scene::Scene* world = at_path(at.scene.scenes, prim);
  if (world == nullptr || at.scene.scenes.size() != 1 || !world->time_step) {
    return "the asset has several scenes, or no time step";
  }
  at.text.set_numbers(at.text.section("option"), "timestep", {*world->time_step});
  return {};
}

// Shapes.
/// Colliders have a name of their own; a mesh may be below the prim with the name.
pugi::xml_node geom_of(Patching& at, Path prim) {
  constexpr std::string_view kEnding = "_collider";
  for (const Path path : {prim, prim.parent()}) {
    std::string name = at.name_of(path);
    if (name.ends_with(kEnding)) {
      name.resize(name.size() - kEnding.size());
    }
    if (const pugi::xml_node node = at.text.named("geom", name)) {
      return node;
    }
  }
  return {};
}

std::string write_friction(Patching& at, Path prim) {
  const scene::Collider* collider = at_path(at.scene.colliders, prim);
  const pugi::xml_node node = geom_of(at, prim);
  if (collider == nullptr || !node) {
    return kNoElement;
  }
  if (!collider->material) {
    return "nothing is bound to it any more";
  }
  const scene::Material& material = at.scene.materials[*collider->material];
  Numbers friction{material.dynamic_friction, 0.005, 0.0001};  // as MuJoCo has it
  const Numbers known = at.text.numbers(node, "friction");
  for (std::size_t i = 1; i < std::min(known.size(), friction.size()); ++i) {
    friction[i] = known[i];
  }
  friction[1] = material.torsional_friction.value_or(friction[1]);
  friction[2] = material.rolling_friction.value_or(friction[2]);
  at.text.set_numbers(node, "friction", friction);
  return {};
}

/// Why it cannot be said; empty: it is.
std::string apply_edit(Patching& at, const PropertyEdit& edit) {
  struct Rule {
    std::string_view property;
    std::string (*write)(Patching& at, Path prim);
  };
  constexpr Rule kRules[] = {
      {"physics:mass", write_mass},
      {"physics:centerOfMass", write_inertia},
      {"physics:diagonalInertia", write_inertia},
      {"physics:principalAxes", write_inertia},
      {"newton:inertia", write_inertia},
      {"tenon:gravityScale", write_weight},
      {"physics:lowerLimit", write_limits},
      {"physics:upperLimit", write_limits},
      {"newton:armature", write_armature},
      {"mjc:armature", write_armature},
      {"newton:damping", write_damping},
      {"mjc:damping", write_damping},
      {"newton:friction", write_joint_friction},
      {"mjc:frictionloss", write_joint_friction},
      {"mjc:stiffness", write_stiffness},
      {"mjc:springref", write_stiffness},
      {"mjc:solreflimit", write_softness},
      {"mjc:solimplimit", write_softness},
      {"mjc:solreffriction", write_softness},
      {"mjc:solimpfriction", write_softness},
      {"mjc:gainPrm", write_actuator},
      {"mjc:biasPrm", write_actuator},
      {"mjc:gear", write_actuator},
      {"mjc:ctrlRange:min", write_control_range},
      {"mjc:ctrlRange:max", write_control_range},
      {"mjc:forceRange:min", write_actuator},
      {"mjc:forceRange:max", write_actuator},
      {"physics:gravityDirection", write_gravity},
      {"physics:gravityMagnitude", write_gravity},
      {"mjc:option:timestep", write_time_step},
      {"newton:timeStepsPerSecond", write_time_step},
      {"material:binding", write_friction},
      {"material:binding:physics", write_friction},
  };
  if (edit.property.starts_with("Camera.") || edit.property.starts_with("Light.")) {
    return patch_seen(at.text, at.seen, edit, at.name_of(edit.prim));
  }
  for (const Rule& rule : kRules) {
    if (rule.property == edit.property) {
      return rule.write(at, edit.prim);
    }
  }
  return edit.property.starts_with("drive:") ? write_drive(at, edit.prim)
                                             : "it has no attribute of its own";
}

}  // namespace

Result<PatchedModel> patch_model(const std::string& text, const std::vector<PropertyEdit>& edits,
                                 const PhysicsScene& scene, const scene::MujocoParts& parts,
                                 const robot::RobotModel& seen,
                                 const std::function<std::string(Path prim)>& name_of) {
  TENON_TRY(ModelText model, ModelText::read(text));
  Patching patching{std::move(model), scene, parts, seen, name_of};
  PatchedModel patched;
  for (const PropertyEdit& edit : edits) {
    if (std::string why = apply_edit(patching, edit); !why.empty()) {
      patched.left.push_back({edit, std::move(why)});
    }
  }
  patched.text = patching.text.str();
  return patched;
}

}  // namespace tenon
