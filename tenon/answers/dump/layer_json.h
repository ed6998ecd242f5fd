// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ostream>

#include "tenon/answers/dump/json_writer.h"
#include "tenon/layer/layer.h"

namespace tenon::answers {

/// What one layer says, uncomposed: `{ "<spec path>": {field: value} }`, specs in path order, in
/// the form that the layer tests of the AOUSD core specification record. Lists of edits are
/// {"explicit" | "delete" | "add" | "prepend" | "append" | "order": [..]}, empty ones omitted; arcs
/// {"asset", "path", "layerOffset", "customData"}; a blocked value is null; floats have the fewest
/// digits that read back as the same float; quaternions end with the real part. Omitted: fields
/// that say what holds anyway (custom = false, varying attributes, the variability of
/// relationships, the specifier of variants).
void write_layer_json(std::ostream& out, const layer::Layer& layer);

/// A value in that form.
void write_plain_value(JsonWriter& json, const layer::Value& value);

}  // namespace tenon::answers
