// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/scene/fields/scale_field.h"

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

bool scale_numbers(DataRef value, double factor) {
  if (value.kind() == DataKind::Optional) {
    return value.size() != 0 && scale_numbers(value[0], factor);
  }
  const bool is_scaled =
      value.kind() == DataKind::Real || value.type->is_a<Vec3d>() || value.type->is_a<Mat3d>();
  for (std::size_t i = 0; is_scaled && i < value.type->size / sizeof(double); ++i) {
    (&value.as<double>())[i] *= factor;
  }
  return is_scaled;
}

bool scale_in(std::string_view name, double factor, DataRef object) {
  bool done = false;
  for (const DataField& field : object.type->fields) {
    const auto rest = below(name, field.info->name);
    if (!rest || !acts(*field.info)) {
      continue;
    }
    const DataRef value = object.member(field);
    if (rest->empty()) {
      done = scale_numbers(value, factor) || done;
    } else if (value.kind() == DataKind::Struct) {
      done = scale_in(*rest, factor, value) || done;
    }
    for (std::size_t i = 0; !rest->empty() && is_struct_list(*value.type) && i < value.size();
         ++i) {
      done = scale_in(*rest, factor, value[i]) || done;
    }
  }
  return done;
}

}  // namespace

bool is_meant(const Path& meant, const Path& object) {
  return meant.empty() || object == meant ||
         (!meant.is_absolute() && object.name().view() == meant.str());
}

std::size_t scale_field(std::string_view list, std::string_view field, Path object, double factor,
                        PhysicsScene& scene) {
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
      count += scale_in(field, factor, objects[i]) ? 1 : 0;
    }
  }
  return count;
}

}  // namespace tenon::scene
