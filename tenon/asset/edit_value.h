// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "tenon/asset/edit_asset.h"
#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/layer/layer.h"
#include "tenon/property_value.h"
#include "tenon/stage/stage.h"

/// The value of an edit, checked against the schemas. Internal to the wiring.
namespace tenon {

/// The value that the edit sets, read by the property's type; none where it clears.
Result<PropertyValue> typed_edit(const stage::Prim& prim, const AssetEdit& edit,
                                 const layer::Spec* spec);

/// The composed value of a property, or its targets, as text; empty when there is none.
std::string composed_text(const stage::Prim& prim, Token property, stage::Time time = {});
/// The same of the property or metadata that the edit is about, at its time.
std::string composed_text(const stage::Prim& prim, const AssetEdit& edit);

/// What the edit is about is now as it says.
bool is_as_asked(const stage::Prim& prim, const AssetEdit& edit, const PropertyValue& typed);

/// Warns where the value that was set counts at no time but the default one (edit.has-samples).
void warn_of_samples(const stage::Prim& prim, const AssetEdit& edit, const PropertyValue& typed,
                     Diagnostics& diagnostics);

}  // namespace tenon
