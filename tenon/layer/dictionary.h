// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>

#include "tenon/layer/value.h"

namespace tenon::layer {

/// Named values, sorted by name; values may be dictionaries.
struct Dictionary {
  std::map<std::string, Value, std::less<>> items;

  bool operator==(const Dictionary&) const = default;
  bool empty() const { return items.empty(); }
  /// The value named `key`, or nullptr.
  const Value* find(std::string_view key) const {
    const auto it = items.find(key);
    return it == items.end() ? nullptr : &it->second;
  }
};

/// `stronger` over `weaker`: keys of both are merged, dictionaries recursively.
Dictionary merge(const Dictionary& stronger, const Dictionary& weaker);

/// A field whose name no schema knows: text layers give its source text (a string) or a dictionary.
struct UnregisteredValue {
  Value value;
  bool operator==(const UnregisteredValue&) const = default;
  /// Of the text; the same for all others.
  std::size_t hash() const { return std::hash<std::string>{}(value.get_or(std::string())); }
};

/// Variant set name to chosen variant.
struct VariantSelections {
  std::map<std::string, std::string, std::less<>> items;
  bool operator==(const VariantSelections&) const = default;
};

}  // namespace tenon::layer
