// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// An actuator names what it acts on by path, and the lists of the scene tell which kind of object
// that is. A target in none of them is a site, a point of the nearest body at or above it. An
// actuator whose target does not fit is kept with its fault, so that the order of controls holds.
// Gains give a force, or a force per length or velocity, and are scaled from the stage's units as
// such. Controls keep their own measure. One walk in stage order finds actuators, keyframes and
// ranks of bodies, because that is the order in which controls and keyframes list their numbers.
#include "tenon/physics/vendors/read_mujoco_parts.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "tenon/physics/read_state.h"
#include "tenon/physics/vendors/mujoco_settings.h"
#include "tenon/physics/world_pose.h"
#include "tenon/stage/transform_at.h"

namespace tenon::physics {
namespace {

using Target = MujocoActuator::Target;
using Attachment = TendonWrap::Attachment;
using Range = std::array<double, 2>;

constexpr const char* kSensor = "tenon:mujoco:sensor";

/// Numbers that are there, then zeros; `fallback` where there are none.
template <std::size_t N>
std::array<double, N> padded(const stage::Prim& prim, Token name, std::array<double, N> fallback) {
  const std::vector<double> numbers = numbers_of(prim, name);
  if (numbers.empty()) {
    return fallback;
  }
  std::array<double, N> result{};
  std::copy_n(numbers.begin(), std::min(N, numbers.size()), result.begin());
  return result;
}

double number(const stage::Prim& prim, Token name, double fallback) {
  const std::vector<double> numbers = numbers_of(prim, name);
  return numbers.empty() ? fallback : numbers.front();
}

int whole(const stage::Prim& prim, Token name, int fallback) {
  const double found = number(prim, name, fallback);
  return std::fabs(found) < 1e6 ? static_cast<int>(found) : fallback;
}

std::string token(const stage::Prim& prim, Token name, const char* fallback) {
  return prim.attribute(name).get().get_or<Token>(Token(fallback)).str();
}

/// "auto": limited where the range is not empty.
std::optional<Range> range(const stage::Prim& prim, const std::string& name, const char* limited) {
  const Range result{number(prim, Token(name + ":min"), 0), number(prim, Token(name + ":max"), 0)};
  const bool counts = token(prim, Token(limited), "auto") != "false" && result[0] < result[1];
  return counts ? std::optional(result) : std::nullopt;
}

class ActuatorList {
 public:
  ActuatorList(const stage::Stage& stage, const PhysicsScene& scene)
      : stage_(stage), scene_(scene) {
    units_.length = scene.meters_per_unit;
    units_.mass = scene.kilograms_per_unit;
    index(scene.joints, joints_);
    index(scene.tendons, tendons_);
    index(scene.bodies, bodies_);
  }

  MujocoActuator read(const stage::Prim& prim) const {
    MujocoActuator result;
    result.path = prim.path();
    read_target(prim, result);
    result.gain_type = token(prim, "mjc:gainType", "fixed");
    result.bias_type = token(prim, "mjc:biasType", "none");
    result.dyn_type = token(prim, "mjc:dynType", "none");
    result.gain = padded<10>(prim, "mjc:gainPrm", {1});
    result.bias = padded<10>(prim, "mjc:biasPrm", {});
    result.dynamics = padded<10>(prim, "mjc:dynPrm", {1});
    result.gear = padded<6>(prim, "mjc:gear", {1});
    result.control_range = range(prim, "mjc:ctrlRange", "mjc:ctrlLimited");
    result.force_range = range(prim, "mjc:forceRange", "mjc:forceLimited");
    result.activation_range = range(prim, "mjc:actRange", "mjc:actLimited");
    result.length_range = {number(prim, "mjc:lengthRange:min", 0),
                           number(prim, "mjc:lengthRange:max", 0)};
    result.inherit_range = number(prim, "mjc:inheritRange", 0);
    result.crank_length = number(prim, "mjc:crankLength", 0) * units_.length;
    result.in_parent = number(prim, "mjc:jointInParent", 0) != 0;
    result.acts_early = number(prim, "mjc:actEarly", 0) != 0;
    result.activation_count = whole(prim, "mjc:actDim", -1);
    result.group = whole(prim, "mjc:group", 0);
    to_si(result);
    return result;
  }

  std::optional<Index> body(Path path) const {
    const auto at = bodies_.find(path);
    return at == bodies_.end() ? std::nullopt : std::optional(at->second);
  }

