// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// MjcTendon: mjc:path names what the tendon meets, each prim once; mjc:path:indices says which of
// them comes where. A fixed tendon has a coefficient for each joint. A spatial one has a segment
// for each place, segments a divisor each: between two of them is a pulley. Shapes that it goes
// around may have a site at their side.
#include <algorithm>
#include <cmath>

#include "tenon/physics/joints/joint_frames.h"
#include "tenon/physics/read_state.h"
#include "tenon/physics/vendors/mujoco_settings.h"
#include "tenon/physics/world_pose.h"

namespace tenon::physics {
namespace {

struct TendonTokens {
  Token type{"mjc:type"};
  Token path{"mjc:path"};
  Token coefficients{"mjc:path:coef"};
  Token divisors{"mjc:path:divisors"};
  Token indices{"mjc:path:indices"};
  Token segments{"mjc:path:segments"};
  Token side_sites{"mjc:sideSites"};
  Token side_indices{"mjc:sideSites:indices"};
  Token stiffness{"mjc:stiffness"};
  Token damping{"mjc:damping"};
  Token friction{"mjc:frictionloss"};
  Token armature{"mjc:armature"};
  Token spring_length{"mjc:springlength"};
  Token limited{"mjc:limited"};
  Token range_min{"mjc:range:min"};
  Token range_max{"mjc:range:max"};
};

/// Settings that are passed on as they are.
constexpr const char* kTendonSettings[] = {"mjc:actuatorfrclimited",
                                           "mjc:actuatorfrcrange:max",
                                           "mjc:actuatorfrcrange:min",
                                           "mjc:group",
                                           "mjc:margin",
                                           "mjc:rgba",
                                           "mjc:solimpfriction",
                                           "mjc:solimplimit",
                                           "mjc:solreffriction",
                                           "mjc:solreflimit",
                                           "mjc:width"};

/// The turn from Z to another axis.
Quatd turn_from_z(Token axis) {
  const double half = std::sqrt(0.5);
  if (axis == "X") {
    return {half, 0, half, 0};
  }
  return axis == "Y" ? Quatd{half, -half, 0, 0} : kIdentityRotation;
}

class TendonReader {
 public:
  TendonReader(ReadState& state, const PhysicsPrim& found) : state_(state), found_(found) {}

  void run() {
    tendon_.path = found_.path;
    const Token type = found_.prim.attribute(tokens_.type).get().get_or<Token>(Token("spatial"));
    if (!read_order() || !(type == "fixed" ? read_joints() : read_stops())) {
      return;
    }
    read_numbers();
    state_.scene.tendons.push_back(std::move(tendon_));
  }

 private:
  bool refuse(Token property, std::string why) {
    state_.not_read(found_.prim, property.str(), std::move(why) + "; the tendon is skipped");
    return false;
  }

  std::vector<int> whole(Token name) const {
    std::vector<int> result;
    for (const double number : numbers_of(found_.prim, name)) {
      const bool in_range = std::fabs(number) < 1e9;
      result.push_back(in_range ? static_cast<int>(number) : -1);
    }
    return result;
  }

  /// The targets in the order of the path.
  bool read_order() {
    const std::vector<Path> targets = state_.targets(found_.prim, tokens_.path);
    std::vector<int> indices = whole(tokens_.indices);
    for (std::size_t i = 0; indices.empty() && i < targets.size(); ++i) {
      order_.push_back(targets[i]);
    }
    for (const int index : indices) {
      if (index < 0 || static_cast<std::size_t>(index) >= targets.size()) {
        return refuse(tokens_.indices, "a number is that of no target of mjc:path");
      }
      order_.push_back(targets[static_cast<std::size_t>(index)]);
    }
    return !order_.empty() || refuse(tokens_.path, "it names nothing");
  }

  bool read_joints() {
    tendon_.coefficients = numbers_of(found_.prim, tokens_.coefficients);
    if (tendon_.coefficients.empty()) {
      tendon_.coefficients.assign(order_.size(), 1);
    }
    if (tendon_.coefficients.size() != order_.size()) {
      return refuse(tokens_.coefficients, "there is not one coefficient for each joint");
    }
    for (const Path& target : order_) {
      const std::uint32_t joint = state_.joint_at(state_.walk.near(found_, target));
      if (joint == kNone || !(state_.scene.joints[joint].kind == JointKind::Revolute ||
                              state_.scene.joints[joint].kind == JointKind::Prismatic)) {
        return refuse(tokens_.path, "<" + target.str() + "> is not a joint of one axis");
      }
      turns_ = turns_ && state_.scene.joints[joint].kind == JointKind::Revolute;
      tendon_.joints.push_back(joint);
    }
    return true;
  }

  /// A prim that is there, in the body that carries it; nullopt for others.
  std::optional<TendonWrap::Attachment> attachment_of(Path target, Mat4d& world) const {
    const stage::Prim prim = state_.stage.prim(target);
    if (!prim.is_valid() || !prim.is_active() || !prim.is_defined()) {
      return std::nullopt;
    }
    const Attachment attached = find_attachment(state_, found_, prim);
    world = attached.world;
    const Pose pose = world_pose(world, state_.units);
    TendonWrap::Attachment attachment{state_.walk.near(found_, target), attached.body, pose};
    if (attached.body) {
      attachment.pose = inverse(state_.scene.bodies[*attached.body].pose) * pose;
    }
    return is_finite(attachment.pose) ? std::optional(attachment) : std::nullopt;
  }

