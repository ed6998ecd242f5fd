// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/base/path.h"
#include "tenon/base/token.h"
#include "tenon/stage/prim.h"

namespace tenon::stage {

/// The material bound to `prim` for `purpose` ("physics", "full", "preview"; empty: all purposes),
/// falling back to the all-purpose binding; an empty path when there is none. Bindings of ancestors
/// are inherited, a nearer one wins unless the farther says "strongerThanDescendants"; at one prim
/// a collection binding wins over a direct one. Bindings count also where MaterialBindingAPI is not
/// applied (S-69): `binding_api_missing` then tells so.
struct MaterialBinding {
  Path material;
  Path relationship;  ///< that binds it
  bool binding_api_missing = false;
  /// A collection that was asked for and is too large (Collection::is_cut), with its property.
  Path cut_collection;
};
MaterialBinding find_material_binding(const Prim& prim, Token purpose);

/// The material alone.
Path bound_material(const Prim& prim, Token purpose);

}  // namespace tenon::stage
