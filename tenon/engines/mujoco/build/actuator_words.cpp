// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/engines/mujoco/build/actuator_words.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>

namespace tenon::engines::mujoco {
namespace {

using Range = std::array<double, 2>;

struct Word {
  std::string_view token;
  int value;
};
constexpr Word kGains[] = {{"fixed", mjGAIN_FIXED},
                           {"affine", mjGAIN_AFFINE},
                           {"muscle", mjGAIN_MUSCLE},
                           {"user", mjGAIN_USER}};
constexpr Word kBiases[] = {{"none", mjBIAS_NONE},
                            {"affine", mjBIAS_AFFINE},
                            {"muscle", mjBIAS_MUSCLE},
                            {"user", mjBIAS_USER}};
constexpr Word kDynamics[] = {{"none", mjDYN_NONE},     {"integrator", mjDYN_INTEGRATOR},
                              {"filter", mjDYN_FILTER}, {"filterexact", mjDYN_FILTEREXACT},
                              {"muscle", mjDYN_MUSCLE}, {"user", mjDYN_USER}};

template <std::size_t N, class Kind>
bool read_word(const Word (&words)[N], const std::string& token, Kind& kind) {
  const auto* word = std::find_if(std::begin(words), std::end(words),
                                  [&](const Word& w) { return w.token == token; });
  if (word == std::end(words)) {
    return false;
  }
  kind = static_cast<Kind>(word->value);
  return true;
}

void set_range(const std::optional<Range>& range, mjtLimited& limited, double* target) {
  limited = range ? mjLIMITED_TRUE : mjLIMITED_FALSE;
  if (range) {
    std::copy(range->begin(), range->end(), target);
  }
}

}  // namespace

bool set_actuator_kinds(const scene::MujocoActuator& from, mjsActuator& to) {
  return read_word(kGains, from.gain_type, to.gaintype) &&
         read_word(kBiases, from.bias_type, to.biastype) &&
         read_word(kDynamics, from.dyn_type, to.dyntype);
}

void set_actuator_numbers(const scene::MujocoActuator& from, mjsActuator& to) {
  static_assert(mjNGAIN == 10 && mjNBIAS == 10 && mjNDYN == 10);
  std::copy(from.gain.begin(), from.gain.end(), to.gainprm);
  std::copy(from.bias.begin(), from.bias.end(), to.biasprm);
  std::copy(from.dynamics.begin(), from.dynamics.end(), to.dynprm);
  std::copy(from.gear.begin(), from.gear.end(), to.gear);
  set_range(from.control_range, to.ctrllimited, to.ctrlrange);
  set_range(from.force_range, to.forcelimited, to.forcerange);
  set_range(from.activation_range, to.actlimited, to.actrange);
  std::copy(from.length_range.begin(), from.length_range.end(), to.lengthrange);
  to.inheritrange = from.inherit_range;
  to.actdim = from.activation_count;
  to.actearly = from.acts_early;
  to.group = from.group;
  const bool plain = from.gain == std::array<double, 10>{1} && from.gain_type == "fixed" &&
                     from.bias_type == "none" && from.dyn_type == "none";
  to.type = plain ? mjACTUATOR_MOTOR : mjACTUATOR_GENERAL;
}

}  // namespace tenon::engines::mujoco