  bool read_side(std::size_t at, TendonWrap& wrap) {
    if (at >= side_indices_.size() || side_indices_[at] < 0) {
      return true;
    }
    Mat4d world;
    const auto index = static_cast<std::size_t>(side_indices_[at]);
    if (index < side_sites_.size()) {
      wrap.side = attachment_of(side_sites_[index], world);
    }
    return wrap.side.has_value() || refuse(tokens_.side_sites, "a site at a side is not there");
  }

  /// The radius of a sphere, or of a cylinder about its own axis, which becomes Z.
  bool read_round(const stage::Prim& prim, const Mat4d& world, TendonWrap& wrap) {
    std::size_t across = 0;
    if (prim.is_a("Sphere")) {
      wrap.kind = TendonWrap::Kind::Sphere;
    } else if (prim.is_a("Cylinder")) {
      wrap.kind = TendonWrap::Kind::Cylinder;
      const Token axis = prim.attribute("axis").get_as<Token>().value_or(Token("Z"));
      across = axis == "X" ? 1 : 0;
      wrap.attachment.pose = wrap.attachment.pose * Pose{{}, turn_from_z(axis)};
    } else {
      return false;
    }
    const Vec3d row{{world[across][0], world[across][1], world[across][2]}};
    wrap.radius =
        prim.attribute("radius").get_as<double>().value_or(0) * length(row) * state_.units.length;
    return std::isfinite(wrap.radius) && wrap.radius > 0;
  }

  bool read_wrap(std::size_t at) {
    const stage::Prim prim = state_.stage.prim(order_[at]);
    TendonWrap wrap;
    Mat4d world;
    const std::optional<TendonWrap::Attachment> attachment = attachment_of(order_[at], world);
    if (!attachment) {
      return refuse(tokens_.path, "<" + order_[at].str() + "> is not there");
    }
    wrap.attachment = *attachment;
    const bool site = prim.has_api("MjcSiteAPI") || prim.has_api("IsaacSiteAPI");
    if (!site && prim.is_a("Gprim")) {
      if (!read_round(prim, world, wrap)) {
        return refuse(tokens_.path,
                      "<" + order_[at].str() + "> is neither a sphere nor a cylinder");
      }
      if (!read_side(at, wrap)) {
        return false;
      }
    }
    tendon_.wraps.push_back(wrap);
    return true;
  }

  bool read_stops() {
    side_indices_ = whole(tokens_.side_indices);
    side_sites_ = state_.targets(found_.prim, tokens_.side_sites);
    const std::vector<int> segments = whole(tokens_.segments);
    const std::vector<double> divisors = numbers_of(found_.prim, tokens_.divisors);
    if (!segments.empty() && segments.size() != order_.size()) {
      return refuse(tokens_.segments, "there is not one segment for each place");
    }
    for (std::size_t i = 0; i < order_.size(); ++i) {
      if (i > 0 && !segments.empty() && segments[i] != segments[i - 1]) {
        const auto segment = static_cast<std::size_t>(std::max(0, segments[i]));
        if (segment >= divisors.size() || !(divisors[segment] > 0)) {
          return refuse(tokens_.divisors, "there is not one divisor above 0 for each segment");
        }
        TendonWrap pulley;
        pulley.kind = TendonWrap::Kind::Pulley;
        pulley.divisor = divisors[segment];
        tendon_.wraps.push_back(pulley);
      }
      if (!read_wrap(i)) {
        return false;
      }
    }
    turns_ = false;
    return true;
  }

  double number(Token name) const {
    return state_.values.authored_number(found_.prim, name).value_or(0);
  }

  void read_numbers() {
    const double length = turns_ ? 1 : state_.units.length;
    const double force = turns_ ? state_.units.torque() : state_.units.force();
    tendon_.stiffness = number(tokens_.stiffness) * force / length;
    tendon_.damping = number(tokens_.damping) * force / length;
    tendon_.friction = number(tokens_.friction) * force;
    tendon_.armature = number(tokens_.armature) * force / length;
    const std::vector<double> rest = numbers_of(found_.prim, tokens_.spring_length);
    for (std::size_t i = 0; i < 2 && !rest.empty(); ++i) {
      const double value = rest[std::min(i, rest.size() - 1)];
      tendon_.spring_length[i] = value < 0 && !turns_ ? value : value * length;
    }
    const Token limited = found_.prim.attribute(tokens_.limited).get().get_or<Token>(Token("auto"));
    const std::array<double, 2> range{number(tokens_.range_min) * length,
                                      number(tokens_.range_max) * length};
    if (limited == "true" || (limited == "auto" && range[0] < range[1])) {
      tendon_.range = range;
    }
    for (const char* name : kTendonSettings) {
      if (!found_.prim.attribute(Token(name)).get().empty() &&
          found_.prim.attribute(Token(name)).has_authored_value()) {
        if (auto setting = read_mujoco_setting(found_.prim, Token(name))) {
          tendon_.settings.push_back(*std::move(setting));
        }
      }
    }
    std::sort(tendon_.settings.begin(), tendon_.settings.end(),
              [](const VendorSetting& a, const VendorSetting& b) { return a.name < b.name; });
  }

  ReadState& state_;
  const PhysicsPrim& found_;
  TendonTokens tokens_;
  Tendon tendon_;
  std::vector<Path> order_;
  std::vector<int> side_indices_;
  std::vector<Path> side_sites_;
  bool turns_ = true;  // all joints of a fixed tendon are revolute
};

}  // namespace

void read_tendons(ReadState& state) {
  const auto prims = sorted_prims(
      state.walk, [](const PhysicsPrim& p) { return p.roles.kind == PrimKind::Tendon; });
  for (const std::uint32_t i : prims) {
    TendonReader(state, state.walk.prims[i]).run();
  }
}

}  // namespace tenon::physics
