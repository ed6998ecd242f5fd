// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/structure/shared_arrays.h"

#include <cstring>

namespace tenon::structure {
namespace {

constexpr std::size_t kLong = 256;  // elements

template <class Element>
bool same_bits(const layer::Value& a, const layer::Value& b) {
  const auto* one = a.get<layer::Array<Element>>();
  const auto* other = b.get<layer::Array<Element>>();
  return one != nullptr && other != nullptr && one->size() == other->size() &&
         std::memcmp(one->data(), other->data(), one->size() * sizeof(Element)) == 0;
}

/// Of the types that meshes consist of.
bool same_bits(const layer::Value& a, const layer::Value& b) {
  if (a.type() != b.type() || !a.is_array() || !b.is_array() || a.size() < kLong) {
    return false;
  }
  switch (a.type()) {
    case layer::ValueType::Float:
      return same_bits<float>(a, b);
    case layer::ValueType::Int:
      return same_bits<std::int32_t>(a, b);
    case layer::ValueType::Float2:
      return same_bits<Vec2f>(a, b);
    case layer::ValueType::Float3:
      return same_bits<Vec3f>(a, b);
    default:
      return false;
  }
}

}  // namespace

void share_arrays(const layer::Layer& original, layer::Layer& layer) {
  for (const layer::Layer::Entry& entry : layer.entries()) {
    const layer::Spec* const source = original.find(entry.path);
    if (source == nullptr) {
      continue;
    }
    for (const layer::Field& field : source->fields()) {
      const layer::Value* value = entry.spec.find(field.name);
      if (value != nullptr && same_bits(field.value, *value)) {
        layer.create(entry.path, entry.spec.kind).set(field.name, field.value);
      }
    }
  }
}

}  // namespace tenon::structure
