// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/layer/metadata_fields.h"

#include <array>
#include <functional>
#include <limits>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "tenon/layer/fields.h"

namespace tenon::layer {
namespace {

constexpr std::uint8_t kLayer = 1;
constexpr std::uint8_t kPrim = 2;
constexpr std::uint8_t kAttribute = 4;
constexpr std::uint8_t kRelationship = 8;

std::uint8_t home_of(SpecKind kind) {
  switch (kind) {
    case SpecKind::PseudoRoot:
      return kLayer;
    case SpecKind::Prim:
    case SpecKind::Variant:
      return kPrim;
    case SpecKind::Attribute:
      return kAttribute;
    case SpecKind::Relationship:
      return kRelationship;
    default:
      return 0;
  }
}

struct MetadataTable {
  std::vector<MetadataField> rows;
  std::unordered_map<Token, std::size_t> by_name;
  // By the upper bits of the hash, the next free row where one is taken. Asked for each field of
  // each spec that is written.
  static constexpr std::size_t kSlots = 64;
  std::array<std::pair<const void*, std::uint8_t>, kSlots> structural{};

  MetadataTable() {
#define TENON_METADATA(name, value_type, array, where) \
  rows.push_back({Token(#name), ValueType::value_type, array, where});
#include "tenon/layer/metadata_fields.def"
#undef TENON_METADATA
    for (std::size_t i = 0; i < rows.size(); ++i) {
      by_name.emplace(rows[i].name, i);
    }
    add_structural(kLayer | kPrim | kAttribute | kRelationship, {fields::comment});
    add_structural(kLayer | kPrim, {fields::primChildren, fields::primOrder});
    add_structural(kLayer, {fields::layerRelocates, fields::subLayers, fields::subLayerOffsets});
    add_structural(
        kPrim, {fields::inheritPaths, fields::payload, fields::properties, fields::propertyOrder,
                fields::references, fields::relocates, fields::specializes, fields::specifier,
                fields::variantSelection, fields::variantSetChildren, fields::variantSetNames});
    add_structural(kAttribute | kRelationship,
                   {fields::custom, fields::default_value, fields::variability});
    add_structural(kAttribute, {fields::connectionChildren, fields::connectionPaths, fields::spline,
                                fields::timeSamples, fields::typeName});
    add_structural(kRelationship, {fields::targetChildren, fields::targetPaths});
  }

  void add_structural(std::uint8_t homes, std::initializer_list<Token> names) {
    for (const Token& name : names) {
      auto& slot = structural[slot_of(name)];
      slot.first = name.id();
      slot.second = static_cast<std::uint8_t>(slot.second | homes);
    }
  }

  /// Where the name stands, or the free row where it would.
  std::size_t slot_of(Token name) const {
    constexpr int kShift = std::numeric_limits<std::size_t>::digits - 6;
    std::size_t at = std::hash<Token>()(name) >> kShift;
    while (structural[at].first != nullptr && structural[at].first != name.id()) {
      at = (at + 1) % kSlots;
    }
    return at;
  }
};

const MetadataTable& field_table() {
  static const auto* table = new MetadataTable();
  return *table;
}

}  // namespace

const MetadataField* find_metadata_field(Token name, SpecKind kind) {
  const auto it = field_table().by_name.find(name);
  if (it == field_table().by_name.end()) {
    return nullptr;
  }
  const MetadataField& field = field_table().rows[it->second];
  return (field.homes & home_of(kind)) == 0 ? nullptr : &field;
}

bool is_value_of_metadata(Token name, SpecKind kind, const Value& value) {
  const MetadataField* field = find_metadata_field(name, kind);
  return field != nullptr && value.type() == field->type && value.is_array() == field->is_array;
}

bool is_structural_field(Token name, SpecKind kind) {
  const MetadataTable& table = field_table();
  return (table.structural[table.slot_of(name)].second & home_of(kind)) != 0;
}

std::span<const MetadataField> all_metadata_fields() { return field_table().rows; }

}  // namespace tenon::layer
