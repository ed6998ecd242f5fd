// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "tenon/answers/dump/dump_values.h"
#include "tenon/answers/dump/json_writer.h"
#include "tenon/stage/stage.h"

namespace tenon::answers {

/// Fields that a stage dump does not list as metadata: arcs, values and what has its own key.
bool is_composition_field(std::string_view name);

/// The members of the object that describes a property, without the braces.
void write_attribute(JsonWriter& json, const stage::Attribute& attribute, const ValueStyle& style);
void write_relationship(JsonWriter& json, const stage::Relationship& relationship,
                        const ValueStyle& style);

/// An object of all fields that are no composition fields.
void write_metadata(JsonWriter& json, const std::map<std::string, layer::Value>& fields,
                    const ValueStyle& style);

}  // namespace tenon::answers
