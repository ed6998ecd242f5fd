// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "tenon/base/containers/index_iterator.h"
#include "tenon/base/containers/short_list.h"
#include "tenon/base/diagnostics.h"
#include "tenon/base/path.h"
#include "tenon/compose/arcs/arc.h"
#include "tenon/compose/containers/like_or_many.h"
#include "tenon/compose/layer_stack.h"
#include "tenon/compose/maps/map_function.h"
#include "tenon/layer/shared_contents.h"

namespace tenon::compose {

inline constexpr std::uint32_t kNoNode = 0xFFFFFFFFu;

/// One site (layer stack and path) that contributes to a prim, and the arc that brought it in.
/// Stacks and maps belong to the cache and live as long as it.
struct Node {
  const LayerStack* layer_stack = nullptr;
  Path path;  ///< in the namespace of layer_stack, variant selections included
  const MapFunction* map_to_parent = nullptr;
  const MapFunction* map_to_root = nullptr;  ///< from this node's namespace and time to the stage's
  std::uint32_t parent = kNoNode;
  std::uint32_t origin =
      kNoNode;  ///< the node that caused this one; not the parent for implied arcs
  std::uint32_t first_child = kNoNode;  ///< the strongest; follow next_sibling
  std::uint32_t last_child = kNoNode;
  std::uint32_t next_sibling = kNoNode;
  std::uint32_t previous_sibling = kNoNode;
  std::uint16_t namespace_depth = 0;  ///< depth of the parent node's path when the arc was added
  std::uint16_t sibling_number = 0;   ///< order among arcs of one kind at one site
  std::uint16_t restriction_depth =
      0;                         ///< contributes only above this depth of its path; 0: everywhere
  std::uint16_t arcs_above = 0;  ///< to the root node of the index
  ArcKind arc = ArcKind::Root;
  bool inert = false;            ///< kept for structure, contributes no opinions
  bool culled = false;           ///< neither it nor anything below it contributes opinions
  bool has_specs = false;        ///< some layer of the stack has a prim spec at `path`
  bool due_to_ancestor = false;  ///< the arc was introduced by a namespace ancestor
  /// Brought in by an arc of this prim: by its own arc or with the index that an arc above leads
  /// to.
  bool due_to_direct_arc = false;

  bool operator==(const Node&) const = default;
  bool can_contribute() const { return !inert && !culled; }
  bool has_opinions() const { return has_specs && can_contribute(); }
  bool same_site(const Node& other) const {
    return layer_stack == other.layer_stack && path == other.path;
  }
};

/// One layer's spec of a prim within an index.
struct Opinion {
  const layer::Layer* layer = nullptr;
  const layer::Spec* spec = nullptr;
  Path path;                  ///< of the spec in that layer
  std::uint32_t node = 0;     ///< into PrimIndex::nodes
  std::uint32_t number = 0;   ///< of the spec, as the layer counts (Layer::number_of)
  layer::LayerOffset offset;  ///< stage time = offset(layer time)

  bool operator==(const Opinion&) const = default;
  static Opinion of(std::uint32_t id, const Node& node, const StackedLayer& stacked,
                    std::uint32_t number) {
    return {stacked.layer.get(),
            &stacked.layer->numbered_spec(number),
            node.path,
            id,
            number,
            node.map_to_root->offset() * stacked.offset};
  }
};

/// Opinions while they are gathered.
using OpinionDraft = ShortList<Opinion, 8>;

/// The nodes of an index, for as long as it is there. They come as copies.
class Nodes {
 public:
  using Iterator = IndexIterator<Nodes, Node, Node>;

  Nodes(const LikeOrMany<Node>& kept, Path prim) : kept_(&kept), prim_(prim) {}

  std::size_t size() const { return kept_->size(); }
  bool empty() const { return kept_->empty(); }
  Node operator[](std::size_t at) const {
    const Node* const like = kept_->like();
    if (like == nullptr) {
      return kept_->own()[at];
    }
    Node node = *like;
    node.path = prim_;
    return node;
  }
  Node front() const { return (*this)[0]; }
  Iterator begin() const { return {this, 0}; }
  Iterator end() const { return {this, size()}; }

