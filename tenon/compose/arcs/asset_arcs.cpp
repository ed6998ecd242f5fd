// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// References and payloads: arcs to a prim of another layer stack, or of the same one.
#include "tenon/compose/arcs/authored_arc.h"
#include "tenon/compose/composition_error.h"
#include "tenon/compose/indexer.h"
#include "tenon/compose/muting.h"

namespace tenon::compose {
namespace {

std::string_view noun(ArcKind kind) { return kind == ArcKind::Payload ? "payload" : "reference"; }

/// Where an item leads: a stack, its root layer and the scale between time codes.
struct Destination {
  const LayerStack* stack = nullptr;
  layer::LayerPtr layer;
  double scale = 1;
};

class AssetArcAdder {
 public:
  AssetArcAdder(Indexer& indexer, NodeId node, ArcKind kind)
      : indexer_(indexer), node_(node), kind_(kind) {}

  void add(const AssetArc& item, std::uint16_t number) {
    if (!check_prim_path(item)) {
      return;
    }
    layer::LayerOffset offset = checked_offset(item);
    const Destination to = destination(item);
    if (to.stack == nullptr) {
      return;
    }
    offset.scale *= to.scale;
    ArcOptions options;
    const Path prim = prim_path(item, to, options);
    options.include_ancestral = prim.depth() != 1;
    Arc arc;
    arc.kind = kind_;
    arc.map_to_parent = shared_arc_map(indexer_, {prim, offset, item.asset_path.empty()}, node_);
    arc.parent = arc.origin = node_;
    arc.namespace_depth = introduction_depth(indexer_, node_);
    arc.sibling_number = number;
    add_arc(indexer_, arc, {to.stack, prim}, options);
  }

 private:
  Path site() const { return indexer_.graph[node_].path; }

  void report(std::string_view error_class, const AssetArc& item, const Message& message,
              std::string fix) {
    indexer_.report(error_class, item.layer.get(), site(), message, std::move(fix),
                    authored_item(item, site(), kind_));
  }

  bool check_prim_path(const AssetArc& item) {
    const Path path = item.prim_path;
    if (path.empty() || (path.is_absolute() && path.is_prim() && !path.has_variants())) {
      return true;
    }
    report(error_class::kInvalidPrimPath, item,
           "the " + std::string(noun(kind_)) + " leads to " + named(path) +
               ", which is not an absolute prim path without variants",
           "name a prim by its absolute path");
    return false;
  }

  /// In the stack's time. An internal arc stays within the stack, whose layers have their offsets
  /// already: as OpenUSD 26.11 has it, only what the arc itself says counts.
  layer::LayerOffset checked_offset(const AssetArc& item) {
    if (is_usable(item.offset)) {
      return item.asset_path.empty() ? item.offset : item.layer_offset * item.offset;
    }
    report(error_class::kInvalidReferenceOffset, item,
           "the layer offset of the " + std::string(noun(kind_)) + " to @" + item.asset_path +
               "@ is not finite or its scale is not positive; none is used",
           "author a finite offset and a positive scale");
    return {};
  }

  bool is_muted_arc(const AssetArc& item, const layer::Layer* layer) const {
    const std::set<std::string>& muted = indexer_.services.options->muted;
    return layer == nullptr ? is_muted(muted, item.asset_path, *item.layer)
                            : muted.count(item.asset_path) + muted.count(layer->identifier()) != 0;
  }

  Destination destination(const AssetArc& item) {
    const LayerStack* own_stack = indexer_.graph[node_].layer_stack;
    if (item.asset_path.empty()) {
      return {own_stack, own_stack->root, 1};
    }
    Result<layer::LayerPtr> opened = indexer_.services.open(item.asset_path, *item.layer);
    const layer::LayerPtr layer = opened ? *opened : nullptr;
    if (is_muted_arc(item, layer.get())) {
      report(error_class::kMutedAssetPath, item,
             "@" + item.asset_path + "@ is muted, the " + std::string(noun(kind_)) + " is skipped",
             "unmute the layer");
      return {};
    }
    if (layer == nullptr) {
      indexer_.services.missing(
          {item.layer->identifier(), site(), std::string(noun(kind_)), item.asset_path});
      report(error_class::kInvalidAssetPath, item,
             "the " + std::string(noun(kind_)) + " @" + item.asset_path + "@ cannot be opened" +
                 (opened ? std::string() : ": " + opened.error().message()),
             "correct the path or provide the file");
      return {};
    }
    Destination to;
    to.layer = layer;
    to.stack = indexer_.services.stack(layer, own_stack);
    to.scale = rate_ratio(item.layer->time_codes_per_second(), to.stack->time_codes_per_second);
    return to;
  }

