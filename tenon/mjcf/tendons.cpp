// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// MuJoCo keeps the paths of all tendons in one table, a row for each thing that a path meets:
// joints with coefficients (a fixed tendon), or sites, geoms to go around and pulleys (a spatial
// one). The length of a fixed tendon is a sum of coordinates, which in a robot count from where the
// model stands: lengths are moved by what the sum is there. A path in space stays as it is.
#include "tenon/mjcf/tendons.h"

#include <algorithm>
#include <array>

#include "tenon/engines/mujoco/soft_defaults.h"

namespace tenon::mjcf {

using engines::mujoco::kSolimp;
using engines::mujoco::kSolref;
using robot::Index;
using robot::MujocoTendonWrap;

namespace {

// MuJoCo's defaults.
constexpr double kWidth = 0.003;
constexpr std::array<float, 4> kColor{0.5f, 0.5f, 0.5f, 1};

bool goes_around(int wrap) { return wrap == mjWRAP_SPHERE || wrap == mjWRAP_CYLINDER; }

/// A joint with its coefficient. Returns its share of the length where the model stands.
double add_term(const mjModel& model, const BodyTree& tree, int wrap, robot::MujocoTendon& tendon) {
  const auto joint = static_cast<std::size_t>(model.wrap_objid[wrap]);
  const double coefficient = model.wrap_prm[wrap];
  tendon.joints.push_back(tree.joint_of_joint[joint]);
  tendon.coefficients.push_back(coefficient);
  return coefficient * model.qpos0[model.jnt_qposadr[joint]];
}

/// None for what the schema cannot say.
std::optional<MujocoTendonWrap> read_wrap(const MjcfSource& source, int number, bool first) {
  const mjModel& model = source.model();
  const int object = model.wrap_objid[number];
  MujocoTendonWrap wrap;
  switch (model.wrap_type[number]) {
    case mjWRAP_SITE:
      wrap.name = source.name(mjOBJ_SITE, object, "site");
      break;
    case mjWRAP_SPHERE:
    case mjWRAP_CYLINDER: {
      const bool collides = model.geom_contype[object] != 0 || model.geom_conaffinity[object] != 0;
      wrap.kind = MujocoTendonWrap::Kind::Shape;
      wrap.name = source.name(mjOBJ_GEOM, object, "geom") + (collides ? "_collider" : "");
      const int side = static_cast<int>(model.wrap_prm[number]);
      if (side >= 0) {
        wrap.side_site = source.name(mjOBJ_SITE, side, "site");
      }
      break;
    }
    case mjWRAP_PULLEY:
      if (first) {
        return std::nullopt;  // the schema has divisors between places only
      }
      wrap.kind = MujocoTendonWrap::Kind::Pulley;
      wrap.divisor = model.wrap_prm[number];
      break;
    default:
      return std::nullopt;
  }
  return wrap;
}

/// What is not MuJoCo's default.
std::vector<robot::MujocoSetting> tendon_settings(const mjModel& model, int number) {
  std::vector<robot::MujocoSetting> settings;
  const auto at = static_cast<std::size_t>(number);
  const auto add = [&](const char* name, std::vector<double> numbers) {
    settings.push_back({name, std::move(numbers), ""});
  };
  if (model.tendon_actfrclimited[at] != 0) {
    settings.push_back({"actuatorfrclimited", {}, "true"});
    add("actuatorfrcrange:max", {model.tendon_actfrcrange[2 * at + 1]});
    add("actuatorfrcrange:min", {model.tendon_actfrcrange[2 * at]});
  }
  if (model.tendon_group[at] != 0) {
    add("group", {static_cast<double>(model.tendon_group[at])});
  }
  if (model.tendon_margin[at] != 0) {
    add("margin", {model.tendon_margin[at]});
  }
  const float* color = model.tendon_rgba + 4 * at;
  if (!std::equal(kColor.begin(), kColor.end(), color)) {
    add("rgba", {color, color + 4});
  }
  const auto add_row = [&](const char* name, const mjtNum* table, const auto& usual) {
    const mjtNum* row = table + usual.size() * at;
    if (!std::equal(usual.begin(), usual.end(), row)) {
      add(name, {row, row + usual.size()});
    }
  };
  add_row("solimpfriction", model.tendon_solimp_fri, kSolimp);
  add_row("solimplimit", model.tendon_solimp_lim, kSolimp);
  add_row("solreffriction", model.tendon_solref_fri, kSolref);
  add_row("solreflimit", model.tendon_solref_lim, kSolref);
  if (model.tendon_width[at] != kWidth) {
    add("width", {model.tendon_width[at]});
  }
  return settings;
}

/// None for a tendon that the schema cannot say.
std::optional<robot::MujocoTendon> read_tendon(const MjcfSource& source, const BodyTree& tree,
                                               int number) {
  const mjModel& model = source.model();
  const auto at = static_cast<std::size_t>(number);
  robot::MujocoTendon tendon;
  tendon.name = source.name(mjOBJ_TENDON, number, "tendon");
  double start = 0;
  for (int i = 0; i < model.tendon_num[at]; ++i) {
    const int at_wrap = model.tendon_adr[at] + i;
    if (model.wrap_type[at_wrap] == mjWRAP_JOINT) {
      start += add_term(model, tree, at_wrap, tendon);
    } else if (std::optional<MujocoTendonWrap> wrap = read_wrap(source, at_wrap, i == 0)) {
      tendon.wraps.push_back(std::move(*wrap));
    } else {
      return std::nullopt;
    }
  }
  tendon.stiffness = model.tendon_stiffness[at];
  tendon.damping = model.tendon_damping[at];
  tendon.friction = model.tendon_frictionloss[at];
  tendon.armature = model.tendon_armature[at];
  for (std::size_t i = 0; i < 2; ++i) {
    tendon.spring_length[i] = model.tendon_lengthspring[2 * at + i] - start;
  }
  if (model.tendon_limited[at] != 0) {
    tendon.range = {model.tendon_range[2 * at] - start, model.tendon_range[2 * at + 1] - start};
  }
  tendon.settings = tendon_settings(model, number);
  return tendon;
}

}  // namespace

std::vector<char> wrapped_geoms(const mjModel& model) {
  std::vector<char> wrapped(static_cast<std::size_t>(model.ngeom), 0);
  for (int wrap = 0; wrap < model.nwrap; ++wrap) {
    if (goes_around(model.wrap_type[wrap])) {
      wrapped[static_cast<std::size_t>(model.wrap_objid[wrap])] = 1;
    }
  }
  return wrapped;
}

Tendons read_tendons(MjcfSource& source, const BodyTree& tree) {
  Tendons found;
  for (int i = 0; i < source.model().ntendon; ++i) {
    std::optional<Index>& index = found.of_number.emplace_back();
    if (std::optional<robot::MujocoTendon> tendon = read_tendon(source, tree, i)) {
      index = static_cast<Index>(found.tendons.size());
      found.tendons.push_back(std::move(*tendon));
    } else {
      source.left_out("the tendon \"" + source.name(mjOBJ_TENDON, i, "tendon") +
                          "\" starts with a pulley; it is skipped",
                      source.line_of(mjOBJ_TENDON, i));
    }
  }
  return found;
}

}  // namespace tenon::mjcf
