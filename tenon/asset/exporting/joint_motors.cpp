// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Controllers know joints by name and one number each: what they are told to do, how hard and how
// fast. Joints of several axes have no such number in the programs that configurations are for, and
// are listed. A joint that follows another has limits and no drive.
#include "tenon/asset/exporting/joint_motors.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>

#include "tenon/dynamics/multibody.h"
#include "tenon/layer/fields.h"
#include "tenon/scene/joint_freedom.h"

namespace tenon {

std::string shown_name(const stage::Stage& stage, Path path) {
  if (const stage::Prim prim = stage.prim(path)) {
    const layer::Value shown = prim.metadata(layer::fields::displayName);
    if (const auto* text = shown.get<std::string>(); text != nullptr && !text->empty()) {
      return *text;
    }
  }
  return path.name().str();
}

namespace {

class MotorReader {
 public:
  MotorReader(const stage::Stage& stage, const scene::PhysicsScene& scene, std::string rule,
              std::string format, Diagnostics& diagnostics)
      : stage_(stage),
        scene_(scene),
        rule_(std::move(rule)),
        format_(std::move(format)),
        diagnostics_(diagnostics),
        multibody_(scene),
        number_of_(scene.joints.size()) {}

  std::vector<JointMotor> run() {
    const dynamics::Posture start = multibody_.start();
    for (scene::Index i = 0; i < scene_.joints.size(); ++i) {
      add(i, start);
    }
    for (scene::Index i = 0; i < scene_.joints.size(); ++i) {
      follow(i);
    }
    return std::move(motors_);
  }

 private:
  void left_out(Path prim, const std::string& why) {
    Diagnostic finding;
    finding.severity = Severity::Warning;
    finding.rule = rule_;
    finding.message = why + ", which " + format_ + " has no place for; skipped";
    finding.prim = prim.str();
    diagnostics_.add(std::move(finding));
  }

  void add(scene::Index number, const dynamics::Posture& start) {
    const scene::Joint& joint = scene_.joints[number];
    if (multibody_.forest().joints[number] != scene::ForestRole::Tree) {
      return;
    }
    const scene::JointDofs& dofs = multibody_.dofs()[number];
    if (dofs.count() == 0) {
      return;
    }
    if (!scene::has_one_dof(joint) || dofs.count() != 1) {
      left_out(joint.path, "the joint has several axes");
      return;
    }
    const scene::FreeDof& dof = dofs.free[0];
    JointMotor motor;
    motor.path = joint.path;
    motor.prim = joint.path.name().str();
    motor.name = shown_name(stage_, joint.path);
    motor.angular = scene::is_angular(dof.dof);
    motor.velocity_limit = joint.velocity_limit;
    motor.armature = joint.armature;
    motor.friction = joint.friction;
    motor.passive_damping = joint.damping;
    motor.lower = dof.lower;
    motor.upper = dof.upper;
    motor.start = start.joints[number].empty() ? 0 : start.joints[number][0];
    for (const scene::Drive& drive : joint.drives) {
      if (drive.dof == dof.dof) {
        take_drive(joint, drive, motor);
      }
    }
    number_of_[number] = motors_.size();
    motors_.push_back(std::move(motor));
  }

  void take_drive(const scene::Joint& joint, const scene::Drive& drive, JointMotor& motor) {
    motor.effort_limit = std::min(motor.effort_limit, drive.max_force);
    if (drive.stiffness == 0 && drive.damping == 0) {
      return;
    }
    if (motor.driven) {
      left_out(joint.path, "more than one drive acts on the joint");
      return;
    }
    if (drive.acceleration) {
      left_out(joint.path, "the gains of the drive are for each unit of inertia");
      motor.per_inertia = true;
      return;
    }
    motor.driven = true;
    motor.stiffness = drive.stiffness;
    motor.damping = drive.damping;
    motor.target = drive.target_position;
  }

  void follow(scene::Index number) {
    const auto follower = number_of_[number];
    for (const scene::Mimic& mimic : scene_.joints[number].mimics) {
      const auto leader = number_of_[mimic.leader];
      if (follower && leader) {
        motors_[*follower].leader = leader;
        motors_[*follower].multiplier = mimic.multiplier;
        motors_[*follower].offset = mimic.offset;
      }
    }
  }

  const stage::Stage& stage_;
  const scene::PhysicsScene& scene_;
  std::string rule_;
  std::string format_;
  Diagnostics& diagnostics_;
  dynamics::Multibody multibody_;
  std::vector<std::optional<std::size_t>> number_of_;  // (joint_count), into motors_
  std::vector<JointMotor> motors_;
};

/// What all names begin with, up to a boundary of words; empty where that is little.
std::string common_start(const std::vector<JointMotor>& motors,
                         const std::vector<std::size_t>& group) {
  std::string start = motors[group.front()].prim;
  for (const std::size_t i : group) {
    const std::string& name = motors[i].prim;
    std::size_t length = 0;
    while (length < std::min(start.size(), name.size()) && start[length] == name[length]) {
      ++length;
    }
    start.resize(length);
  }
  while (!start.empty() && (start.back() == '_' || (start.back() >= '0' && start.back() <= '9'))) {
    start.pop_back();
  }
  return start.size() < 3 ? std::string() : start;
}

}  // namespace

std::vector<JointMotor> joint_motors(const stage::Stage& stage, const scene::PhysicsScene& scene,
                                     const std::string& rule, const std::string& format,
                                     Diagnostics& diagnostics) {
  return MotorReader(stage, scene, rule, format, diagnostics).run();
}

std::vector<MotorGroup> motor_groups(const std::vector<JointMotor>& motors) {
  using Key = std::array<double, 8>;
  std::map<std::pair<Key, std::array<bool, 3>>, std::size_t> known;
  std::vector<MotorGroup> groups;
  for (std::size_t i = 0; i < motors.size(); ++i) {
    const JointMotor& m = motors[i];
    const Key numbers{m.stiffness, m.damping,  m.effort_limit,    m.velocity_limit,
                      m.armature,  m.friction, m.passive_damping, m.angular ? 1.0 : 0.0};
    const std::array<bool, 3> role{m.driven, m.per_inertia, m.leader.has_value()};
    const auto [at, is_new] = known.emplace(std::pair(numbers, role), groups.size());
    if (is_new) {
      groups.emplace_back();
    }
    groups[at->second].motors.push_back(i);
  }
  std::set<std::string> taken;
  for (MotorGroup& group : groups) {
    const JointMotor& first = motors[group.motors.front()];
    const std::string fallback = first.leader                        ? "followers"
                                 : first.driven || first.per_inertia ? "motors"
                                                                     : "passive";
    const std::string start = common_start(motors, group.motors);
    const std::string base = start.empty() || first.leader ? fallback : start;
    group.name = base;
    for (int i = 2; !taken.insert(group.name).second; ++i) {
      group.name = base + "_" + std::to_string(i);
    }
  }
  return groups;
}

std::string python_name(const std::string& text) {
  std::string name;
  for (const char c : text) {
    const bool ok = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    name += ok ? c : '_';
  }
  return name.empty() || (name[0] >= '0' && name[0] <= '9') ? "_" + name : name;
}

std::string python_text(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      constexpr const char* kHex = "0123456789abcdef";
      out += "\\x";
      out += kHex[(static_cast<unsigned char>(c) >> 4) & 0xfu];
      out += kHex[static_cast<unsigned char>(c) & 0xfu];
      continue;
    }
    out += c == '"' || c == '\\' ? "\\" : "";
    out += c;
  }
  return out + "\"";
}

}  // namespace tenon
