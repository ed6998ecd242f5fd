// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "tenon/base/path.h"
#include "tenon/compose/cache/index_cache.h"
#include "tenon/compose/layer_opener.h"
#include "tenon/layer/layer.h"

/// What an edit must know of the composed scene, without populating all of it.
namespace tenon::edit {

/// A prim as composition has it, found on the way down from the root.
struct FoundPrim {
  const compose::PrimIndex* index = nullptr;  ///< nullptr: there is no such prim
  bool defined = false;                       ///< it and its ancestors are def or class
  bool abstract = false;                      ///< it or an ancestor is a class
  bool below_instance = false;                ///< an instance proxy

  explicit operator bool() const { return index != nullptr; }
};

/// One property of a prim.
struct FoundProperty {
  layer::SpecKind kind = layer::SpecKind::None;  ///< None: neither authored nor declared
  Token type_name;
  layer::Variability variability = layer::Variability::Varying;
  bool custom = false;
};

/// Indices of the layers as they are; valid until one of them changes.
class ComposedView {
 public:
  ComposedView(layer::LayerPtr root, layer::LayerPtr session, compose::LayerOpener opener,
               compose::ComposeOptions options)
      : cache_(std::move(root), std::move(session), std::move(opener), std::move(options)) {}

  const compose::LayerStack& layer_stack() const { return *cache_.layer_stack(); }
  /// Any layer that composition has opened so far.
  layer::LayerPtr layer(const std::string& identifier) const;
  /// No prim for paths that lead through inactive prims or nowhere.
  FoundPrim prim(Path path);
  /// What the schemas declare or the strongest opinion says, in this order.
  FoundProperty property(const FoundPrim& prim, Token name) const;

 private:
  compose::IndexCache cache_;
};

}  // namespace tenon::edit
