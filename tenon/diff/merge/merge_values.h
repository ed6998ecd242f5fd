// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tenon/layer/value.h"

namespace tenon::diff {

/// Which side wins where an edit and a new version of the source differ.
enum class Side : std::uint8_t { Edits, Source };

/// What both changed, each in another way. Empty values are not there.
struct ValueConflict {
  std::string key;  ///< within a dictionary ("a:b") or selections (the set); else empty
  layer::Value base;
  layer::Value edited;
  layer::Value source;
};

/// Equal as values; NaN equals NaN.
bool same_value(const layer::Value& a, const layer::Value& b);

/// `base` with the changes of both. Dictionaries and variant selections are merged by their keys,
/// list edits item by item; of all else one side may have changed it, or both in the same way.
/// Otherwise the value of `keep` stands, and a conflict is added.
layer::Value merge_values(const layer::Value& base, const layer::Value& edited,
                          const layer::Value& source, Side keep,
                          std::vector<ValueConflict>& conflicts);

}  // namespace tenon::diff