 private:
  const LikeOrMany<Node>* kept_;
  Path prim_;
};

/// The opinions of an index, for as long as this and it are there.
class Opinions {
 public:
  explicit Opinions(std::span<const Opinion> many) : size_(many.size()), many_(many.data()) {}
  explicit Opinions(const Opinion& one) : size_(1), one_(one) {}

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  const Opinion* data() const& { return many_ == nullptr ? &one_ : many_; }
  const Opinion* begin() const& { return data(); }
  const Opinion* end() const& { return data() + size_; }
  const Opinion& operator[](std::size_t at) const& { return data()[at]; }
  const Opinion& front() const& { return data()[0]; }
  // What is about to go gives copies.
  Opinion operator[](std::size_t at) const&& { return data()[at]; }
  Opinion front() const&& { return data()[0]; }
  const Opinion* data() const&& = delete;
  const Opinion* begin() const&& = delete;
  const Opinion* end() const&& = delete;

 private:
  std::size_t size_;
  const Opinion* many_ = nullptr;
  Opinion one_;  // where there are not many
};

/// Names in order, each once. Those that one spec lists are shared with it and stay as they are
/// while its layer is edited. The size of one pointer.
class NameList {
 public:
  NameList() = default;
  explicit NameList(std::vector<Token> names) {
    if (!names.empty()) {
      names_ = Shared(layer::Value(std::move(names)));
    }
  }
  /// What `spec` lists in the field `names`.
  NameList(const layer::Spec& spec, Token names) {
    if (const layer::Value* const value = spec.find(names)) {
      names_ = Shared(*value);
    }
  }

  const std::vector<Token>& list() const {
    static const std::vector<Token> none;
    const std::vector<Token>* const names = names_.get();
    return names == nullptr ? none : *names;
  }
  std::size_t size() const { return names_.get() == nullptr ? 0 : names_.get()->size(); }
  bool empty() const { return size() == 0; }
  const Token* begin() const { return names_.get() == nullptr ? nullptr : names_.get()->data(); }
  const Token* end() const { return begin() + size(); }

 private:
  using Shared = layer::SharedContents<std::vector<Token>>;
  Shared names_;
};

/// What was found out about few prims.
struct IndexExtras {
  std::vector<Token> prohibited_child_names;  ///< relocated away; sorted
  /// Selections in force: the variant whose opinions contribute.
  std::map<std::string, std::string> variant_selections;
  /// Equal for prims that share a prototype; empty when not instanceable.
  std::string instance_key;
  Diagnostics errors;  ///< rule = "compose.<class>", see composition_error.h
};

/// Everything that composition found out about one prim. There are as many as prims: that of a prim
/// without arcs in one layer lies in one piece of memory.
struct PrimIndex {
  Path path;
  LikeOrMany<Node> kept_nodes;        ///< see nodes()
  LikeOrMany<Opinion> kept_opinions;  ///< see opinions()
  NameList child_names;               ///< composed, ordered, prohibited names removed
  NameList property_names;  ///< authored ones; weakest specs first, propertyOrder not applied
  std::unique_ptr<IndexExtras> own_extras;  ///< where there are any
  std::uint32_t only_number = 0;            ///< Opinion::number of the only opinion
  std::uint32_t name_marks = 0;             ///< a bit for each of property_names, which many share
  bool has_payloads : 1 = false;            ///< some payload arc is authored
  bool payload_loaded : 1 = false;          ///< and included under the load rules
  bool instanceable : 1 = false;            ///< an instance: some arc, and instanceable = true

