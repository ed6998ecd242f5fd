// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Tendons of PhysX's schemas. A fixed one is a root and axes: instances of one name on joints of an
// articulation, whose length is the sum of gearing and coordinate, in degrees where the joints
// turn. Each leaf of a spatial one is a tendon of its own: the distances from attachment to
// attachment up to the root, each times the gearing of its lower end, of which the first is drawn
// out of the sum because a path cannot begin with a pulley. The spring pulls to the rest length,
// beyond the limits a second one acts; the offset is added to the length.
#include <algorithm>
#include <cmath>
#include <string>

#include "tenon/physics/read_state.h"
#include "tenon/physics/world_pose.h"

namespace tenon::physics {
namespace {

constexpr std::size_t kMostAttachments = 256;  // on the way from a leaf to its root

/// Numbers of a tendon in the measure of its schema: lengths with what is added to them.
struct TendonNumbers {
  double stiffness = 0;
  double damping = 0;
  double limit_stiffness = 0;
  double offset = 0;
  double rest = 0;
  double lower = -kUnlimited;
  double upper = kUnlimited;
};

class PhysxTendons {
 public:
  explicit PhysxTendons(ReadState& state) : state_(state) {}

  void run() {
    for (std::uint32_t i = 0; i < state_.walk.prims.size(); ++i) {
      const Roles& roles = state_.walk.prims[i].roles;
      if (roles.has(Api::PhysxTendonAxisRoot)) {
        for (const Token& name : instances(i, "PhysxTendonAxisRootAPI")) {
          add_fixed(i, name);
        }
      }
      if (roles.has(Api::PhysxTendonLeaf)) {
        for (const Token& name : instances(i, "PhysxTendonAttachmentLeafAPI")) {
          add_spatial(i, name);
        }
      }
    }
    std::stable_sort(state_.scene.tendons.begin(), state_.scene.tendons.end(),
                     [](const Tendon& a, const Tendon& b) { return a.path < b.path; });
  }

 private:
  const PhysicsPrim& prim(std::uint32_t i) const { return state_.walk.prims[i]; }

  std::vector<Token> instances(std::uint32_t i, const char* api) const {
    return prim(i).prim.api_instances(api);
  }
  static std::string prefix(Token name) { return "physxTendon:" + name.str() + ":"; }

  double number(std::uint32_t i, Token name, const char* what, double fallback) const {
    return state_.values.authored_number(prim(i).prim, Token(prefix(name) + what))
        .value_or(fallback);
  }
  bool enabled(std::uint32_t i, Token name) const {
    return state_.values.authored_flag(prim(i).prim, Token(prefix(name) + "tendonEnabled"))
        .value_or(true);
  }
  Path path_of(std::uint32_t i, Token name) const {
    return Path::from(prim(i).path.str() + ".physxTendon:" + name.str());
  }

  TendonNumbers common(std::uint32_t root, Token name) const {
    TendonNumbers numbers;
    numbers.stiffness = number(root, name, "stiffness", 0);
    numbers.damping = number(root, name, "damping", 0);
    numbers.limit_stiffness = number(root, name, "limitStiffness", 0);
    numbers.offset = number(root, name, "offset", 0);
    return numbers;
  }
  void lengths(std::uint32_t at, Token name, TendonNumbers& numbers, double rest) const {
    numbers.rest = number(at, name, "restLength", rest);
    numbers.lower = number(at, name, "lowerLimit", -kUnlimited);
    numbers.upper = number(at, name, "upperLimit", kUnlimited);
  }

