// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/compose/layer_stack.h"

/// What one layer stack says about one path: fields of all its layers combined.
namespace tenon::compose {

/// A place in the scene description: a path in the namespace of a layer stack.
struct Site {
  const LayerStack* layer_stack = nullptr;
  Path path;
  bool operator==(const Site&) const = default;
};

/// Which kinds of arcs a site authors; a bit each.
struct AuthoredArcs {
  bool inherits = false;
  bool variants = false;
  bool references = false;
  bool payloads = false;
  bool specializes = false;

  bool any() const { return inherits || variants || references || payloads || specializes; }
  void add(const layer::Spec& spec);
};

AuthoredArcs authored_arcs(const LayerStack& stack, Path path);

/// Two sites author the same about arcs and about what arcs bring in, layer by layer.
bool author_equal_arcs(const LayerStack& stack, Path a, Path b);
/// Adds the prims that the site's arcs name, whether list edits keep them or not.
void add_named_prims(const LayerStack& stack, Path path, std::vector<Path>& prims);

/// A reference or payload that survived list editing.
struct AssetArc {
  std::string asset_path;           ///< expressions evaluated; empty: the same layer stack
  Path prim_path;                   ///< empty: the default prim
  layer::LayerOffset offset;        ///< as authored
  layer::LayerPtr layer;            ///< where it is authored
  layer::LayerOffset layer_offset;  ///< of that layer in its stack
};

/// How to compare asset paths authored in different layers: the identifier of what one means from
/// that layer, or the path itself when it means nothing.
using AssetIdentity = std::function<std::string(const std::string&, const layer::Layer&)>;

std::vector<AssetArc> composed_references(const LayerStack& stack, Path path,
                                          const AssetIdentity& identity, Diagnostics* errors);
std::vector<AssetArc> composed_payloads(const LayerStack& stack, Path path,
                                        const AssetIdentity& identity, Diagnostics* errors);

/// Targets of inherits or specializes with the layer that authored each.
struct ClassArc {
  Path path;
  const layer::Layer* layer = nullptr;
  bool operator==(const ClassArc& other) const { return path == other.path; }
  std::size_t hash() const { return std::hash<Path>{}(path); }
};
std::vector<ClassArc> composed_class_arcs(const LayerStack& stack, Path path, Token field);

std::vector<std::string> composed_variant_sets(const LayerStack& stack, Path path);
/// Names of the variants of a set.
std::vector<std::string> variant_options(const LayerStack& stack, Path path,
                                         const std::string& set);
bool has_variant_selections(const LayerStack& stack, Path path);
/// The strongest selection for `set`; false when none is authored. Selections with a faulty
/// expression are diagnosed and skipped.
bool composed_variant_selection(const LayerStack& stack, Path path, const std::string& set,
                                std::string* selection, Diagnostics* errors);
/// Adds the selections of this site for sets that have none in `selections` yet.
void add_variant_selections(const LayerStack& stack, Path path,
                            std::map<std::string, std::string>& selections);

}  // namespace tenon::compose
