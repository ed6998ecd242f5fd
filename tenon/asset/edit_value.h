// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "tenon/asset/edit_asset.h"
#include "tenon/base/result.h"
#include "tenon/layer/layer.h"
#include "tenon/stage/stage.h"

/// What an edit says, held against the schemas. Internal to the wiring.
namespace tenon {

/// A property with the value that it is to have.
struct TypedEdit {
  bool is_relationship = false;
  Token type_name;  ///< of attributes
  layer::Variability variability = layer::Variability::Varying;
  bool custom = false;
  layer::Value value;         ///< of attributes; empty to clear
  std::vector<Path> targets;  ///< of relationships, in the stage's namespace
};

/// Reads the value by the type that the property has: the one of `spec` (where the target layer has
/// one), of the schemas, or of other layers. Errors name the nearest property, or the API schema
/// that would declare it; the type; the tokens that are allowed.
Result<TypedEdit> typed_edit(const stage::Prim& prim, const AssetEdit& edit,
                             const layer::Spec* spec);

/// The composed value of a property as text; empty when there is none.
std::string composed_text(const stage::Prim& prim, Token property);

/// The property, or the API schema, is now as the edit says.
bool is_as_asked(const stage::Prim& prim, const AssetEdit& edit, const TypedEdit& typed);

/// No schema of that name, or it cannot be applied to the prim.
Result<void> check_api(const stage::Prim& prim, Token api);

}  // namespace tenon