 private:
  using Places = std::unordered_map<Path, Index>;

  template <class T>
  static void index(const std::vector<T>& list, Places& places) {
    for (std::size_t i = 0; i < list.size(); ++i) {
      places.emplace(list[i].path, static_cast<Index>(i));
    }
  }

  void read_target(const stage::Prim& prim, MujocoActuator& result) const {
    const std::vector<Path> targets = prim.relationship("mjc:target").targets();
    if (targets.size() != 1) {
      result.fault = targets.empty() ? "it names nothing" : "it names several prims";
      return;
    }
    const auto found = [&](const Places& places, Target kind) {
      const auto at = places.find(targets.front());
      if (at != places.end()) {
        result.kind = kind;
        result.target = at->second;
      }
      return at != places.end();
    };
    if (found(joints_, Target::Joint)) {
      check_joint(result);
    } else if (body(targets.front())) {
      result.fault = "<" + targets.front().str() + "> is a body";
    } else if (!found(tendons_, Target::Tendon)) {
      read_sites(prim, targets.front(), result);
    }
  }

  void check_joint(MujocoActuator& result) const {
    const Joint& joint = scene_.joints[result.target];
    const bool one_axis = joint.kind == JointKind::Revolute || joint.kind == JointKind::Prismatic;
    if (!one_axis && joint.kind != JointKind::Spherical) {
      result.kind = Target::None;
      result.fault = "<" + joint.path.str() + "> is neither a joint of one axis nor a ball";
      return;
    }
    for (Index i = 0; i < joint.drives.size(); ++i) {
      if (joint.drives[i].source == result.path) {
        result.drive = i;
      }
    }
  }

  void read_sites(const stage::Prim& prim, Path target, MujocoActuator& result) const {
    const std::optional<Attachment> site = attachment_of(target);
    if (!site) {
      result.fault = "<" + target.str() + "> is not a joint, tendon or site that is there";
      return;
    }
    result.kind = Target::Site;
    result.site = *site;
    for (const auto& [name, kind] : {std::pair(Token("mjc:refSite"), Target::Site),
                                     {Token("mjc:sliderSite"), Target::Crank}}) {
      const std::vector<Path> others = prim.relationship(name).targets();
      if (others.empty()) {
        continue;
      }
      result.kind = kind;
      result.other_site = attachment_of(others.front());
      if (others.size() != 1 || !result.other_site) {
        result.kind = Target::None;
        result.fault = name.str() + " names no site that is there";
        return;
      }
    }
  }

  /// A point of the nearest body at or above it, or of the world.
  std::optional<Attachment> attachment_of(Path target) const {
    const stage::Prim prim = stage_.prim(target);
    if (!prim.is_valid() || !prim.is_active() || !prim.is_defined() || !prim.is_a("Xformable")) {
      return std::nullopt;
    }
    const Pose world =
        world_pose(stage::local_to_world(prim, stage::Time(scene_.start_time_code)), units_);
    Attachment attachment{target, std::nullopt, world};
    for (stage::Prim above = prim; above.is_valid() && !above.is_pseudo_root();
         above = above.parent()) {
      const auto body = bodies_.find(above.path());
      if (body != bodies_.end()) {
        attachment.body = body->second;
        attachment.pose = inverse(scene_.bodies[body->second].pose) * world;
        break;
      }
    }
    return is_finite(attachment.pose) ? std::optional(attachment) : std::nullopt;
  }

  bool turns(const MujocoActuator& actuator) const {
    if (actuator.kind == Target::Joint) {
      return scene_.joints[actuator.target].kind != JointKind::Prismatic;
    }
    if (actuator.kind != Target::Tendon) {
      return false;
    }
    const std::vector<Index>& joints = scene_.tendons[actuator.target].joints;
    return !joints.empty() && std::all_of(joints.begin(), joints.end(), [&](Index joint) {
      return scene_.joints[joint].kind == JointKind::Revolute;
    });
  }

