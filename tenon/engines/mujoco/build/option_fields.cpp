// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Tables pair the asset's names of settings with fields and bits of mjOption. Both directions use
// the same tables, so the writer's output can be read back. MuJoCo's bits that disable something
// are named by what they leave on, and are inverted. A difference from MuJoCo's defaults that has
// no name in the tables is returned to the caller instead of lost.
#include "tenon/engines/mujoco/build/option_fields.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>
#include <string_view>

namespace tenon::engines::mujoco {
namespace {

/// Numbers of a field of mjOption.
struct NumberField {
  const char* name;
  int count;
  mjtNum* (*at)(mjOption&);
};

constexpr NumberField kNumbers[] = {
    {"option:ccd_tolerance", 1, [](mjOption& o) { return &o.ccd_tolerance; }},
    {"option:density", 1, [](mjOption& o) { return &o.density; }},
    {"option:impratio", 1, [](mjOption& o) { return &o.impratio; }},
    {"option:ls_tolerance", 1, [](mjOption& o) { return &o.ls_tolerance; }},
    {"option:magnetic", 3, [](mjOption& o) { return &o.magnetic[0]; }},
    {"option:noslip_tolerance", 1, [](mjOption& o) { return &o.noslip_tolerance; }},
    {"option:o_friction", 5, [](mjOption& o) { return &o.o_friction[0]; }},
    {"option:o_margin", 1, [](mjOption& o) { return &o.o_margin; }},
    {"option:o_solimp", mjNIMP, [](mjOption& o) { return &o.o_solimp[0]; }},
    {"option:o_solref", mjNREF, [](mjOption& o) { return &o.o_solref[0]; }},
    {"option:sleep_tolerance", 1, [](mjOption& o) { return &o.sleep_tolerance; }},
    {"option:tolerance", 1, [](mjOption& o) { return &o.tolerance; }},
    {"option:viscosity", 1, [](mjOption& o) { return &o.viscosity; }},
    {"option:wind", 3, [](mjOption& o) { return &o.wind[0]; }},
};

/// A whole number, or one of words whose places are MuJoCo's numbers.
struct WholeField {
  const char* name;
  int* (*at)(mjOption&);
  std::span<const char* const> words;
};

constexpr const char* kIntegrators[] = {"euler", "rk4", "implicit", "implicitfast"};
constexpr const char* kCones[] = {"pyramidal", "elliptic"};
constexpr const char* kJacobians[] = {"dense", "sparse", "auto"};
constexpr const char* kSolvers[] = {"pgs", "cg", "newton"};
static_assert(mjINT_IMPLICITFAST == 3 && mjCONE_ELLIPTIC == 1 && mjJAC_AUTO == 2 &&
              mjSOL_NEWTON == 2);

constexpr WholeField kWhole[] = {
    {"option:ccd_iterations", [](mjOption& o) { return &o.ccd_iterations; }, {}},
    {"option:cone", [](mjOption& o) { return &o.cone; }, kCones},
    {"option:integrator", [](mjOption& o) { return &o.integrator; }, kIntegrators},
    {"option:iterations", [](mjOption& o) { return &o.iterations; }, {}},
    {"option:jacobian", [](mjOption& o) { return &o.jacobian; }, kJacobians},
    {"option:ls_iterations", [](mjOption& o) { return &o.ls_iterations; }, {}},
    {"option:noslip_iterations", [](mjOption& o) { return &o.noslip_iterations; }, {}},
    {"option:sdf_initpoints", [](mjOption& o) { return &o.sdf_initpoints; }, {}},
    {"option:sdf_iterations", [](mjOption& o) { return &o.sdf_iterations; }, {}},
    {"option:solver", [](mjOption& o) { return &o.solver; }, kSolvers},
};

/// A bit; where `off`, it switches something off that the flag says is on.
struct FlagField {
  const char* name;
  int bit;
  bool off;
};

constexpr FlagField kFlags[] = {
    {"flag:actuation", mjDSBL_ACTUATION, true},
    {"flag:autoreset", mjDSBL_AUTORESET, true},
    {"flag:clampctrl", mjDSBL_CLAMPCTRL, true},
    {"flag:constraint", mjDSBL_CONSTRAINT, true},
    {"flag:contact", mjDSBL_CONTACT, true},
    {"flag:damper", mjDSBL_DAMPER, true},
    {"flag:energy", mjENBL_ENERGY, false},
    {"flag:equality", mjDSBL_EQUALITY, true},
    {"flag:eulerdamp", mjDSBL_EULERDAMP, true},
    {"flag:filterparent", mjDSBL_FILTERPARENT, true},
    {"flag:frictionloss", mjDSBL_FRICTIONLOSS, true},
    {"flag:fwdinv", mjENBL_FWDINV, false},
    {"flag:gravity", mjDSBL_GRAVITY, true},
    {"flag:invdiscrete", mjENBL_INVDISCRETE, false},
    {"flag:island", mjDSBL_ISLAND, true},
    {"flag:limit", mjDSBL_LIMIT, true},
    {"flag:midphase", mjDSBL_MIDPHASE, true},
    {"flag:multiccd", mjDSBL_MULTICCD, true},
    {"flag:nativeccd", mjDSBL_NATIVECCD, true},
    {"flag:override", mjENBL_OVERRIDE, false},
    {"flag:refsafe", mjDSBL_REFSAFE, true},
    {"flag:sensor", mjDSBL_SENSOR, true},
    {"flag:sleep", mjENBL_SLEEP, false},
    {"flag:spring", mjDSBL_SPRING, true},
    {"flag:warmstart", mjDSBL_WARMSTART, true},
};

constexpr std::string_view kDisabledGroups = "option:actuatorgroupdisable";
constexpr int kGroups = 31;  // of actuators, one bit each

int& bits_of(mjOption& option, const FlagField& flag) {
  return flag.off ? option.disableflags : option.enableflags;
}

template <class Field, std::size_t count>
const Field* find(const Field (&fields)[count], std::string_view name) {
  const auto* found = std::find_if(std::begin(fields), std::end(fields),
                                   [&](const Field& field) { return field.name == name; });
  return found == std::end(fields) ? nullptr : found;
}

bool apply_whole(const WholeField& field, const scene::VendorSetting& setting, int& value) {
  if (!field.words.empty()) {
    const auto word = std::find(field.words.begin(), field.words.end(), setting.token);
    value = word == field.words.end() ? value : static_cast<int>(word - field.words.begin());
    return word != field.words.end();
  }
  if (setting.numbers.size() != 1 || !(std::fabs(setting.numbers[0]) < 1e9)) {
    return false;
  }
  value = static_cast<int>(setting.numbers[0]);
  return true;
}

bool apply_groups(const std::vector<double>& groups, mjOption& option) {
  for (const double group : groups) {
    if (!(group >= 0 && group < kGroups)) {
      return false;
    }
    option.disableactuator |= 1 << static_cast<int>(group);
  }
  return true;
}

}  // namespace

bool apply_setting(const scene::VendorSetting& setting, mjOption& option) {
  if (const NumberField* field = find(kNumbers, setting.name)) {
    if (setting.numbers.size() != static_cast<std::size_t>(field->count)) {
      return false;
    }
    std::copy(setting.numbers.begin(), setting.numbers.end(), field->at(option));
    return true;
  }
  if (const WholeField* field = find(kWhole, setting.name)) {
    return apply_whole(*field, setting, *field->at(option));
  }
  if (const FlagField* flag = find(kFlags, setting.name)) {
    if (setting.numbers.size() != 1) {
      return false;
    }
    const bool set = (setting.numbers[0] != 0) != flag->off;
    int& bits = bits_of(option, *flag);
    bits = set ? bits | flag->bit : bits & ~flag->bit;
    return true;
  }
  return setting.name == kDisabledGroups && apply_groups(setting.numbers, option);
}

namespace {

/// Compares fields with MuJoCo's defaults.
class Differences {
 public:
  Differences(const mjOption& option, std::vector<std::string>& unnamed)
      : option_(option), unnamed_(unnamed) {
    mj_defaultOption(&usual_);
  }

