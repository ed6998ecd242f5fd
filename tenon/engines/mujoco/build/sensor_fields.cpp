// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// MuJoCo's own list of the fields of mjsSensor is walked, so that a field of a new release is kept
// with no change here. What is no number says what the sensor is and of what, and is kept by
// itself.
#include "tenon/engines/mujoco/build/sensor_fields.h"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

namespace tenon::engines::mujoco {
namespace {

/// What the elements are called, in the order of mjtSensor.
constexpr std::string_view kSensorWords =
    "touch accelerometer velocimeter gyro force torque magnetometer rangefinder "
    "camprojection jointpos jointvel tendonpos tendonvel actuatorpos actuatorvel actuatorfrc "
    "jointactuatorfrc tendonactuatorfrc ballquat ballangvel jointlimitpos jointlimitvel "
    "jointlimitfrc tendonlimitpos tendonlimitvel tendonlimitfrc framepos framequat "
    "framexaxis frameyaxis framezaxis framelinvel frameangvel framelinacc frameangacc "
    "subtreecom subtreelinvel subtreeangmom insidesite distance normal fromto contact "
    "e_potential e_kinetic clock tactile plugin user";
static_assert(std::count(kSensorWords.begin(), kSensorWords.end(), ' ') == mjSENS_USER,
              "MuJoCo has other sensors");

constexpr std::pair<mjtGeom, std::string_view> kSiteShapes[] = {{mjGEOM_SPHERE, "sphere"},
                                                                {mjGEOM_CAPSULE, "capsule"},
                                                                {mjGEOM_ELLIPSOID, "ellipsoid"},
                                                                {mjGEOM_CYLINDER, "cylinder"},
                                                                {mjGEOM_BOX, "box"}};

constexpr double kMost = 1e9;  // of whole numbers

template <class T>
constexpr bool kIsNumber = std::is_same_v<T, double> || std::is_same_v<T, int> ||
                           std::is_same_v<T, mjtDataType> || std::is_same_v<T, mjtStage>;

/// Calls `with(name, numbers, count)` for each field of numbers.
template <class Sensor, class With>
void for_each_number(Sensor& sensor, const With& with) {
  const auto visit = [&](const char* name, auto* numbers, std::size_t count) {
    if constexpr (kIsNumber<std::remove_cv_t<std::remove_pointer_t<decltype(numbers)>>>) {
      with(name, numbers, count);
    }
  };
#define X(type, name, count) visit(#name, &sensor.name, 1);
#define XVEC(type, name, count) visit(#name, &sensor.name[0], count);
  MJSSENSOR_FIELDS
#undef XVEC
#undef X
}

template <class T>
T number_as(double number) {
  if constexpr (std::is_same_v<T, double>) {
    return number;
  } else {
    return static_cast<T>(static_cast<int>(std::clamp(number, -kMost, kMost)));
  }
}

constexpr std::string_view kUserData = "userdata";

mjsSensor default_sensor() {
  mjsSensor sensor{};
  mjs_defaultSensor(&sensor);
  return sensor;
}

}  // namespace

std::string sensor_word(mjtSensor kind) {
  std::string_view words = kSensorWords;
  for (int i = 0; i < kind; ++i) {
    words.remove_prefix(words.find(' ') + 1);
  }
  return std::string(words.substr(0, words.find(' ')));
}

std::optional<mjtSensor> sensor_kind(std::string_view word) {
  for (int kind = 0; kind <= mjSENS_USER; ++kind) {
    if (sensor_word(static_cast<mjtSensor>(kind)) == word) {
      return static_cast<mjtSensor>(kind);
    }
  }
  return std::nullopt;
}

std::string thing_word(mjtObj kind) {
  const char* word = kind == mjOBJ_UNKNOWN ? nullptr : mju_type2Str(kind);
  return word == nullptr ? std::string() : std::string(word);
}

mjtObj thing_kind(const std::string& word) {
  return word.empty() ? mjOBJ_UNKNOWN : static_cast<mjtObj>(mju_str2Type(word.c_str()));
}

std::string site_shape_word(int type) {
  for (const auto& [shape, word] : kSiteShapes) {
    if (shape == type) {
      return std::string(word);
    }
  }
  return {};
}

std::optional<mjtGeom> site_shape(std::string_view word) {
  for (const auto& [shape, name] : kSiteShapes) {
    if (name == word) {
      return shape;
    }
  }
  return std::nullopt;
}

std::vector<scene::VendorSetting> sensor_settings(const mjsSensor& sensor) {
  std::vector<scene::VendorSetting> settings;
  const mjsSensor usual = default_sensor();
  for_each_number(sensor, [&](const char* name, const auto* numbers, std::size_t count) {
    settings.push_back({name, std::vector<double>(numbers, numbers + count), ""});
  });
  std::size_t at = 0;
  for_each_number(usual, [&](const char*, const auto* numbers, std::size_t count) {
    if (settings[at].numbers == std::vector<double>(numbers, numbers + count)) {
      settings.erase(settings.begin() + static_cast<std::ptrdiff_t>(at));
    } else {
      ++at;
    }
  });
  int count = 0;
  const double* user = mjs_getDouble(sensor.userdata, &count);
  if (count > 0) {
    settings.push_back({std::string(kUserData), std::vector<double>(user, user + count), ""});
  }
  return settings;
}

bool set_sensor_numbers(mjsSensor& sensor, std::string_view name,
                        const std::vector<double>& numbers) {
  if (name == kUserData) {
    mjs_setDouble(sensor.userdata, numbers.data(), static_cast<int>(numbers.size()));
    return true;
  }
  const bool finite = std::all_of(numbers.begin(), numbers.end(),
                                  [](double number) { return std::isfinite(number); });
  bool known = false;
  for_each_number(sensor, [&](const char* field, auto* to, std::size_t count) {
    if (finite && name == field && numbers.size() == count) {
      known = true;
      std::transform(numbers.begin(), numbers.end(), to, [](double number) {
        return number_as<std::remove_pointer_t<decltype(to)>>(number);
      });
    }
  });
  return known;
}

}  // namespace tenon::engines::mujoco