  /// Forces and what goes with a length or its velocity, from the stage's units.
  void to_si(MujocoActuator& actuator) const {
    const bool angular = turns(actuator);
    const double force = angular ? units_.torque() : units_.force();
    const double length = angular ? 1 : units_.length;
    const auto scale = [&](const std::string& type, std::array<double, 10>& numbers) {
      if (type == "muscle") {
        numbers[2] *= force;
      } else if (type != "user") {
        numbers[0] *= force;
        numbers[1] *= force / length;
        numbers[2] *= force / length;
      }
    };
    scale(actuator.gain_type, actuator.gain);
    scale(actuator.bias_type, actuator.bias);
    for (double& end : actuator.length_range) {
      end *= length;
    }
    if (actuator.force_range) {
      (*actuator.force_range)[0] *= force;
      (*actuator.force_range)[1] *= force;
    }
  }

  const stage::Stage& stage_;
  const PhysicsScene& scene_;
  Units units_;
  Places joints_;
  Places tendons_;
  Places bodies_;
};

/// Numbers of MuJoCo's own: nothing of the stage's units is known of them yet.
MujocoKeyframe read_keyframe(const stage::Prim& prim) {
  MujocoKeyframe result;
  result.path = prim.path();
  result.positions = numbers_of(prim, "mjc:qpos");
  result.velocities = numbers_of(prim, "mjc:qvel");
  result.activations = numbers_of(prim, "mjc:act");
  result.controls = numbers_of(prim, "mjc:ctrl");
  result.mocap_positions = numbers_of(prim, "mjc:mpos");
  result.mocap_rotations = numbers_of(prim, "mjc:mquat");
  return result;
}

MujocoSensor::Thing read_thing(const stage::Prim& prim, const std::string& role) {
  const std::string name = std::string(kSensor) + ":" + role;
  const std::vector<Path> targets = prim.relationship(Token(name)).targets();
  return {token(prim, Token(name + "Type"), ""), targets.empty() ? Path() : targets.front()};
}

MujocoSensor read_sensor(const stage::Prim& prim) {
  MujocoSensor result;
  result.path = prim.path();
  result.kind = token(prim, Token(kSensor), "");
  result.object = read_thing(prim, "object");
  result.reference = read_thing(prim, "reference");
  const std::string start = std::string(kSensor) + ":";
  for (const Token name : prim.authored_property_names()) {
    if (name.view() == start + "instrument") {
      const std::vector<Path> targets = prim.relationship(name).targets();
      result.instrument = targets.empty() ? Path() : targets.front();
    } else if (name.view().starts_with(start)) {
      if (std::vector<double> numbers = numbers_of(prim, name); !numbers.empty()) {
        result.settings.push_back({name.str().substr(start.size()), std::move(numbers), ""});
      }
    }
  }
  return result;
}

}  // namespace

void read_mujoco_actuators(ReadState& state) {
  const auto prims = sorted_prims(
      state.walk, [](const PhysicsPrim& p) { return p.roles.kind == PrimKind::Actuator; });
  if (prims.empty()) {
    return;
  }
  const ActuatorList list(state.stage, state.scene);
  for (const std::uint32_t i : prims) {
    MujocoActuator actuator = list.read(state.walk.prims[i].prim);
    if (actuator.kind == Target::None) {
      state.not_read(state.walk.prims[i].prim, "mjc:target", actuator.fault);
    } else if (!actuator.drive) {
      state.scene.actuators.push_back(std::move(actuator));
    }
  }
}

MujocoParts read_mujoco_parts(const stage::Stage& stage, const PhysicsScene& scene) {
  const ActuatorList list(stage, scene);
  MujocoParts result;
  result.body_ranks.assign(scene.bodies.size(), static_cast<Index>(scene.bodies.size()));
  Index rank = 0;
  std::vector<stage::Prim> open{stage.pseudo_root()};  // the last one is next
  while (!open.empty()) {
    const stage::Prim prim = open.back();
    open.pop_back();
    if (!prim.is_pseudo_root() &&
        (!prim.is_active() || !prim.is_loaded() || !prim.is_defined() || prim.is_abstract())) {
      continue;
    }
    if (prim.type_name() == "MjcActuator") {
      result.actuators.push_back(list.read(prim));
    } else if (prim.type_name() == "MjcKeyframe") {
      result.keyframes.push_back(read_keyframe(prim));
    } else if (prim.type_name() == "TenonMujocoSensor") {
      result.sensors.push_back(read_sensor(prim));
    } else if (const std::optional<Index> body = list.body(prim.path())) {
      result.body_ranks[*body] = rank++;
    }
    const std::vector<stage::Prim> children = prim.children();
    open.insert(open.end(), children.rbegin(), children.rend());
  }
  return result;
}

}  // namespace tenon::physics
