// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/structure/make/geometry_keys.h"

#include <algorithm>
#include <cstring>
#include <functional>
#include <string_view>

#include "tenon/formats/text/write/writer.h"
#include "tenon/layer/fields.h"
#include "tenon/structure/make/mesh_wrappers.h"

namespace tenon::structure {
namespace {

constexpr std::size_t kSample = 512;  // bytes at either end

/// Equal for equal bytes, and mostly for no others.
std::uint64_t sample_of(const char* data, std::size_t size) {
  const std::hash<std::string_view> hash;
  const std::size_t part = std::min(size, kSample);
  const std::uint64_t ends =
      hash(std::string_view(data, part)) ^ hash(std::string_view(data + size - part, part)) * 3;
  return ends + size;
}

}  // namespace

/// The number of an array among all that have been seen, in place of its bytes.
template <class Element>
bool GeometryKeys::add(const layer::Value& value, std::string& key) {
  const auto* array = value.get<layer::Array<Element>>();
  if (array == nullptr || array->empty()) {
    return false;
  }
  const auto* data = reinterpret_cast<const char*>(array->data());
  const std::size_t size = array->size() * sizeof(Element);
  std::vector<std::size_t>& alike = by_sample_[sample_of(data, size)];
  const auto same = std::find_if(alike.begin(), alike.end(), [&](std::size_t number) {
    const Known& known = arrays_[number];
    return known.size == size && (known.data == data || std::memcmp(known.data, data, size) == 0);
  });
  std::size_t number = arrays_.size();
  if (same != alike.end()) {
    number = *same;
  } else {
    alike.push_back(number);
    arrays_.push_back({layer::Value(*array), data, size});
  }
  key += " " + std::to_string(number);
  return true;
}

/// Arrays of the types that meshes consist of, which are long.
void GeometryKeys::take_out_arrays(layer::Layer& alone, std::string& key) {
  for (const Path& prim : prims_below(alone)) {
    for (const Path& property : properties_of(alone, prim)) {
      layer::Spec& spec = *alone.find(property);
      const layer::Value* value = spec.find(layer::fields::default_value);
      if (value == nullptr) {
        continue;
      }
      const std::size_t start = key.size();
      key += "\n" + property.str();
      if (add<Vec3f>(*value, key) || add<int>(*value, key) || add<Vec2f>(*value, key) ||
          add<float>(*value, key)) {
        spec.erase(layer::fields::default_value);
      } else {
        key.resize(start);
      }
    }
  }
}

std::string GeometryKeys::key(const layer::Layer& content, Path mesh) {
  layer::Layer alone("anon:geometry.usda");
  copy_geometry(content, mesh, alone, Path::from("/G"));
  std::string arrays;
  take_out_arrays(alone, arrays);
  return formats::write_text(alone) + arrays;
}

}  // namespace tenon::structure
