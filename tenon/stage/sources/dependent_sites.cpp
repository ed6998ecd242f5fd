// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A prim P with an arc to A is composed of it with all that is below A: what happens to A/x happens
// to P/x, in each layer stack on the way from the arc to the stage. Those ways are read off the
// prim indices, from a node at or above A/x up to the root: what is below the path of a node is
// below the path of its parent, too. A class arc is implied in the layer stacks that reference the
// one that has it; such nodes name theirs as origin.
#include "tenon/stage/sources/dependent_sites.h"

#include <algorithm>
#include <tuple>
#include <unordered_map>

#include "tenon/compose/prim_index.h"
#include "tenon/stage/stage_data.h"

namespace tenon::stage {
namespace {

using compose::ArcKind;
using compose::LayerStack;
using compose::Node;

bool is_class(ArcKind arc) { return arc == ArcKind::Inherit || arc == ArcKind::Specialize; }

/// The arc ends at the path of its node and at no path above it.
bool ends_here(const Node& node) {
  return !node.due_to_ancestor && node.arc != ArcKind::Root && node.arc != ArcKind::Variant;
}

class DependentSearch {
 public:
  DependentSearch(const Stage& stage, const std::map<std::string, Path>& sites, DependentOn what)
      : stage_(stage), sites_(sites), of_name_(what == DependentOn::Name) {}

  Dependents search() {
    std::vector<Prim> open{stage_.pseudo_root()};
    while (!open.empty()) {
      const Prim at = open.back();
      open.pop_back();
      look(at.path());
      const std::vector<Prim> children = at.children();
      open.insert(open.end(), children.begin(), children.end());
    }
    return std::move(found_);
  }

 private:
  struct Place {
    std::uint32_t node;
    Path path;  ///< in its layer stack
  };

  void look(Path prim) {
    const PrimData* const data = record_of(stage_, prim);
    if (data == nullptr || data->is_prototype_root) {
      return;
    }
    const compose::Nodes nodes = data->index->nodes();
    index_ = data->index;
    prim_ = prim;
    for (std::uint32_t id = 1; id < nodes.size(); ++id) {
      const Node node = nodes[id];
      const Path at = node.path.strip_variants();
      for (const Path site : sites_in(*node.layer_stack)) {
        const bool below = site.has_prefix(at) && (site != at || node.due_to_ancestor || !of_name_);
        if (below && node.arc != ArcKind::Variant) {
          follow({id, site});
        } else if (of_name_ && at.has_prefix(site) && ends_here(node)) {
          note_arc(node, nodes[node.parent], site);
        }
      }
    }
  }

  /// The paths of the prim in a layer stack.
  const std::set<Path>& sites_in(const LayerStack& stack) {
    const auto [known, is_new] = in_stack_.try_emplace(&stack);
    if (is_new) {
      for (const compose::StackedLayer& stacked : stack.layers) {
        const auto site = sites_.find(stacked.layer->identifier());
        if (site != sites_.end()) {
          known->second.insert(site->second);
        }
      }
    }
    return known->second;
  }

  /// From one node to all that it is part of.
  void follow(Place start) {
    const compose::Nodes nodes = index_->nodes();
    std::vector<Place> open{start};
    std::set<std::pair<std::uint32_t, Path>> seen;
    std::set<Dependents::Site> sites;
    std::vector<Path> prims;
    while (!open.empty()) {
      const Place place = open.back();
      open.pop_back();
      if (place.path.empty() || !seen.emplace(place.node, place.path).second) {
        continue;
      }
      const Node node = nodes[place.node];
      add_sites(*node.layer_stack, place.path, sites);
      add_implied(place, open);
      if (node.parent == compose::kNoNode) {
        add_prims(place.path, prims, sites);
      } else if (of_name_ && place.path == node.path.strip_variants() && ends_here(node)) {
        note_arc(node, nodes[node.parent], place.path);
      } else {
        const Path parent = nodes[node.parent].path.strip_variants();
        open.push_back(
            {node.parent, place.path.replace_prefix(node.path.strip_variants(), parent)});
      }
    }
    note(prims, std::move(sites));
  }

  void note(const std::vector<Path>& prims, std::set<Dependents::Site> sites) {
    for (const auto& own : sites_) {
      sites.erase(own);
    }
    for (const Path prim : prims) {
      found_.prims[prim].insert(sites.begin(), sites.end());
    }
    found_.sites.merge(sites);
  }

  void add_implied(const Place& place, std::vector<Place>& open) const {
    const compose::Nodes nodes = index_->nodes();
    const Path at = nodes[place.node].path.strip_variants();
    if (!is_class(nodes[place.node].arc) || !place.path.has_prefix(at)) {
      return;
    }
    for (std::uint32_t id = 1; id < nodes.size(); ++id) {
      if (nodes[id].origin == place.node && nodes[id].parent != place.node) {
        open.push_back({id, place.path.replace_prefix(at, nodes[id].path.strip_variants())});
      }
    }
  }

  static void add_sites(const LayerStack& stack, Path path, std::set<Dependents::Site>& sites) {
    for (std::string& layer : layers_of(stack)) {
      sites.emplace(std::move(layer), path);
    }
  }

  /// Below an instance each proxy is a prim of its own, though composed once.
  void add_prims(Path path, std::vector<Path>& prims, std::set<Dependents::Site>& sites) const {
    prims.push_back(path);
    if (prim_ != index_->path && path.has_prefix(index_->path)) {
      const Path proxy = path.replace_prefix(index_->path, prim_);
      prims.push_back(proxy);
      add_sites(stage_.layer_stack(), proxy, sites);
    }
  }

  /// Within one layer stack an arc names the path in a layer that is a site itself.
  void note_arc(const Node& node, const Node& parent, Path prim) {
    const bool names_file = node.arc == ArcKind::Reference || node.arc == ArcKind::Payload;
    const Path from = parent.path.strip_variants();
    const std::set<Path>& gone = sites_in(*parent.layer_stack);
    const bool goes_too =
        std::any_of(gone.begin(), gone.end(), [&](Path site) { return from.has_prefix(site); });
    if (names_file && !goes_too && node.layer_stack != parent.layer_stack &&
        arcs_.emplace(parent.layer_stack, from, node.path).second) {
      found_.arcs.push_back({layers_of(*parent.layer_stack), from, node.layer_stack->identifier(),
                             node.path.strip_variants(), prim});
    }
  }

  static std::vector<std::string> layers_of(const LayerStack& stack) {
    std::vector<std::string> layers;
    for (const compose::StackedLayer& stacked : stack.layers) {
      if (stacked.layer != stack.session) {
        layers.push_back(stacked.layer->identifier());
      }
    }
    return layers;
  }

  const Stage& stage_;
  const std::map<std::string, Path>& sites_;
  bool of_name_;
  Dependents found_;
  std::unordered_map<const LayerStack*, std::set<Path>> in_stack_;
  std::set<std::tuple<const LayerStack*, Path, Path>> arcs_;  // noted
  const compose::PrimIndex* index_ = nullptr;                 // that is looked at,
  Path prim_;                                                 // and of which prim
};

}  // namespace

Dependents dependents_of(const Stage& stage, const std::map<std::string, Path>& sites,
                         DependentOn what) {
  return DependentSearch(stage, sites, what).search();
}

}  // namespace tenon::stage
