// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// Classes are used by name. Where a reference brings a prim that inherits a class into another
// namespace, overrides of the class there apply as well: the arc is implied from node to parent,
// moved through the map between them, up to the root.
#include <algorithm>
#include <optional>
#include <unordered_set>
#include <utility>

#include "tenon/compose/indexer.h"

namespace tenon::compose {
namespace {

/// `class_map` between the images of its ends under `transfer`. What `transfer` relocates within
/// the user of the class is relocated within the class as well; nothing else of it is carried over.
MapFunction implied_map(const MapFunction& transfer, const MapFunction& class_map) {
  if (transfer.is_identity()) {
    return class_map;
  }
  MapFunction::Pairs pairs;
  const bool few = transfer.pairs().size() + class_map.pairs().size() <= kFewPairs;
  std::optional<std::unordered_set<Path>> images;  // where they are many
  if (!few) {
    images.emplace();
  }
  const auto is_new = [&](Path image) {
    return few ? std::none_of(pairs.begin(), pairs.end(),
                              [&](const auto& pair) { return pair.first == image; })
               : images->insert(image).second;
  };
  const auto add = [&](Path source, Path target) {
    const Path image = transfer.map_source_to_target(source);
    if (!image.empty() && is_new(image)) {
      pairs.emplace_back(image, target);
    }
  };
  for (const auto& [source, target] : class_map.pairs()) {
    add(source, target.empty() ? target : transfer.map_source_to_target(target));
  }
  for (const auto& [source, target] : transfer.pairs()) {
    const Path in_class = class_map.map_target_to_source(source);
    if (!in_class.empty() && transfer.map_source_to_target(in_class) != target) {
      add(in_class, target);
    }
  }
  pairs.emplace_back(Path::absolute_root(), Path::absolute_root());
  return MapFunction::make(std::move(pairs), class_map.offset());
}

Path containing_variant(Path path) {
  while (!path.empty() && !path.is_variant_selection()) {
    path = path.parent();
  }
  return path;
}

/// Where the class at `class_path` of a node is for `dest`; empty: nowhere. Maps know nothing of
/// variants: an arc implied into a variant stays within it.
Path implied_path(const Node& dest, Path class_path, const MapFunction& transfer) {
  const Path path = transfer.map_source_to_target(class_path.strip_variants());
  if (path.empty() || !dest.path.has_variants()) {
    return path;
  }
  const Path variant = containing_variant(dest.path);
  return path.replace_prefix(variant.strip_variants(), variant, false);
}

constexpr std::size_t kOriginsForUnit = 8;  // children compared by origin

/// One step: the classes below `source` are to be implied below `dest`.
struct Step {
  NodeId dest;
  NodeId source;
  MapFunction transfer;  // from the namespace of source to that of dest
  bool is_start;
};

class ClassTree {
 public:
  explicit ClassTree(Indexer& indexer) : indexer_(indexer), graph_(indexer.graph) {}

  /// Depth-first: what a class leads to is there before its next sibling.
  void imply(const Step& first) {
    open(first);
    while (!open_.empty() && !indexer_.services.work->exhausted()) {
      graph_.count(1);
      Open& at = open_.back();
      if (at.next == at.children.size()) {
        open_.pop_back();
      } else {
        visit(at.step, at.children[at.next++]);
      }
    }
  }

 private:
  /// A relocate needs no stand-ins: its parent gets the classes, through its map. Hierarchies that
  /// start at the relocate itself are still to be implied.
  Step past_relocates(Step step) {
    while (graph_[step.dest].arc == ArcKind::Relocate) {
      step.transfer = graph_[step.dest].map_to_parent->with_root_identity().compose(step.transfer);
      indexer_.tasks.push(TaskKind::ImpliedClasses, step.dest);
      step.dest = graph_[step.dest].parent;
    }
    return step;
  }

  void open(const Step& step) {
    open_.push_back(
        {past_relocates(step), graph_.children(graph_.owner_of_children(step.source)), 0});
  }

  void visit(const Step& at, NodeId child) {
    Step step = at;  // opening another moves it
    if (!is_class_based(graph_[child].arc) || continues_chain(step, child)) {
      return;
    }
    const NodeId implied = find_or_add(step, child);
    if (implied != kNoNode && graph_.has_class_based_child(child)) {
      open({graph_.owner_of_children(implied), child, std::move(step.transfer), false});
    }
  }

  /// A class of the class that `dest` uses already: the chain leads there, no arc of its own.
  bool continues_chain(const Step& step, NodeId child) const {
    return step.is_start && is_class_based(graph_[step.source].arc) &&
           graph_.depth_below_introduction(step.source) == graph_.depth_below_introduction(child);
  }

  NodeId find_or_add(const Step& step, NodeId child) {
    std::size_t looked_at = 0;
    for (NodeId id = graph_[step.dest].first_child; id != kNoNode; id = graph_[id].next_sibling) {
      if (graph_[id].origin == child && !graph_.is_propagated_specialize(id)) {
        return id;
      }
      ++looked_at;
    }
    graph_.count(looked_at / kOriginsForUnit);
    ClassArcRequest request;
    request.kind = graph_[child].arc;
    request.parent = step.dest;
    request.origin = child;
    request.class_path = implied_path(graph_[step.dest], graph_[child].path, step.transfer);
    request.map = implied_map(step.transfer, *graph_[child].map_to_parent);
    request.number = graph_[child].sibling_number;
    request.ignored = graph_.site(child);
    return add_class_arc(indexer_, request);
  }

  /// A step under way.
  struct Open {
    Step step;
    NodeIds children;
    std::size_t next;
  };

  Indexer& indexer_;
  NodeGraph& graph_;
  std::vector<Open> open_;
};

}  // namespace

NodeId start_of_implied_classes(const NodeGraph& graph, NodeId node) {
  NodeId start = node;
  while (is_class_based(graph[start].arc)) {
    const auto [instance, the_class] = graph.start_of_class_hierarchy(start);
    start = instance;
    // A class within the ancestral class belongs to that hierarchy; one outside continues it.
    if (is_class_based(graph[instance].arc) &&
        graph[the_class].path.has_prefix(graph.path_at_introduction(instance))) {
      break;
    }
  }
  return start;
}

void eval_implied_classes(Indexer& indexer, NodeId node) {
  NodeGraph& graph = indexer.graph;
  if (graph[node].parent == kNoNode || !graph.has_class_based_child(node)) {
    return;
  }
  // The map of a reference ends at the referenced prim; classes outside count nonetheless.
  ClassTree(indexer).imply(
      {graph[node].parent, node, graph[node].map_to_parent->with_root_identity(), true});
}

}  // namespace tenon::compose
