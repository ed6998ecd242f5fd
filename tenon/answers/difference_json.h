// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/answers/json.h"
#include "tenon/diff/layer_difference.h"
#include "tenon/scene/fields/scene_difference.h"

namespace tenon::answers {

/// {"change", "path", "kind", "field", "key", "before", "after", "beforeLine", "afterLine",
/// "specs", "elements", "differentElements", "largest"}; values as text layers print them, cut
/// after 100 characters.
Json difference_json(const diff::Difference& difference);

/// {"change", "object", "path", "what", "unit", "before", "after", "largest"}; SI and radians.
Json difference_json(const scene::SceneDifference& difference);

/// A value on one line as text layers print it, cut after 100 characters.
std::string shown_side(const layer::Value& value);
/// "prim", "attribute", "variant set"; "layer" for the pseudo-root.
const char* spec_kind_name(layer::SpecKind kind);

}  // namespace tenon::answers