  std::vector<scene::VendorSetting> run() {
    add_numbers();
    add_whole();
    add_flags();
    std::sort(settings_.begin(), settings_.end(),
              [](const auto& a, const auto& b) { return a.name < b.name; });
    return std::move(settings_);
  }

 private:
  void add_numbers() {
    for (const NumberField& field : kNumbers) {
      const mjtNum* found = field.at(option_);
      if (!std::equal(found, found + field.count, field.at(usual_))) {
        settings_.push_back({field.name, {found, found + field.count}, ""});
      }
    }
  }

  void add_whole() {
    for (const WholeField& field : kWhole) {
      const int found = *field.at(option_);
      if (found == *field.at(usual_)) {
        continue;
      }
      const auto at = static_cast<std::size_t>(found);
      if (field.words.empty()) {
        settings_.push_back({field.name, {static_cast<double>(found)}, ""});
      } else if (found >= 0 && at < field.words.size()) {
        settings_.push_back({field.name, {}, field.words[at]});
      } else {
        unnamed_.push_back(std::string(field.name).substr(std::string_view("option:").size()) +
                           " " + std::to_string(found));
      }
    }
  }

  void add_flags() {
    int known_on = 0;
    int known_off = 0;
    for (const FlagField& flag : kFlags) {
      (flag.off ? known_off : known_on) |= flag.bit;
      const bool found = (bits_of(option_, flag) & flag.bit) != 0;
      if (found != ((bits_of(usual_, flag) & flag.bit) != 0)) {
        settings_.push_back({flag.name, {found != flag.off ? 1.0 : 0.0}, ""});
      }
    }
    if (((option_.enableflags ^ usual_.enableflags) & ~known_on) != 0 ||
        ((option_.disableflags ^ usual_.disableflags) & ~known_off) != 0) {
      unnamed_.emplace_back("flags of other names");
    }
    std::vector<double> groups;
    for (int group = 0; group < kGroups; ++group) {
      if ((option_.disableactuator >> group & 1) != 0) {
        groups.push_back(group);
      }
    }
    if (!groups.empty()) {
      settings_.push_back({std::string(kDisabledGroups), std::move(groups), ""});
    }
  }