  Path prim_path(const AssetArc& item, const Destination& to, ArcOptions& options) {
    if (!item.prim_path.empty()) {
      return item.prim_path;
    }
    const Path root = Path::absolute_root();
    const std::string& name = to.layer->default_prim().str();
    Path path;
    if (!name.empty()) {
      Result<Path> parsed = Path::parse(name);
      path = parsed ? parsed->absolute(root) : Path();
    }
    if (path.is_prim() && !path.has_variants()) {
      return path;
    }
    report(error_class::kUnresolvedPrimPath, item,
           "the " + std::string(noun(kind_)) + " names no prim and @" + to.layer->identifier() +
               "@ has no default prim",
           "author defaultPrim in the layer or name a prim");
    options.contributes = false;
    return root;
  }

  Indexer& indexer_;
  NodeId node_;
  ArcKind kind_;
};

bool has_specs_below(const NodeGraph& graph, NodeId node) {
  const bool at_introduction = graph.depth_below_introduction(node) == 0;
  for (const NodeId id : graph.subtree(node)) {
    if (at_introduction ? graph[id].has_specs
                        : graph[id].layer_stack->has_spec(graph.path_at_introduction(id))) {
      return true;
    }
  }
  return false;
}

/// The item that became a node, and the layer that authors it.
AuthoredArc introducing_item(const Indexer& indexer, NodeId node, Path parent_path) {
  const Node& at = indexer.graph[node];
  const LayerStack& stack = *indexer.graph[at.parent].layer_stack;
  const auto identity = [](const std::string& path, const layer::Layer&) { return path; };
  const auto composed = at.arc == ArcKind::Payload ? composed_payloads : composed_references;
  const std::vector<AssetArc> arcs = composed(stack, parent_path, identity, nullptr);
  if (at.sibling_number >= arcs.size()) {
    return {stack.root.get(), {}};
  }
  const AssetArc& arc = arcs[at.sibling_number];
  return {arc.layer.get(), authored_item(arc, parent_path, at.arc)};
}

}  // namespace

void add_asset_arcs(Indexer& indexer, NodeId node, ArcKind kind,
                    const std::vector<AssetArc>& arcs) {
  AssetArcAdder adder(indexer, node, kind);
  std::uint16_t number = 0;
  for (const AssetArc& arc : arcs) {
    if (indexer.services.work->exhausted()) {
      return;
    }
    adder.add(arc, number++);
  }
}

AssetIdentity asset_identity(const Indexer& indexer) {
  return [&services = indexer.services](const std::string& path, const layer::Layer& layer) {
    Result<layer::LayerPtr> opened = services.open(path, layer);
    return opened && *opened != nullptr ? (*opened)->identifier() : path;
  };
}

void eval_unresolved_prim_path(Indexer& indexer, NodeId node) {
  const NodeGraph& graph = indexer.graph;
  if (graph.path_at_introduction(node).is_absolute_root() || has_specs_below(graph, node)) {
    return;
  }
  const Path parent_path = graph.introducing_path(node);
  const Path missing = graph.path_at_introduction(node);
  AuthoredArc item = introducing_item(indexer, node, parent_path);
  indexer.report(error_class::kUnresolvedPrimPath, item.layer, parent_path,
                 "the " + std::string(noun(graph[node].arc)) + " leads to " +
                     named_in(*graph[node].layer_stack->root, missing) + ", which does not exist",
                 "correct the prim path", std::move(item.part));
}

}  // namespace tenon::compose