  /// Into SI: `length` of one unit of the schema's length, `force` of one of its forces.
  static void take(const TendonNumbers& numbers, double length, double force, Tendon& tendon) {
    tendon.stiffness = std::max(0.0, numbers.stiffness) * force / length;
    tendon.damping = std::max(0.0, numbers.damping) * force / length;
    const double rest = (numbers.rest - numbers.offset) * length;
    if (std::isfinite(rest)) {
      tendon.spring_length = {rest, rest};
    }
    const bool bounded = numbers.lower > -kUnlimited || numbers.upper < kUnlimited;
    if (bounded && numbers.limit_stiffness > 0 && numbers.lower <= numbers.upper) {
      constexpr double kOpen = 1e10;
      tendon.range = {std::max(-kOpen, (numbers.lower - numbers.offset) * length),
                      std::min(kOpen, (numbers.upper - numbers.offset) * length)};
      tendon.limit_stiffness = numbers.limit_stiffness * force / length;
    }
  }

  /// The gearing of a joint that is a coordinate of the tendon.
  std::optional<double> gearing(std::uint32_t i, Token name) const {
    const auto list =
        state_.values.get<layer::Array<float>>(prim(i).prim, Token(prefix(name) + "gearing"));
    return list && !list->empty() ? static_cast<double>((*list)[0]) : 1;
  }

  void check_forces(std::uint32_t i, Token name, double gear) {
    const Token property(prefix(name) + "forceCoefficient");
    const stage::Prim& at = prim(i).prim;
    const auto list = state_.values.get<layer::Array<float>>(at, property);
    if (at.attribute(property).has_authored_value() && list && !list->empty() &&
        static_cast<double>((*list)[0]) != gear) {
      state_.not_read(at, property.str(),
                      "forces act by the gearing, so that the tendon keeps its energy");
    }
  }

  void add_fixed(std::uint32_t root, Token name) {
    if (!enabled(root, name)) {
      return;
    }
    Tendon tendon;
    tendon.path = path_of(root, name);
    bool turns = true;
    bool slides = true;
    for (std::uint32_t i = 0; i < state_.walk.prims.size(); ++i) {
      const bool same = prim(i).articulation_root == prim(root).articulation_root;
      const bool is_axis = prim(i).roles.has(Api::PhysxTendonAxis) && has(i, name);
      if (!same || (i != root && !is_axis)) {
        continue;
      }
      const std::uint32_t joint = state_.joint_of_prim[i];
      const JointKind kind = joint == kNone ? JointKind::Fixed : state_.scene.joints[joint].kind;
      if (kind != JointKind::Revolute && kind != JointKind::Prismatic) {
        state_.not_read(prim(i).prim, prefix(name) + "gearing",
                        "only revolute and prismatic joints are part of a tendon");
        continue;
      }
      const double gear = *gearing(i, name);
      check_forces(i, name, gear);
      turns = turns && kind == JointKind::Revolute;
      slides = slides && kind == JointKind::Prismatic;
      tendon.joints.push_back(joint);
      tendon.coefficients.push_back(gear);
    }
    if (tendon.joints.empty() || (!turns && !slides)) {
      state_.not_read(prim(root).prim, "PhysxTendonAxisRootAPI:" + name.str(),
                      "a tendon over joints that turn and joints that slide has no unit");
      return;
    }
    TendonNumbers numbers = common(root, name);
    lengths(root, name, numbers, 0);
    const Units& units = state_.units;
    take(numbers, turns ? kRadians : units.length, turns ? units.torque() : units.force(), tendon);
    state_.scene.tendons.push_back(std::move(tendon));
  }

  bool has(std::uint32_t i, Token name) const {
    const std::vector<Token> names = instances(i, "PhysxTendonAxisAPI");
    return std::find(names.begin(), names.end(), name) != names.end();
  }

  /// One attachment on the way from a leaf to the root.
  struct Stop {
    std::uint32_t prim = 0;
    Token name;
  };

  std::optional<Stop> parent_of(const Stop& stop) const {
    const stage::Prim& at = prim(stop.prim).prim;
    const std::vector<Path> links =
        at.relationship(Token(prefix(stop.name) + "parentLink")).targets();
    const auto name = state_.values.get<Token>(at, Token(prefix(stop.name) + "parentAttachment"));
    if (links.empty() || !name) {
      return std::nullopt;
    }
    const std::uint32_t found =
        state_.walk.index_of(state_.walk.near(prim(stop.prim), links.front()));
    return found == kNone ? std::nullopt : std::optional(Stop{found, *name});
  }

