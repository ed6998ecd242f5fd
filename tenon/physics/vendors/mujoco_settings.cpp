// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/physics/vendors/mujoco_settings.h"

#include <cmath>

#include "tenon/physics/attribute_values.h"

namespace tenon::physics {
namespace {

constexpr std::string_view kSpace = "mjc:";

/// The components of a value that is an array or a vector of T.
template <class T>
bool take(const layer::Value& value, std::vector<double>& numbers) {
  const auto* array = value.get<layer::Array<T>>();
  for (std::size_t i = 0; array != nullptr && i < array->size(); ++i) {
    numbers.push_back(static_cast<double>((*array)[i]));
  }
  return array != nullptr;
}

template <class V>
bool take_vector(const layer::Value& value, std::vector<double>& numbers) {
  const V* vector = value.get<V>();
  for (std::size_t i = 0; vector != nullptr && i < vector->v.size(); ++i) {
    numbers.push_back(static_cast<double>((*vector)[i]));
  }
  return vector != nullptr;
}

}  // namespace

std::vector<double> numbers_of(const stage::Prim& prim, Token name) {
  const layer::Value value = prim.attribute(name).get();
  std::vector<double> numbers;
  if (const bool* flag = value.get<bool>()) {
    numbers.push_back(*flag ? 1 : 0);
  } else if (const std::optional<double> number = number_of(value)) {
    numbers.push_back(*number);
  } else {
    [[maybe_unused]] const bool known =
        take<double>(value, numbers) || take<float>(value, numbers) ||
        take<std::int32_t>(value, numbers) || take_vector<Vec3d>(value, numbers) ||
        take_vector<Vec3f>(value, numbers) || take_vector<Vec4f>(value, numbers);
  }
  for (const double number : numbers) {
    if (!std::isfinite(number)) {
      return {};
    }
  }
  return numbers;
}

std::optional<VendorSetting> read_mujoco_setting(const stage::Prim& prim, Token name) {
  VendorSetting setting;
  setting.name = name.view().substr(kSpace.size());
  if (const auto token = prim.attribute(name).get_as<Token>()) {
    setting.token = token->str();
    return setting;
  }
  setting.numbers = numbers_of(prim, name);
  return setting.numbers.empty() ? std::nullopt : std::optional(std::move(setting));
}

}  // namespace tenon::physics
