// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "tenon/stage/collections/material_binding.h"

/// What one relationship on one prim binds. Internal to tenon/stage.
namespace tenon::stage {

/// "material:binding", or "material:binding:purpose".
Token direct_binding_name(Token purpose);
/// The property begins as all bindings do.
bool is_any_binding(Token name);
/// The same for those of collections, of whatever purpose.
bool is_any_collection_binding(Token name);
bool is_stronger(const Relationship& binding);
/// The material that the relationship of a prim with these targets leads to, where it is one.
std::optional<Path> direct_material(const Prim& at, const std::vector<Path>& targets);
MaterialBinding made_binding(const Prim& at, const Relationship& binding, Path material);

}  // namespace tenon::stage
