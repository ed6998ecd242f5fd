// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>

#include "tenon/mjcf/contact_defaults.h"
#include "tenon/mjcf/mjcf_reader.h"

namespace tenon::mjcf {

using robot::Index;
using robot::MujocoTendonStop;

namespace {

// MuJoCo's defaults.
constexpr double kWidth = 0.003;
constexpr std::array<float, 4> kColor{0.5f, 0.5f, 0.5f, 1};

bool goes_around(int wrap) { return wrap == mjWRAP_SPHERE || wrap == mjWRAP_CYLINDER; }

}  // namespace

/// Geoms that tendons go around need names to be found by.
void MjcfReader::find_wrapped_geoms() {
  wrapped_.assign(static_cast<std::size_t>(model_.ngeom), 0);
  for (int wrap = 0; wrap < model_.nwrap; ++wrap) {
    if (goes_around(model_.wrap_type[wrap])) {
      wrapped_[static_cast<std::size_t>(model_.wrap_objid[wrap])] = 1;
    }
  }
}

/// A joint with its coefficient; the sum counts from where the model stands.
void MjcfReader::add_term(int wrap, robot::MujocoTendon& tendon, double& start) const {
  const auto joint = static_cast<std::size_t>(model_.wrap_objid[wrap]);
  const double coefficient = model_.wrap_prm[wrap];
  tendon.joints.push_back(joint_of_joint_[joint]);
  tendon.coefficients.push_back(coefficient);
  start += coefficient * model_.qpos0[model_.jnt_qposadr[joint]];
}

bool MjcfReader::add_stop(int wrap, bool first, robot::MujocoTendon& tendon) {
  const int object = model_.wrap_objid[wrap];
  MujocoTendonStop stop;
  switch (model_.wrap_type[wrap]) {
    case mjWRAP_SITE:
      stop.name = unique_name(mjOBJ_SITE, object, "site");
      break;
    case mjWRAP_SPHERE:
    case mjWRAP_CYLINDER: {
      const bool collides =
          model_.geom_contype[object] != 0 || model_.geom_conaffinity[object] != 0;
      stop.kind = MujocoTendonStop::Kind::Shape;
      stop.name = unique_name(mjOBJ_GEOM, object, "geom") + (collides ? "_collider" : "");
      const int side = static_cast<int>(model_.wrap_prm[wrap]);
      if (side >= 0) {
        stop.side_site = unique_name(mjOBJ_SITE, side, "site");
      }
      break;
    }
    case mjWRAP_PULLEY:
      if (first) {
        return false;  // the schema has divisors between places only
      }
      stop.kind = MujocoTendonStop::Kind::Pulley;
      stop.divisor = model_.wrap_prm[wrap];
      break;
    default:
      return false;
  }
  tendon.stops.push_back(std::move(stop));
  return true;
}

/// What is not MuJoCo's default.
void MjcfReader::read_tendon_settings(int number, robot::MujocoTendon& tendon) const {
  const auto at = static_cast<std::size_t>(number);
  const auto add = [&](const char* name, std::vector<double> numbers) {
    tendon.settings.push_back({name, std::move(numbers), ""});
  };
  if (model_.tendon_actfrclimited[at] != 0) {
    tendon.settings.push_back({"actuatorfrclimited", {}, "true"});
    add("actuatorfrcrange:max", {model_.tendon_actfrcrange[2 * at + 1]});
    add("actuatorfrcrange:min", {model_.tendon_actfrcrange[2 * at]});
  }
  if (model_.tendon_group[at] != 0) {
    add("group", {static_cast<double>(model_.tendon_group[at])});
  }
  if (model_.tendon_margin[at] != 0) {
    add("margin", {model_.tendon_margin[at]});
  }
  const float* color = model_.tendon_rgba + 4 * at;
  if (!std::equal(kColor.begin(), kColor.end(), color)) {
    add("rgba", {color, color + 4});
  }
  const auto add_row = [&](const char* name, const mjtNum* table, const auto& usual) {
    const mjtNum* row = table + usual.size() * at;
    if (!std::equal(usual.begin(), usual.end(), row)) {
      add(name, {row, row + usual.size()});
    }
  };
  add_row("solimpfriction", model_.tendon_solimp_fri, kSolimp);
  add_row("solimplimit", model_.tendon_solimp_lim, kSolimp);
  add_row("solreffriction", model_.tendon_solref_fri, kSolref);
  add_row("solreflimit", model_.tendon_solref_lim, kSolref);
  if (model_.tendon_width[at] != kWidth) {
    add("width", {model_.tendon_width[at]});
  }
}

/// False for a tendon that the schema cannot say.
bool MjcfReader::read_tendon(int number) {
  const auto at = static_cast<std::size_t>(number);
  robot::MujocoTendon tendon;
  tendon.name = unique_name(mjOBJ_TENDON, number, "tendon");
  double start = 0;
  for (int i = 0; i < model_.tendon_num[at]; ++i) {
    const int wrap = model_.tendon_adr[at] + i;
    if (model_.wrap_type[wrap] == mjWRAP_JOINT) {
      add_term(wrap, tendon, start);
    } else if (!add_stop(wrap, i == 0, tendon)) {
      return false;
    }
  }
  tendon.stiffness = model_.tendon_stiffness[at];
  tendon.damping = model_.tendon_damping[at];
  tendon.friction = model_.tendon_frictionloss[at];
  tendon.armature = model_.tendon_armature[at];
  for (std::size_t i = 0; i < 2; ++i) {
    tendon.spring_length[i] = model_.tendon_lengthspring[2 * at + i] - start;
  }
  if (model_.tendon_limited[at] != 0) {
    tendon.range = {model_.tendon_range[2 * at] - start, model_.tendon_range[2 * at + 1] - start};
  }
  read_tendon_settings(number, tendon);
  robot_.mujoco.tendons.push_back(std::move(tendon));
  return true;
}

void MjcfReader::read_tendons() {
  tendon_of_tendon_.resize(static_cast<std::size_t>(model_.ntendon));
  for (int i = 0; i < model_.ntendon; ++i) {
    const auto index = static_cast<Index>(robot_.mujoco.tendons.size());
    if (read_tendon(i)) {
      tendon_of_tendon_[static_cast<std::size_t>(i)] = index;
    } else {
      report("mjcf.left-out",
             "the tendon \"" + unique_name(mjOBJ_TENDON, i, "tendon") +
                 "\" starts with a pulley; it is left out",
             Severity::Warning, line_of(mjOBJ_TENDON, i));
    }
  }
}

}  // namespace tenon::mjcf