  mjOption option_;
  mjOption usual_;
  std::vector<std::string>& unnamed_;
  std::vector<scene::VendorSetting> settings_;
};

}  // namespace

std::vector<scene::VendorSetting> run_settings(const mjOption& option) {
  constexpr const char* kDiscrete = "discrete";  // no asset can ask for it
  const auto word = [](std::string name, const auto& words, int number) {
    const auto at = static_cast<std::size_t>(number);
    return scene::VendorSetting{std::move(name), {}, at < std::size(words) ? words[at] : kDiscrete};
  };
  std::vector<scene::VendorSetting> settings = {
      word("integrator", kIntegrators, option.integrator),
      word("solver", kSolvers, option.solver),
      {"iterations", {static_cast<double>(option.iterations)}, ""},
      {"tolerance", {option.tolerance}, ""},
      word("cone", kCones, option.cone),
      {"impratio", {option.impratio}, ""},
  };
  constexpr std::string_view kPrefix = "option:";
  std::vector<std::string> unnamed;
  for (scene::VendorSetting& setting : settings_of(option, unnamed)) {
    if (setting.name.starts_with(kPrefix)) {
      setting.name.erase(0, kPrefix.size());
    }
    const bool known = std::any_of(settings.begin(), settings.end(),
                                   [&](const auto& s) { return s.name == setting.name; });
    if (!known && setting.name != "flag:autoreset") {  // off in every run
      settings.push_back(std::move(setting));
    }
  }
  return settings;
}

std::vector<scene::VendorSetting> settings_of(const mjOption& option,
                                              std::vector<std::string>& unnamed) {
  return Differences(option, unnamed).run();
}

}  // namespace tenon::engines::mujoco
