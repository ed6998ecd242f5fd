// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// Names of children and properties: from weak to strong, each layer adds its names and reorders all
// that are there so far. Relocates rename, remove and add children on the way.
#include "tenon/compose/child_names.h"

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

/// Distinct names that more are added to; many of them with an index. As long as they are those of
/// one spec they are not copied: that is where most lists end.
class GrowingNames {
 public:
  bool has(Token name) {
    if (lender_ != nullptr && names().size() > kUnindexed) {
      own();
    }
    return indexed_ ? index_.count(name) != 0
                    : std::find(names().begin(), names().end(), name) != names().end();
  }

  bool add(Token name) {
    if (has(name)) {
      return false;
    }
    own();
    names_.push_back(name);
    if (indexed_) {
      index_.insert(name);
    } else if (names_.size() > kUnindexed) {
      reindex();
    }
    return true;
  }

  /// What `spec` lists in `field`, no name twice.
  void add_all(const layer::Spec& spec, Token field) {
    const std::vector<Token>& more = layer::Layer::children(spec, field);
    if (names().empty() && !more.empty()) {
      lender_ = &spec;
      lent_ = &more;
      field_ = field;
      return;
    }
    for (const Token name : more) {
      add(name);
    }
  }

  void replace(std::vector<Token> names) {
    lender_ = nullptr;
    names_ = std::move(names);
    index_.clear();
    indexed_ = false;
    if (names_.size() > kUnindexed) {
      reindex();
    }
  }

  /// The same names in another order.
  void reorder(const std::vector<Token>& order) {
    own();
    layer::ListOp<Token>::reorder(names_, order);
  }

  const std::vector<Token>& names() const { return lender_ == nullptr ? names_ : *lent_; }
  std::vector<Token> take() {
    own();
    return std::move(names_);
  }
  NameList take_list() {
    return lender_ == nullptr ? NameList(std::move(names_)) : NameList(*lender_, field_);
  }

 private:
  static constexpr std::size_t kUnindexed = 16;

  void own() {
    if (lender_ != nullptr) {
      replace(*lent_);
    }
  }

  void reindex() {
    index_.clear();
    index_.insert(names_.begin(), names_.end());
    indexed_ = true;
  }

  std::vector<Token> names_;
  const layer::Spec* lender_ = nullptr;       // whose names they are, where they are all one spec's
  const std::vector<Token>* lent_ = nullptr;  // these
  Token field_;
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

bool is_in_culled_subtree(const PrimIndex& index, std::uint32_t id) {
  for (; id != kNoNode; id = index.nodes()[id].parent) {
    if (index.nodes()[id].culled) {
      return true;
    }
  }
  return false;
}

/// Opinions of one node, which stand together.
using NodeOpinions = std::span<const Opinion>;

/// Visits the nodes weakest first, as their names combine: a finished index has them strongest
/// first, and its opinions in their order.
template <class Visit>
void visit_weak_to_strong(const PrimIndex& index, const Visit& visit) {
  const Opinions opinions = index.opinions();
  std::size_t end = opinions.size();
  for (auto id = static_cast<std::uint32_t>(index.nodes().size()); id-- > 0;) {
    std::size_t begin = end;
    while (begin > 0 && opinions[begin - 1].node == id) {
      --begin;
    }
    if (!is_in_culled_subtree(index, id)) {
      visit(index.nodes()[id], NodeOpinions(opinions.data() + begin, end - begin));
    }
    end = begin;
  }
}

void add_names(NodeOpinions opinions, Token names_field, const Token* order_field,
               GrowingNames& list) {
  for (std::size_t i = opinions.size(); i-- > 0;) {
    const layer::Spec& spec = *opinions[i].spec;
    list.add_all(spec, names_field);
    if (order_field != nullptr) {
      const std::vector<Token>& order = layer::Layer::children(spec, *order_field);
      if (!order.empty()) {
        list.reorder(order);
      }
    }
  }
}

}  // namespace

void compose_child_names(PrimIndex& index) {
  GrowingNames list;
  std::set<Token> prohibited;
  visit_weak_to_strong(index, [&](const Node& node, NodeOpinions opinions) {
    if (!node.can_contribute() || (index.instanceable && !is_shareable(node))) {
      return;
    }
    if (node.layer_stack->has_relocates()) {
      apply_relocates(*node.layer_stack, node.path, list, prohibited);
    }
    add_names(opinions, fields::primChildren, &fields::primOrder, list);
  });
  if (prohibited.empty()) {
    index.child_names = list.take_list();
    return;
  }
  std::vector<Token> names = list.take();
  std::erase_if(names, [&](Token name) { return prohibited.count(name) != 0; });
  index.make_extras().prohibited_child_names.assign(prohibited.begin(), prohibited.end());
  index.child_names = NameList(std::move(names));
}

void compose_property_names(PrimIndex& index) {
  GrowingNames list;
  visit_weak_to_strong(index, [&](const Node&, NodeOpinions opinions) {
    add_names(opinions, fields::properties, nullptr, list);
  });
  index.set_property_names(list.take_list());
}

}  // namespace tenon::compose
