// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>

#include "tenon/scene/fields/data_type.h"

/// What the JSON of a scene has beyond the tables. Internal to tenon/answers.
namespace tenon::answers {

/// A key that follows from fields: written for readers, ignored when read.
struct DerivedKey {
  std::string_view name;
  std::string_view type;  ///< of JSON Schema
  std::string_view meaning;
};

/// Those of a struct; none of most.
std::span<const DerivedKey> derived_keys(const scene::DataType& type);

/// A field is written although it has its default: it is what the object is about.
bool counts(scene::DataView of, const scene::FieldInfo& info);

}  // namespace tenon::answers