  bool is_root(const Stop& stop) const {
    const std::vector<Token> names = instances(stop.prim, "PhysxTendonAttachmentRootAPI");
    return std::find(names.begin(), names.end(), stop.name) != names.end();
  }

  std::optional<TendonWrap> wrap_of(const Stop& stop) const {
    const PhysicsPrim& at = prim(stop.prim);
    if (at.body == kNone) {
      return std::nullopt;
    }
    TendonWrap wrap;
    wrap.attachment.path = path_of(stop.prim, stop.name);
    wrap.attachment.body = state_.body_of_prim[at.body];
    const Vec3d local =
        state_.values.vector(at.prim, Token(prefix(stop.name) + "localPos")).value_or(Vec3d{});
    const Mat4d world = at.world;
    wrap.attachment.pose = inverse(state_.scene.bodies[*wrap.attachment.body].pose) *
                           Pose{transform_point(local, world) * state_.units.length};
    return is_finite(wrap.attachment.pose) ? std::optional(wrap) : std::nullopt;
  }

  void leave_out(std::uint32_t leaf, Token name, const char* why) {
    state_.not_read(prim(leaf).prim, "PhysxTendonAttachmentLeafAPI:" + name.str(), why);
  }

  void add_spatial(std::uint32_t leaf, Token name) {
    std::vector<Stop> way{{leaf, name}};
    while (!is_root(way.back())) {
      const std::optional<Stop> next = parent_of(way.back());
      if (!next || way.size() > kMostAttachments) {
        leave_out(leaf, name, "its attachments do not lead to a root");
        return;
      }
      way.push_back(*next);
    }
    std::reverse(way.begin(), way.end());
    if (!enabled(way.front().prim, way.front().name)) {
      return;
    }
    if (way.size() < 2) {
      leave_out(leaf, name, "it is its own root");
      return;
    }
    Tendon tendon;
    tendon.path = path_of(leaf, name);
    double first_gear = 1;
    if (!add_path(way, tendon, first_gear)) {
      leave_out(leaf, name, "an attachment is on no body, or a gearing is not above 0");
      return;
    }
    // The path is measured in units of the first gearing: energies stay what they are.
    TendonNumbers numbers = common(way.front().prim, way.front().name);
    lengths(leaf, name, numbers, -kUnlimited);
    take(numbers, state_.units.length / first_gear, state_.units.force() * first_gear, tendon);
    state_.scene.tendons.push_back(std::move(tendon));
  }

  bool add_path(const std::vector<Stop>& way, Tendon& tendon, double& first_gear) const {
    for (std::size_t i = 0; i < way.size(); ++i) {
      std::optional<TendonWrap> wrap = wrap_of(way[i]);
      const double gear = number(way[i].prim, way[i].name, "gearing", 1);
      if (!wrap || (i > 0 && !(gear > 0 && std::isfinite(gear)))) {
        return false;
      }
      if (i == 1) {
        first_gear = gear;
      } else if (i > 1 && gear != gear_before(way, i)) {
        TendonWrap pulley;
        pulley.kind = TendonWrap::Kind::Pulley;
        pulley.divisor = first_gear / gear;
        const TendonWrap again = tendon.wraps.back();
        tendon.wraps.push_back(pulley);
        tendon.wraps.push_back(again);
      }
      tendon.wraps.push_back(*std::move(wrap));
    }
    return true;
  }

  double gear_before(const std::vector<Stop>& way, std::size_t i) const {
    return number(way[i - 1].prim, way[i - 1].name, "gearing", 1);
  }

  ReadState& state_;
};

}  // namespace

void read_physx_tendons(ReadState& state) { PhysxTendons(state).run(); }

}  // namespace tenon::physics
