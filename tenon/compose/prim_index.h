// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/base/path.h"
#include "tenon/compose/arc.h"
#include "tenon/compose/layer_stack.h"
#include "tenon/compose/map_function.h"

namespace tenon::compose {

inline constexpr std::uint32_t kNoNode = 0xFFFFFFFFu;

/// One site (layer stack and path) that contributes to a prim, and the arc that brought it in.
struct Node {
  ArcKind arc = ArcKind::Root;
  LayerStackPtr layer_stack;
  Path path;                         ///< in the namespace of layer_stack, variant selections included
  MapFunction map_to_parent;
  MapFunction map_to_root;           ///< from this node's namespace and time to the stage's
  std::uint32_t parent = kNoNode;
  std::uint32_t origin = kNoNode;    ///< the node that caused this one, differs for implied arcs
  std::vector<std::uint32_t> children;  ///< strongest first
  std::uint16_t namespace_depth = 0;    ///< depth of the parent node's path when the arc was added
  std::uint16_t sibling_number = 0;     ///< order among arcs of one kind at one site
  bool inert = false;                ///< kept for structure, contributes no opinions
  bool culled = false;
  bool has_specs = false;
  bool due_to_ancestor = false;
};

/// One layer's spec of a prim within an index.
struct Opinion {
  const layer::Layer* layer = nullptr;
  const layer::Spec* spec = nullptr;
  Path path;                  ///< of the spec in that layer
  std::uint32_t node = 0;     ///< into PrimIndex::nodes
  layer::LayerOffset offset;  ///< stage time = offset(layer time)
};

/// Everything that composition found out about one prim.
struct PrimIndex {
  Path path;
  std::vector<Node> nodes;               ///< node 0 is the root
  std::vector<std::uint32_t> strength_order;  ///< nodes, strongest first
  std::vector<Opinion> opinions;         ///< prim specs, strongest first
  std::vector<Token> child_names;        ///< composed, ordered, prohibited names removed
  std::vector<Token> prohibited_child_names;  ///< relocated away; sorted
  std::vector<Token> property_names;     ///< composed and ordered (propertyOrder), authored ones only
  /// Selections in force: the variant whose opinions contribute.
  std::map<std::string, std::string> variant_selections;
  bool has_payloads = false;             ///< some payload arc is authored
  bool payload_loaded = false;           ///< and included under the load rules
  bool instanceable = false;             ///< an instance: some arc, and instanceable = true
  /// Equal for prims that share a prototype; empty when not instanceable.
  std::string instance_key;
  Diagnostics errors;                    ///< rule = "compose.<class>" of section "composition errors"

  /// `path` of node's namespace in the stage's; empty when it has no image.
  Path map_to_root(std::uint32_t node, Path path_in_node) const {
    return nodes[node].map_to_root.map_source_to_target(path_in_node.strip_variants());
  }
};

}  // namespace tenon::compose
