// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "tenon/layer/layer.h"

namespace tenon::bench {

/// Fills a layer in memory and keeps the lists of children.
class LayerBuilder {
 public:
  explicit LayerBuilder(std::string identifier) : layer_(std::move(identifier)) {}

  /// A prim below `parent`, which is a prim, a variant or the root.
  Path prim(Path parent, Token name, Token type,
            layer::Specifier specifier = layer::Specifier::Def);
  Path attribute(Path prim, Token name, Token type, layer::Value value,
                 layer::Variability variability = layer::Variability::Varying, bool custom = false);
  Path relationship(Path prim, Token name, std::vector<Path> targets);
  /// Prepended API schemas.
  void apply(Path prim, std::vector<Token> schemas);
  /// A variant of `prim`, its set made when it is new.
  Path variant(Path prim, const std::string& set, const std::string& name);
  layer::Spec& spec(Path path) { return *layer_.find(path); }
  /// The layer with its children lists. The builder is spent.
  layer::Layer finish();

 private:
  struct Children {
    std::vector<Token> prims;
    std::vector<Token> properties;
    std::vector<Token> variant_sets;
    std::vector<Token> variants;
  };
  layer::Layer layer_;
  std::unordered_map<Path, Children> children_;
};

}  // namespace tenon::bench
