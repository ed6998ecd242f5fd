// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <unordered_map>
#include <vector>

#include "tenon/base/path.h"
#include "tenon/base/token.h"
#include "tenon/stage/collections/collection.h"
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

/// The bindings by collections that prims have, each read when it is first asked for: for many
/// questions about one stage that does not change meanwhile.
class CollectionBindings {
 public:
  struct Binding {
    Token name;  ///< of the relationship
    bool is_stronger = false;
    Path collection;
    Path material;  ///< empty: the relationship names no collection and material
    std::optional<Collection> members;
  };
  /// In the order of names.
  std::vector<Binding>& of(const Prim& prim);

 private:
  std::unordered_map<Path, std::vector<Binding>> known_;
};
MaterialBinding find_material_binding(const Prim& prim, Token purpose, CollectionBindings& known);
Path bound_material(const Prim& prim, Token purpose, CollectionBindings& known);

}  // namespace tenon::stage
