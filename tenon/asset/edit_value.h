// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "tenon/asset/edit_asset.h"
#include "tenon/base/result.h"
#include "tenon/layer/layer.h"
#include "tenon/property_value.h"
#include "tenon/stage/stage.h"

/// The value of an edit, checked against the schemas. Internal to the wiring.
namespace tenon {

/// The value that the edit sets, read by the property's type; none where it clears.
Result<PropertyValue> typed_edit(const stage::Prim& prim, const AssetEdit& edit,
                                 const layer::Spec* spec);

/// The composed value of a property as text; empty when there is none.
std::string composed_text(const stage::Prim& prim, Token property);

/// The property, or the API schema, is now as the edit says.
bool is_as_asked(const stage::Prim& prim, const AssetEdit& edit, const PropertyValue& typed);

}  // namespace tenon