  /// Strongest first; node 0 is the root, whose path is that of the prim.
  Nodes nodes() const { return {kept_nodes, path}; }
  /// A node where it is kept; its path does not count.
  const Node& node_shape(std::uint32_t node) const {
    const Node* const like = kept_nodes.like();
    return like == nullptr ? kept_nodes.own()[node] : *like;
  }
  /// Prim specs, strongest first.
  Opinions opinions() const {
    const Opinion* const like = kept_opinions.like();
    return like == nullptr ? Opinions(kept_opinions.own()) : Opinions(only_opinion(*like));
  }
  /// Where there is one, it equals `like` except for its spec and place, see MapPool::like.
  void set_opinions(std::span<const Opinion> found, const Opinion* like) {
    if (found.size() == 1) {
      kept_opinions.be_like(*like);
      only_number = found.front().number;
    } else {
      kept_opinions.assign(found);
    }
  }
  void copy_opinions(const PrimIndex& other) {
    set_opinions(other.opinions(), other.kept_opinions.like());
  }

  const IndexExtras& extras() const {
    static const IndexExtras none;
    return own_extras == nullptr ? none : *own_extras;
  }
  IndexExtras& make_extras() {
    if (own_extras == nullptr) {
      own_extras = std::make_unique<IndexExtras>();
    }
    return *own_extras;
  }

  void set_property_names(NameList names) {
    property_names = std::move(names);
    name_marks = 0;
    for (const Token name : property_names) {
      name_marks |= mark_of(name);
    }
  }

  /// Some opinion has a property of that name.
  bool has_property(Token name) const {
    return std::find(property_names.begin(), property_names.end(), name) != property_names.end();
  }
  /// False where that is quickly known, as most properties that schemas declare are in no layer:
  /// names without a mark are not listed, and a short list is searched faster than a path is made
  /// for each opinion. A long one is not searched.
  bool may_have_property(Token name) const {
    return (name_marks & mark_of(name)) != 0 && (!names_are_few() || has_property(name));
  }
  /// Calls `visit(opinion)` for each opinion on the property, strongest first, until it returns
  /// true. Its path and spec are those of the property, all else is as of that on the prim.
  template <class Visit>
  void visit_property(Token name, Visit visit) const {
    if ((name_marks & mark_of(name)) == 0) {
      return;
    }
    if (names_are_few()) {
      const Token* const listed = std::find(property_names.begin(), property_names.end(), name);
      if (listed == property_names.end()) {
        return;
      }
      if (const Opinion* const like = kept_opinions.like()) {
        const auto* const guess = like->layer->guess_property(
            only_number, static_cast<std::size_t>(listed - property_names.begin()),
            only_path(*like).property(name));
        if (guess != nullptr) {
          visit(on_property(*like, *guess));
          return;
        }
      }
    }
    for (const Opinion& opinion : opinions()) {
      const auto* const entry = opinion.layer->find_property(*opinion.spec, opinion.path, name);
      if (entry != nullptr && visit(on_property(opinion, *entry))) {
        return;
      }
    }
  }
  bool names_are_few() const { return property_names.size() <= layer::Layer::kShortList; }
  static std::uint32_t mark_of(Token name) { return 1u << (name.number() % 32); }

  /// `path` of node's namespace in the stage's; empty when it has no image.
  Path map_to_root(std::uint32_t node, Path path_in_node) const {
    return node_shape(node).map_to_root->map_source_to_target(path_in_node.strip_variants());
  }
  /// Stage time of a time in the node's layer stack (its root layer).
  const layer::LayerOffset& node_offset(std::uint32_t node) const {
    return node_shape(node).map_to_root->offset();
  }

 private:
  Path only_path(const Opinion& like) const {
    return kept_nodes.like() != nullptr ? path : kept_nodes.own()[like.node].path;
  }
  Opinion only_opinion(const Opinion& like) const {
    Opinion only = like;
    only.spec = &like.layer->numbered_spec(only_number);
    only.path = only_path(like);
    only.number = only_number;
    return only;
  }
  static Opinion on_property(const Opinion& opinion, const layer::Layer::Entry& property) {
    Opinion result = opinion;
    result.spec = &property.spec;
    result.path = property.path;
    return result;
  }
};

}  // namespace tenon::compose
