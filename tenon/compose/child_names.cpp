// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// Names of children and properties: from weak to strong, each layer adds its names and reorders all
// that are there so far. Relocates rename, remove and add children on the way.
#include <algorithm>
#include <map>
#include <set>
#include <span>
#include <unordered_set>

#include "tenon/compose/indexer.h"
#include "tenon/layer/field_values.h"
#include "tenon/layer/fields.h"

namespace tenon::compose {
namespace {

namespace fields = layer::fields;

/// Distinct names that more are added to; many of them with an index.
class GrowingNames {
 public:
  bool has(Token name) const {
    return indexed_ ? index_.count(name) != 0
                    : std::find(names_.begin(), names_.end(), name) != names_.end();
  }

  bool add(Token name) {
    if (has(name)) {
      return false;
    }
    names_.push_back(name);
    if (indexed_) {
      index_.insert(name);
    } else if (names_.size() > kUnindexed) {
      reindex();
    }
    return true;
  }

  void add_all(const std::vector<Token>& names) {
    if (names_.empty()) {
      names_ = names;  // a layer lists no name twice
      if (names_.size() > kUnindexed) {
        reindex();
      }
      return;
    }
    for (const Token name : names) {
      add(name);
    }
  }

  void replace(std::vector<Token> names) {
    names_ = std::move(names);
    index_.clear();
    indexed_ = false;
    if (names_.size() > kUnindexed) {
      reindex();
    }
  }

  /// The same names in another order.
  void reorder(const std::vector<Token>& order) { layer::ListOp<Token>::reorder(names_, order); }

  const std::vector<Token>& names() const { return names_; }
  std::vector<Token> take() { return std::move(names_); }

 private:
  static constexpr std::size_t kUnindexed = 16;

  void reindex() {
    index_.clear();
    index_.insert(names_.begin(), names_.end());
    indexed_ = true;
  }

