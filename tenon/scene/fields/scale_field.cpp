// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/scene/fields/scale_field.h"

#include <algorithm>
#include <optional>

#include "tenon/scene/fields/patched_fields.h"

namespace tenon::scene {
namespace {

/// The part of "shape.radius" after "shape."; none where `field` is not below `name`.
std::optional<std::string_view> below(std::string_view field, std::string_view name) {
  if (!field.starts_with(name)) {
    return std::nullopt;
  }
  field.remove_prefix(name.size());
  if (field.empty()) {
    return field;
  }
  return field.front() == '.' ? std::optional(field.substr(1)) : std::nullopt;
}

/// The numbers of a Real, a vector or a matrix; none of anything else.
std::span<double> numbers_in(DataRef value) {
  if (value.kind() == DataKind::Optional) {
    return value.size() != 0 ? numbers_in(value[0]) : std::span<double>();
  }
  const bool has_reals =
      value.kind() == DataKind::Real || value.type->is_a<Vec3d>() || value.type->is_a<Mat3d>();
  return {&value.as<double>(), has_reals ? value.type->size / sizeof(double) : 0};
}

/// Calls change(numbers), which tells whether it changed them, for each field of that name.
template <class Change>
bool change_in(std::string_view name, const Change& change, DataRef object) {
  bool done = false;
  for (const DataField& field : object.type->fields) {
    const auto rest = below(name, field.info->name);
    if (!rest || !acts(*field.info)) {
      continue;
    }
    const DataRef value = object.member(field);
    if (rest->empty()) {
      const std::span<double> numbers = numbers_in(value);
      done = (!numbers.empty() && change(numbers)) || done;
    } else if (value.kind() == DataKind::Struct) {
      done = change_in(*rest, change, value) || done;
    }
    for (std::size_t i = 0; !rest->empty() && is_struct_list(*value.type) && i < value.size();
         ++i) {
      done = change_in(*rest, change, value[i]) || done;
    }
  }
  return done;
}

/// How many objects of the list that `object` means were changed.
template <class Change>
std::size_t change_list(std::string_view list, std::string_view field, Path object,
                        const Change& change, PhysicsScene& scene) {
  std::size_t count = 0;
  const DataRef lists = ref_to(scene);
  const DataField* named = find_field(*lists.type, list);
  if (named == nullptr || !is_struct_list(*named->type) ||
      find_field(*named->type->item, "path") == nullptr) {
    return 0;
  }
  const DataRef objects = lists.member(*named);
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (is_meant(object, *path_of(objects[i]))) {
      count += change_in(field, change, objects[i]) ? 1 : 0;
    }
  }
  return count;
}

}  // namespace

bool is_meant(const Path& meant, const Path& object) {
  return meant.empty() || object == meant ||
         (!meant.is_absolute() && object.name().view() == meant.str());
}

std::size_t scale_field(std::string_view list, std::string_view field, Path object, double factor,
                        PhysicsScene& scene) {
  const auto scale = [&](std::span<double> numbers) {
    for (double& number : numbers) {
      number *= factor;
    }
    return true;
  };
  return change_list(list, field, object, scale, scene);
}

std::size_t set_field(std::string_view list, std::string_view field, Path object,
                      std::span<const double> values, PhysicsScene& scene) {
  const auto set = [&](std::span<double> numbers) {
    if (numbers.size() != values.size()) {
      return false;
    }
    std::copy(values.begin(), values.end(), numbers.begin());
    return true;
  };
  return change_list(list, field, object, set, scene);
}

}  // namespace tenon::scene
