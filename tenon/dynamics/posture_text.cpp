// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A pattern may mean joints that follow others or close loops, which are left alone; one that means
// such a joint by its name or path is an error.
#include "tenon/dynamics/posture_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include "tenon/base/text/name_pattern.h"
#include "tenon/base/text/nearest_name.h"
#include "tenon/base/text/quoted_text.h"
#include "tenon/base/text/text_number.h"
#include "tenon/dynamics/drawn_postures.h"
#include "tenon/scene/joint_freedom.h"

namespace tenon::dynamics {
namespace {

constexpr const char* kForm = "write JOINT=VALUE, as in thumb=20deg,slide=5mm";
constexpr double kDegree = M_PI / 180;

Error bad_pose(ErrorCode code, const std::string& message) {
  return Error(code, message).with_rule("pose.bad-text");
}

struct Unit {
  std::string_view name;
  bool angle = false;
  double size = 1;  // in rad or m
};
constexpr std::array kUnits{Unit{"deg", true, kDegree}, Unit{"rad", true, 1},
                            Unit{"mm", false, 0.001}, Unit{"cm", false, 0.01}, Unit{"m", false, 1}};

struct Value {
  double number = 0;
  const Unit* unit = nullptr;  // none: degrees, or units of the stage
};

/// "JOINT[:dof]=VALUE".
struct Wish {
  std::string text;
  std::string joint;
  std::optional<scene::Dof> dof;
  Value value;
};

Result<Value> read_value(std::string_view text) {
  Value value;
  for (const Unit& unit : kUnits) {
    if (text.ends_with(unit.name)) {
      value.unit = &unit;
      text.remove_suffix(unit.name.size());
      break;
    }
  }
  const std::optional<double> number = parse_double(text);
  if (!number || !std::isfinite(*number)) {
    return bad_pose(ErrorCode::Invalid, quoted_text(std::string(text.substr(0, 100))) +
                                            " is no number with deg, rad, m, cm or mm behind it")
        .with_fix(kForm);
  }
  value.number = *number;
  return value;
}

Result<Wish> read_wish(const std::string& text) {
  const std::size_t equals = text.rfind('=');
  if (equals == std::string::npos || equals == 0) {
    return bad_pose(ErrorCode::Invalid, quoted_text(text.substr(0, 100)) + " is no pose of a joint")
        .with_fix(kForm);
  }
  Wish wish{text, text.substr(0, equals), std::nullopt, {}};
  if (const std::size_t colon = wish.joint.rfind(':'); colon != std::string::npos) {
    wish.dof = scene::dof_of(std::string_view(wish.joint).substr(colon + 1));
    if (wish.dof) {
      wish.joint.resize(colon);
    }
  }
  TENON_TRY(wish.value, read_value(std::string_view(text).substr(equals + 1)));
  return wish;
}

Error no_joint(const scene::PhysicsScene& scene, const Wish& wish) {
  std::vector<std::string> names;
  for (const scene::Joint& joint : scene.joints) {
    names.emplace_back(joint.path.name().str());
  }
  const std::vector<std::string_view> views(names.begin(), names.end());
  const std::string_view near =
      wish.joint.size() < 200 ? nearest_name(wish.joint, views) : std::string_view();
  return bad_pose(ErrorCode::NotFound, "no movable joint is called " + quoted_text(wish.joint))
      .with_fix(near.empty() ? "name a joint as tenon inertia ASSET lists them"
                             : "did you mean " + std::string(near) + "?");
}

/// The place of the wished degree of freedom; none: the joint has it not.
std::optional<std::size_t> part_for(const scene::JointDofs& dofs, const Wish& wish) {
  for (std::size_t i = 0; i < dofs.free.size(); ++i) {
    if (!wish.dof ? dofs.count() == 1 : dofs.free[i].dof == *wish.dof) {
      return i;
    }
  }
  return std::nullopt;
}

Result<double> in_si(const scene::PhysicsScene& scene, const scene::Joint& joint, scene::Dof dof,
                     const Wish& wish) {
  const bool angle = is_angular(dof);
  if (!wish.value.unit) {
    return wish.value.number * (angle ? kDegree : scene.meters_per_unit);
  }
  if (wish.value.unit->angle != angle) {
    return bad_pose(ErrorCode::Invalid, quoted_text(wish.text) + ": " + joint.path.str() +
                                            (angle ? " turns" : " slides"))
        .with_fix(angle ? "write degrees or rad" : "write m, cm or mm");
  }
  return wish.value.number * wish.value.unit->size;
}

Result<void> move(const Multibody& multibody, const Wish& wish,
                  std::vector<std::vector<double>>& joints) {
  const scene::PhysicsScene& scene = multibody.scene();
  TENON_TRY(const NamePattern pattern, NamePattern::parse(wish.joint));
  bool found = false;
  for (Index j = 0; j < scene.joints.size(); ++j) {
    const scene::Joint& joint = scene.joints[j];
    const std::optional<std::size_t> part = part_for(multibody.dofs()[j], wish);
    if (!part || !pattern.matches(joint.path)) {
      continue;
    }
    const scene::Dof dof = multibody.dofs()[j].free[*part].dof;
    const bool follows = mimic_of(joint, dof) != nullptr;
    if (follows || !multibody.coordinate_of(j, dof)) {
      if (joint.path.str() == wish.joint || joint.path.name().str() == wish.joint) {
        return bad_pose(ErrorCode::Invalid,
                        joint.path.str() + (follows ? " follows another joint"
                                                    : " closes a loop, which other joints move"))
            .with_fix(follows ? "move its leader, " +
                                    scene.joints[joint.mimics.front().leader].path.str()
                              : "move the other joints of the loop");
      }
      continue;
    }
    found = true;
    TENON_TRY(joints[j][*part], in_si(scene, joint, dof, wish));
  }
  return found ? Result<void>() : no_joint(scene, wish);
}

}  // namespace

Result<Posture> posture_from_texts(const Multibody& multibody,
                                   const std::vector<std::string>& texts) {
  Posture start = multibody.start();
  if (texts.empty()) {
    return start;
  }
  std::vector<std::vector<double>> joints = start.joints;
  for (const std::string& text : texts) {
    std::size_t begin = 0;
    while (begin <= text.size()) {
      const std::size_t end = std::min(text.find(',', begin), text.size());
      TENON_TRY(const Wish wish, read_wish(text.substr(begin, end - begin)));
      TENON_CHECK(move(multibody, wish, joints));
      begin = end + 1;
    }
  }
  return multibody.moved(start, std::move(joints));
}

void start_from(scene::PhysicsScene& scene, const Multibody& multibody, const Posture& posture) {
  for (Index b = 0; b < scene.bodies.size(); ++b) {
    scene.bodies[b].pose = posture.bodies[b];
  }
  for (Index j = 0; j < scene.joints.size(); ++j) {
    scene::Joint& joint = scene.joints[j];
    const bool is_single = multibody.dofs()[j].count() == 1;
    // Beyond half a turn the poses do not tell which turn it is.
    if (is_single && (joint.initial_position || std::abs(posture.joints[j][0]) > M_PI)) {
      joint.initial_position = posture.joints[j][0];
    }
  }
}

void start_inside_limits(scene::PhysicsScene& scene) {
  const Multibody multibody(scene);
  const Posture inside = start_inside_limits(multibody);
  if (inside.joints != multibody.start().joints) {
    start_from(scene, multibody, inside);
  }
}

Result<void> start_at(scene::PhysicsScene& scene, const std::vector<std::string>& texts) {
  if (!texts.empty()) {
    const Multibody multibody(scene);
    TENON_TRY(const Posture posture, posture_from_texts(multibody, texts));
    start_from(scene, multibody, posture);
  }
  return {};
}

}  // namespace tenon::dynamics
