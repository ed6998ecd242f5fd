// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A prim index is a function of the index above it, of the options and of what layer stacks say at
// the sites that were looked at on the way. Two siblings are twins when their indices are equal
// except for their own names and their specs say the same about arcs. What was composed of a prim
// below one of them holds below the other, with the name changed, if the root stack says nothing at
// the sites below either of them. Nothing in composition depends on what a name is, only on which
// names are equal; so the name of a twin may be another as long as it is met nowhere else: in no
// site beside the twins, and in no path that an arc names.
//
// Twins have one parent, so what is above them is the same. Findings, and arcs of which there are
// too many to follow, are never taken over. Work counts as if each prim had been composed: bounds
// do not depend on who came first.
#include "tenon/compose/twins/twins.h"

#include <algorithm>

namespace tenon::compose {
namespace {

constexpr std::size_t kMostFamilies = 16;  // of siblings, which each new one is compared with
constexpr std::size_t kMostTries = 4;      // to keep what is composed of a child of twins
constexpr std::size_t kMostLooks = 256;    // of one prim, more are not kept

bool may_have_twins(const PrimIndex& index) {
  const auto relocates = [](const Node& node) { return node.layer_stack->has_relocates(); };
  return index.nodes().size() > 1 && !index.instanceable && index.extras().errors.empty() &&
         std::ranges::none_of(index.nodes(), relocates);
}

bool are_twins(const LayerStack& root_stack, const PrimIndex& a, const PrimIndex& b) {
  return a.has_payloads == b.has_payloads && a.payload_loaded == b.payload_loaded &&
         Renaming(root_stack, a.path, b.path).leads_to(a.kept_nodes.own(), b.kept_nodes.own()) &&
         author_equal_arcs(root_stack, a.path, b.path);
}

/// The prim `depth` levels above.
Path above(Path path, std::size_t depth) {
  for (; depth > 0; --depth) {
    path = path.parent();
  }
  return path;
}

bool has_element(Path path, Token name) {
  for (; !path.empty(); path = path.parent()) {
    if (path.name() == name) {
      return true;
    }
  }
  return false;
}

/// Layer stacks are made for the prim that needs them first.
std::size_t work_of_prims(const WorkMeter& work) { return work.done() - work.once(); }

/// Payloads that are loaded by name tell twins apart.
bool has_load_rules(const ComposeOptions& options) {
  return !options.loaded.empty() || !options.loaded_alone.empty() || !options.unloaded.empty();
}

}  // namespace

Twins::Composed* Twins::composed_of(const PrimIndex& index) const {
  Composed* const* const found = composed_of_.find(index.path);
  return found == nullptr ? nullptr : *found;
}

bool Twins::take_over(const IndexServices& services, const PrimIndex& parent, PrimIndex& index) {
  const Composed* const parent_composed = composed_of(parent);
  if (parent_composed == nullptr) {
    return false;
  }
  const auto found = parent_composed->children.find(index.path.name());
  if (found == parent_composed->children.end() || found->second.composed == nullptr ||
      found->second.composed->index == nullptr) {
    return false;
  }
  Composed& composed = *found->second.composed;
  const WorkMeter& work = *services.work;
  const Path twin = above(index.path, composed.depth);
  if (renaming_.from() != composed.top || renaming_.to() != twin) {
    renaming_ = Renaming(*services.root_stack, composed.top, twin);
  }
  if (*services.node_count + composed.node_count >= services.options->max_nodes ||
      work.done() + composed.work >= work.most() || !says_the_same(services, composed)) {
    return false;
  }
  copy_to(services, composed, index);
  composed_of_[index.path] = &composed;
  return true;
}

void Twins::compose(const IndexServices& services, const PrimIndex& parent, PrimIndex& index,
                    Build build) {
  last_ = nullptr;
  Composed* const parent_composed = composed_of(parent);
  if (parent_composed == nullptr) {
    build(services, parent, index);
    return note_sibling(services, index);
  }
  Child& child = parent_composed->children[index.path.name()];
  if (child.refused >= kMostTries) {
    return build(services, parent, index);
  }
  Composed composed;
  composed.depth = parent_composed->depth + 1;
  composed.top = above(index.path, composed.depth);
  const std::size_t nodes_before = *services.node_count;
  const std::size_t work_before = work_of_prims(*services.work);
  SiteTrace trace;
  build(services, parent, index);
  const std::vector<SiteTrace::Look> looks = trace.end();
  if (!may_be_kept(services, index) || !keep_looks(services, looks, composed)) {
    ++child.refused;
    return;
  }
  composed.index = &index;
  composed.node_count = *services.node_count - nodes_before;
  composed.work = work_of_prims(*services.work) - work_before;
  composed.costs = services.work->costs();
  last_ = &all_composed_.emplace_back(std::move(composed));
  composed_of_[index.path] = last_;
  if (child.composed == nullptr || child.composed->index == nullptr) {
    child.composed = last_;
  }
}

void Twins::forget_last() {
  if (last_ != nullptr) {
    last_->index = nullptr;
    last_ = nullptr;
  }
  candidates_.clear();
}

void Twins::note_sibling(const IndexServices& services, const PrimIndex& index) {
  if (!may_have_twins(index) || has_load_rules(*services.options)) {
    return;
  }
  if (index.path.parent() != parent_) {
    parent_ = index.path.parent();
    candidates_.clear();
  }
  for (Family* const family : candidates_) {
    if (are_twins(*services.root_stack, *family->first, index)) {
      composed_of_[family->first->path] = &family->top;
      composed_of_[index.path] = &family->top;
      return;
    }
  }
  if (candidates_.size() < kMostFamilies) {
    families_.emplace_back().first = &index;
    candidates_.push_back(&families_.back());
  }
}

bool Twins::may_be_kept(const IndexServices& services, const PrimIndex& index) {
  const auto has_few_pairs = [](const Node& node) {  // maps of many are made once
    return node.map_to_parent->pairs().size() <= kFewPairs &&
           node.map_to_root->pairs().size() <= kFewPairs;
  };
  return std::ranges::all_of(index.nodes(), has_few_pairs) && index.extras().errors.empty() &&
         index.extras().prohibited_child_names.empty() && !services.work->exhausted() &&
         *services.node_count < services.options->max_nodes;
}

/// False where something below the twin is of this twin alone, or could be taken for it.
bool Twins::keep_looks(const IndexServices& services, const std::vector<SiteTrace::Look>& looks,
                       Composed& composed) {
  if (looks.size() > kMostLooks) {
    return false;
  }
  const SiteTrace::Look top{services.root_stack, composed.top};
  for (auto look = looks.begin(); look != looks.end(); ++look) {
    if (std::find(looks.begin(), look, *look) != look) {
      continue;
    }
    const bool is_below = look->path.has_prefix(composed.top);
    if (look->stack->has_relocates() ||
        (is_below && *look != top &&
         (look->stack != services.root_stack || look->stack->has_spec(look->path)))) {
      return false;
    }
    if (*look != top) {
      (is_below ? composed.below : composed.beside).push_back(look->path);
    }
    // A path into a twin means the same prim in all of them.
    add_named_prims(*look->stack, look->path, composed.beside);
  }
  return std::none_of(composed.beside.begin(), composed.beside.end(),
                      [&](Path path) { return has_element(path, composed.top.name()); });
}

bool Twins::says_the_same(const IndexServices& services, const Composed& composed) const {
  return std::none_of(composed.beside.begin(), composed.beside.end(),
                      [&](Path path) { return has_element(path, renaming_.to().name()); }) &&
         std::none_of(composed.below.begin(), composed.below.end(), [&](Path path) {
           return services.root_stack->has_spec(renaming_.renamed(path));
         });
}

void Twins::copy_to(const IndexServices& services, const Composed& composed, PrimIndex& index) {
  const PrimIndex& twin = *composed.index;
  if (twin.kept_nodes.like() != nullptr) {
    Node node = twin.nodes().front();
    renaming_.rename({&node, 1}, *services.maps);
    index.kept_nodes.be_like(*services.maps->like(node));
  } else {
    index.kept_nodes.assign(twin.kept_nodes.own());
    renaming_.rename(index.kept_nodes.own(), *services.maps);
  }
  index.copy_opinions(twin);
  index.child_names = twin.child_names;
  index.property_names = twin.property_names;
  index.name_marks = twin.name_marks;
  if (twin.own_extras != nullptr) {
    index.make_extras() = *twin.own_extras;
  }
  index.has_payloads = twin.has_payloads;
  index.payload_loaded = twin.payload_loaded;
  index.instanceable = twin.instanceable;
  *services.node_count += composed.node_count;
  services.work->count(composed.work);
  for (ArcCost cost : composed.costs) {
    cost.place.path = renaming_.renamed(cost.place.layer_stack, cost.place.path);
    services.work->add_cost(cost);
  }
}

}  // namespace tenon::compose