  std::vector<Token> names_;
  std::unordered_set<Token> index_;
  bool indexed_ = false;
};

/// What the relocates of one stack do to the children of one prim.
struct RelocatedChildren {
  std::map<Token, Token> renamed;
  std::set<Token> removed;
  std::set<Token> added;
};

/// Calls `visit` with both paths of each pair whose first path is a child of `path`; the pairs are
/// sorted, so what is at and below a path stands together.
template <class Visit>
void visit_children(const MapFunction::Pairs& pairs, Path path, const Visit& visit) {
  auto pair =
      std::lower_bound(pairs.begin(), pairs.end(), path,
                       [](const MapFunction::Pair& at, Path wanted) { return at.first < wanted; });
  for (; pair != pairs.end() && pair->first.has_prefix(path); ++pair) {
    if (pair->first.parent() == path) {
      visit(pair->first, pair->second);
    }
  }
}

RelocatedChildren relocated_children(const LayerStack& stack, Path path,
                                     std::set<Token>& prohibited) {
  RelocatedChildren result;
  visit_children(stack.relocates, path, [&](Path source, Path target) {
    prohibited.insert(source.name());
    if (!target.empty() && target.parent() == path) {
      result.renamed.emplace(source.name(), target.name());
    } else {
      result.removed.insert(source.name());
    }
  });
  visit_children(stack.relocates_by_target, path, [&](Path target, Path source) {
    if (source.parent() != path) {
      result.added.insert(target.name());
    }
  });
  return result;
}

void apply_relocates(const LayerStack& stack, Path path, GrowingNames& list,
                     std::set<Token>& prohibited) {
  RelocatedChildren relocated = relocated_children(stack, path, prohibited);
  std::erase_if(relocated.added, [&](Token name) { return list.has(name); });
  if (!relocated.renamed.empty() || !relocated.removed.empty()) {
    GrowingNames left;
    std::set<Token> still_there(list.names().begin(), list.names().end());
    for (const Token name : list.names()) {
      const auto renamed = relocated.renamed.find(name);
      if (renamed != relocated.renamed.end()) {
        still_there.erase(name);
        if (still_there.insert(renamed->second).second) {
          left.add(renamed->second);
        }
      } else if (relocated.removed.count(name) != 0) {
        still_there.erase(name);
      } else {
        left.add(name);
      }
    }
    list.replace(left.take());
  }
  for (const Token name : relocated.added) {
    list.add(name);
  }
}

/// Specs of one node within the opinions, which stand together.
struct NodeOpinions {
  std::size_t begin = 0;
  std::size_t end = 0;
};

std::vector<NodeOpinions> opinions_by_node(const PrimIndex& index) {
  std::vector<NodeOpinions> result(index.nodes.size());
  for (std::size_t i = 0; i < index.opinions.size(); ++i) {
    NodeOpinions& range = result[index.opinions[i].node];
    if (range.end == 0) {
      range.begin = i;
    }
    range.end = i + 1;
  }
  return result;
}

void add_names(const PrimIndex& index, const NodeOpinions& range, Token names_field,
               const Token* order_field, GrowingNames& list) {
  for (std::size_t i = range.end; i-- > range.begin;) {
    const layer::Spec& spec = *index.opinions[i].spec;
    list.add_all(layer::Layer::children(spec, names_field));
    if (order_field != nullptr) {
      const std::vector<Token>& order = layer::Layer::children(spec, *order_field);
      if (!order.empty()) {
        list.reorder(order);
      }
    }
  }
}

/// Nodes weakest first as their names combine: children before what they are below.
std::vector<std::uint32_t> weak_to_strong(std::span<const Node> nodes) {
  std::vector<std::uint32_t> order;
  order.reserve(nodes.size());
  struct Open {
    std::uint32_t node;
    bool expanded;
  };
  std::vector<Open> open{{0, false}};
  while (!open.empty()) {
    Open& at = open.back();
    if (at.expanded) {
      order.push_back(at.node);
      open.pop_back();
      continue;
    }
    at.expanded = true;
    for (std::uint32_t child = nodes[at.node].first_child; child != kNoNode;
         child = nodes[child].next_sibling) {
      open.push_back({child, false});
    }
  }
  return order;
}

bool is_in_culled_subtree(std::span<const Node> nodes, std::uint32_t id) {
  for (; id != kNoNode; id = nodes[id].parent) {
    if (nodes[id].culled) {
      return true;
    }
  }
  return false;
}

}  // namespace

void compose_child_names(PrimIndex& index) {
  const std::vector<NodeOpinions> opinions = opinions_by_node(index);
  GrowingNames list;
  std::set<Token> prohibited;
  for (const std::uint32_t id : weak_to_strong(index.nodes)) {
    const Node& node = index.nodes[id];
    if (!node.can_contribute() || (index.instanceable && !is_shareable(node)) ||
        is_in_culled_subtree(index.nodes, id)) {
      continue;
    }
    if (node.layer_stack->has_relocates()) {
      apply_relocates(*node.layer_stack, node.path, list, prohibited);
    }
    add_names(index, opinions[id], fields::primChildren, &fields::primOrder, list);
  }
  std::vector<Token> names = list.take();
  if (!prohibited.empty()) {
    std::erase_if(names, [&](Token name) { return prohibited.count(name) != 0; });
    index.make_extras().prohibited_child_names.assign(prohibited.begin(), prohibited.end());
  }
  index.child_names = NameList(std::move(names));
}

void compose_property_names(PrimIndex& index) {
  const std::vector<NodeOpinions> opinions = opinions_by_node(index);
  GrowingNames list;
  for (const std::uint32_t id : weak_to_strong(index.nodes)) {
    if (opinions[id].end != 0 && !is_in_culled_subtree(index.nodes, id)) {
      add_names(index, opinions[id], fields::properties, nullptr, list);
    }
  }
  index.property_names = NameList(list.take());
}

}  // namespace tenon::compose
