// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What MuJoCo's APIs say about contacts and constraints, in its own words: no other engine has
// them.
#include "tenon/physics/vendors/mujoco_contacts.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tenon/base/text/text_number.h"

namespace tenon::physics {
namespace {

constexpr const char* kRule = "mujoco.bad-setting";

void refuse(const ReadState& state, const PhysicsPrim& found, Token name,
            const std::string& found_value, const std::string& wanted) {
  state.report(found.prim, name, Severity::Error, kRule,
               name.str() + " is " + found_value + "; it is treated as unauthored",
               "author " + wanted);
}

/// An authored array of `count` finite doubles; else empty.
std::vector<double> numbers(const ReadState& state, const PhysicsPrim& found, Token name,
                            std::size_t count) {
  if (!found.prim.attribute(name).has_authored_value()) {
    return {};
  }
  const auto read = state.values.get<layer::Array<double>>(found.prim, name);
  if (!read) {
    return {};
  }
  std::vector<double> result(read->begin(), read->end());
  const bool finite =
      std::all_of(result.begin(), result.end(), [](double x) { return std::isfinite(x); });
  if (result.size() != count || !finite) {
    refuse(state, found, name,
           finite ? "an array of " + std::to_string(result.size()) + " numbers" : "not finite",
           std::to_string(count) + " finite numbers");
    return {};
  }
  return result;
}

std::optional<int> whole_number(const ReadState& state, const PhysicsPrim& found, Token name,
                                bool (*is_good)(double), const char* wanted) {
  const std::optional<double> value = state.values.authored_number(found.prim, name);
  if (!value) {
    return std::nullopt;
  }
  if (!is_good(*value)) {
    refuse(state, found, name, shortest(*value), wanted);
    return std::nullopt;
  }
  return static_cast<int>(*value);
}

struct Tokens {
  Token condim{"mjc:condim"};
  Token priority{"mjc:priority"};
  Token solmix{"mjc:solmix"};
  Token solref{"mjc:solref"};
  Token solimp{"mjc:solimp"};
  Token solref_limit{"mjc:solreflimit"};
  Token solimp_limit{"mjc:solimplimit"};
  Token solref_friction{"mjc:solreffriction"};
  Token solimp_friction{"mjc:solimpfriction"};
  Token torque_scale{"mjc:torqueScale"};
};

const Tokens& tokens() {
  static const Tokens instance;
  return instance;
}

constexpr std::size_t kReference = 2;  // numbers of a solref
constexpr std::size_t kImpedance = 5;  // of a solimp

}  // namespace

MujocoContact read_mujoco_contact(const ReadState& state, const PhysicsPrim& found) {
  const Tokens& t = tokens();
  MujocoContact contact;
  contact.condim = whole_number(
      state, found, t.condim, [](double x) { return x == 1 || x == 3 || x == 4 || x == 6; },
      "1, 3, 4 or 6");
  contact.priority = whole_number(
      state, found, t.priority, [](double x) { return std::fabs(x) < 1e6; }, "a small number");
  contact.solmix = state.values.authored_number(found.prim, t.solmix);
  if (contact.solmix && !(*contact.solmix >= 0 && std::isfinite(*contact.solmix))) {
    refuse(state, found, t.solmix, shortest(*contact.solmix), "a number that is not negative");
    contact.solmix.reset();
  }
  contact.solref = numbers(state, found, t.solref, kReference);
  contact.solimp = numbers(state, found, t.solimp, kImpedance);
  return contact;
}

MujocoSoftness read_mujoco_softness(const ReadState& state, const PhysicsPrim& found) {
  const Tokens& t = tokens();
  return {numbers(state, found, t.solref_limit, kReference),
          numbers(state, found, t.solimp_limit, kImpedance),
          numbers(state, found, t.solref_friction, kReference),
          numbers(state, found, t.solimp_friction, kImpedance)};
}

MujocoLoop read_mujoco_loop(const ReadState& state, const PhysicsPrim& found) {
  const Tokens& t = tokens();
  MujocoLoop loop{numbers(state, found, t.solref, kReference),
                  numbers(state, found, t.solimp, kImpedance),
                  state.values.authored_number(found.prim, t.torque_scale)};
  if (loop.torque_scale && !(*loop.torque_scale >= 0 && std::isfinite(*loop.torque_scale))) {
    refuse(state, found, t.torque_scale, shortest(*loop.torque_scale),
           "a number that is not negative");
    loop.torque_scale.reset();
  }
  return loop;
}

}  // namespace tenon::physics
