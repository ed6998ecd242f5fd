// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// Paths are hash-consed: each element is a node that is stored once, found by its parent and its
// own words. Nodes are never freed, so a path is one pointer and comparisons need no text.
#include "tenon/base/path.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cstddef>
#include <limits>
#include <memory>
#include <mutex>
#include <new>

#include "tenon/base/assert.h"
#include "tenon/base/containers/short_list.h"

namespace tenon {
namespace {

// 64 bits on every machine: shards, tags and slots each take some of them.
std::uint64_t mix(std::uint64_t seed, const void* pointer) {
  const std::uint64_t bits = reinterpret_cast<std::uintptr_t>(pointer) >> 4;
  return (seed ^ bits) * 0x9E3779B97F4A7C15ull + (seed >> 29);
}

/// Tells details of elements of one kind apart.
const void* id_of(PathNode::Detail detail) { return std::bit_cast<const void*>(detail); }

std::uint64_t hash_of(const PathNode& node) {
  std::uint64_t hash = mix(static_cast<std::size_t>(node.kind) + 1, node.parent);
  hash = mix(hash, node.name.id());
  return mix(hash, id_of(node.detail));
}

bool same(const PathNode& a, const PathNode& b) {
  return a.parent == b.parent && a.kind == b.kind && a.name == b.name &&
         id_of(a.detail) == id_of(b.detail);
}

/// Nodes in the order in which they were made, where their address tells which chunk they are in.
/// Others may read those that are counted while one more is added.
class NodeChunk {
 public:
  static constexpr std::size_t kSize = std::size_t{1} << 14;
  static constexpr std::size_t kNodes = (kSize - 64) / sizeof(PathNode);

  const PathNode* add(const PathNode& node) {
    const std::uint32_t index = count_.load(std::memory_order_relaxed);
    const PathNode* added = ::new (nodes() + index) PathNode(node);
    count_.store(index + 1, std::memory_order_release);
    return added;
  }
  const PathNode& operator[](std::size_t index) { return *std::launder(nodes() + index); }

  /// The node made after `node`; nullptr when it is in another chunk or not there.
  static const PathNode* next_of(const PathNode* node) {
    const auto address = reinterpret_cast<std::uintptr_t>(node);
    // NOLINTNEXTLINE(performance-no-int-to-ptr): chunks lie at multiples of their size.
    auto* chunk = reinterpret_cast<NodeChunk*>(address & ~(kSize - 1));
    const PathNode* next = node + 1;
    const PathNode* end = chunk->nodes() + chunk->count_.load(std::memory_order_acquire);
    return next < end ? next : nullptr;
  }

 private:
  PathNode* nodes() { return reinterpret_cast<PathNode*>(storage_); }

  alignas(kSize) std::atomic<std::uint32_t> count_ = 0;
  alignas(64) std::byte storage_[kNodes * sizeof(PathNode)];  // no node on two lines of a cache
};
static_assert(sizeof(NodeChunk) == NodeChunk::kSize);

/// Numbers for the nodes that this thread makes: it takes many at once, so that those made one
/// after another are neighbours whatever other threads do.
std::uint32_t next_number() {
  constexpr std::uint32_t kRange = 256;
  static std::atomic<std::uint32_t> taken = 0;
  thread_local std::uint32_t last = 0;
  if (last % kRange == 0) {
    last = taken.fetch_add(kRange, std::memory_order_relaxed);
  }
  return ++last;
}

/// Open addressing over nodes in stable storage. A slot is part of the hash and the number of a
/// node, so that most others are told apart without a look at them.
class NodeTable {
 public:
  const PathNode* intern(const PathNode& node, std::uint64_t hash) {
    const std::lock_guard lock(mutex_);
    if (4 * (count_ + 1) > 3 * slots_.size()) {
      grow();
    }
    const std::uint32_t tag = tag_of(hash);
    std::size_t at = slot_of(hash);
    while (slots_[at].number != 0) {
      if (slots_[at].tag == tag && same(node_at(slots_[at].number - 1), node)) {
        return &node_at(slots_[at].number - 1);
      }
      at = (at + 1) & (slots_.size() - 1);
    }
    return add(node, at, tag);
  }

 private:
  struct Slot {
    std::uint32_t tag = 0;
    std::uint32_t number = 0;  // of the node, from 1 on; 0 in an empty slot
  };

  std::size_t slot_of(std::uint64_t hash) const {
    return static_cast<std::size_t>(hash) & (slots_.size() - 1);
  }
  static std::uint32_t tag_of(std::uint64_t hash) { return static_cast<std::uint32_t>(hash >> 32); }
  const PathNode& node_at(std::size_t number) const {
    return (*chunks_[number / NodeChunk::kNodes])[number % NodeChunk::kNodes];
  }

  const PathNode* add(const PathNode& node, std::size_t at, std::uint32_t tag) {
    TENON_ASSERT(count_ < std::numeric_limits<std::uint32_t>::max());
    if (count_ % NodeChunk::kNodes == 0) {
      chunks_.emplace_back(new NodeChunk);
    }
    PathNode added = node;
    added.number = next_number();
    ++count_;
    slots_[at] = {tag, static_cast<std::uint32_t>(count_)};
    return chunks_.back()->add(added);
  }

  void grow() {
    slots_.assign(std::max<std::size_t>(64, 2 * slots_.size()), Slot());
    for (std::size_t i = 0; i < count_; ++i) {
      const std::uint64_t hash = hash_of(node_at(i));
      std::size_t at = slot_of(hash);
      while (slots_[at].number != 0) {
        at = (at + 1) & (slots_.size() - 1);
      }
      slots_[at] = {tag_of(hash), static_cast<std::uint32_t>(i + 1)};
    }
  }

  std::mutex mutex_;
  std::vector<std::unique_ptr<NodeChunk>> chunks_;
  std::vector<Slot> slots_;
  std::size_t count_ = 0;
};

constexpr std::size_t kNodeShards = 16;
constexpr std::size_t kRecentNodes = 512;
constexpr std::uint32_t kDepthMask = (1u << 22u) - 1;

/// Nodes below one parent are kept together.
const PathNode* intern(const PathNode& node) {
  static auto* tables = new std::array<NodeTable, kNodeShards>();
  const std::size_t shard = (mix(1, node.parent) >> 40) % kNodeShards;
  return (*tables)[shard].intern(node, hash_of(node));
}

/// The same for one who walks through what is below a parent: what this thread asked for last there
/// and what was made after it are found without a look into the table.
const PathNode* intern_below(const PathNode& node) {
  thread_local std::array<const PathNode*, kRecentNodes> recent{};
  const PathNode*& last = recent[node.parent->number % kRecentNodes];
  if (last != nullptr) {
    if (same(*last, node)) {
      return last;
    }
    const PathNode* next = NodeChunk::next_of(last);
    if (next != nullptr && same(*next, node)) {
      return last = next;
    }
  }
  return last = intern(node);
}

const PathNode* root_node(PathKind kind) {
  PathNode node;
  node.kind = kind;
  node.absolute = kind == PathKind::AbsoluteRoot;
  return intern(node);
}

}  // namespace

Path Path::absolute_root() {
  static const PathNode* root = root_node(PathKind::AbsoluteRoot);
  return Path(root);
}

Path Path::relative_root() {
  static const PathNode* root = root_node(PathKind::RelativeRoot);
  return Path(root);
}

Path Path::make(const PathNode* parent, PathKind kind, Token name, PathNode::Detail detail) {
  const bool has_variant = parent->has_variant || kind == PathKind::VariantSelection;
  return Path(intern_below({parent, name, detail, 0, kind, parent->absolute, has_variant,
                            (parent->depth + 1) & kDepthMask}));
}

Path Path::child(Token name) const {
  TENON_ASSERT(node_ != nullptr);
  return make(node_, PathKind::Prim, name);
}

Path Path::property(Token name) const {
  TENON_ASSERT(node_ != nullptr);
  const bool relational = is_target();
  return make(node_, relational ? PathKind::RelationalAttribute : PathKind::Property, name);
}

Path Path::variant_selection(Token set, Token variant) const {
  TENON_ASSERT(node_ != nullptr);
  return make(node_, PathKind::VariantSelection, set, PathNode::Detail(variant));
}

Path Path::target_element(Path target) const {
  TENON_ASSERT(node_ != nullptr);
  return make(node_, PathKind::Target, Token(), PathNode::Detail(target.node_));
}

Path Path::mapper(Path target) const {
  TENON_ASSERT(node_ != nullptr);
  return make(node_, PathKind::Mapper, Token(), PathNode::Detail(target.node_));
}

Path Path::mapper_arg(Token name) const {
  TENON_ASSERT(node_ != nullptr);
  return make(node_, PathKind::MapperArg, name);
}

Path Path::expression() const {
  TENON_ASSERT(node_ != nullptr);
  return make(node_, PathKind::Expression, Token());
}

Path Path::prim_or_variant() const {
  const PathNode* node = node_;
  while (node != nullptr && node->kind > PathKind::VariantSelection) {
    node = node->parent;
  }
  return Path(node);
}

Path Path::prim() const {
  const PathNode* node = node_;
  while (node != nullptr && node->kind >= PathKind::VariantSelection) {
    node = node->parent;
  }
  return Path(node);
}

bool Path::has_prefix(Path prefix) const {
  if (prefix.node_ == nullptr) {
    return false;
  }
  const PathNode* node = node_;
  while (node != nullptr && node->depth > prefix.node_->depth) {
    node = node->parent;
  }
  return node == prefix.node_;
}

Path Path::append(Path relative) const {
  if (relative.node_ == nullptr || relative.node_->parent == nullptr) {
    return *this;
  }
  return relative.replace_prefix(relative_root(), *this, false);
}

Path Path::replace_prefix(Path from, Path to, bool fix_targets) const {
  if (node_ == nullptr || from.node_ == nullptr || to.node_ == nullptr ||
      (from == to && !fix_targets)) {
    return *this;
  }
  ShortList<const PathNode*, 24> tail;
  const PathNode* node = node_;
  while (node != nullptr && node != from.node_ && node->depth > 0) {
    tail.push_back(node);
    node = node->parent;
  }
  const bool found = node == from.node_;
  if (!found && !fix_targets) {
    return *this;
  }
  Path result = found ? to : Path(node);
  for (auto it = tail.rbegin(); it != tail.rend(); ++it) {
    const PathNode* element = *it;
    PathNode::Detail detail = element->detail;
    if (fix_targets && element->target() != nullptr) {
      detail.target = Path(element->target()).replace_prefix(from, to, true).node_;
    }
    result = make(result.node_, element->kind, element->name, detail);
  }
  return result;
}

Path Path::strip_variants() const {
  if (!has_variants()) {
    return *this;
  }
  ShortList<const PathNode*, 24> elements;
  const PathNode* node = node_;
  for (; node->depth > 0; node = node->parent) {
    if (node->kind != PathKind::VariantSelection) {
      elements.push_back(node);
    }
  }
  Path result(node);
  for (auto it = elements.rbegin(); it != elements.rend(); ++it) {
    result = make(result.node_, (*it)->kind, (*it)->name, (*it)->detail);
  }
  return result;
}

Path Path::absolute(Path anchor) const {
  if (node_ == nullptr || is_absolute()) {
    return *this;
  }
  ShortList<const PathNode*, 24> elements;
  for (const PathNode* node = node_; node->depth > 0; node = node->parent) {
    elements.push_back(node);
  }
  Path result = anchor;
  for (auto it = elements.rbegin(); it != elements.rend(); ++it) {
    const PathNode* element = *it;
    if (element->kind == PathKind::Prim && element->name == "..") {
      result = result.parent();
      if (result.empty()) {
        return result;
      }
      continue;
    }
    PathNode::Detail detail = element->detail;
    if (element->target() != nullptr) {
      detail.target = Path(element->target()).absolute(anchor).node_;
    }
    result = make(result.node_, element->kind, element->name, detail);
  }
  return result;
}

Path Path::relative(Path anchor) const {
  if (node_ == nullptr || !is_absolute()) {
    return *this;
  }
  Path common = anchor;
  Path result = relative_root();
  while (!has_prefix(common)) {
    result = result.child("..");
    common = common.parent();
  }
  return replace_prefix(common, result, false);
}

std::vector<Path> Path::prefixes() const {
  std::vector<Path> result;
  for (const PathNode* node = node_; node != nullptr; node = node->parent) {
    result.push_back(Path(node));
  }
  std::reverse(result.begin(), result.end());
  return result;
}

namespace {

std::strong_ordering compare_elements(const PathNode* a, const PathNode* b);

std::strong_ordering compare_nodes(const PathNode* a, const PathNode* b) {
  if (a == b) {
    return std::strong_ordering::equal;
  }
  if (a == nullptr || b == nullptr) {
    return a == nullptr ? std::strong_ordering::less : std::strong_ordering::greater;
  }
  if (a->absolute != b->absolute) {
    return a->absolute ? std::strong_ordering::less : std::strong_ordering::greater;
  }
  const PathNode* x = a;
  const PathNode* y = b;
  while (x->depth > y->depth) {
    x = x->parent;
  }
  while (y->depth > x->depth) {
    y = y->parent;
  }
  if (x == y) {
    return std::uint32_t{a->depth} <=> std::uint32_t{b->depth};
  }
  while (x->parent != y->parent) {
    x = x->parent;
    y = y->parent;
  }
  return compare_elements(x, y);
}

std::strong_ordering compare_elements(const PathNode* a, const PathNode* b) {
  if (a->kind != b->kind) {
    return a->kind <=> b->kind;
  }
  if (a->name != b->name) {
    return a->name <=> b->name;
  }
  if (a->variant() != b->variant()) {
    return a->variant() <=> b->variant();
  }
  return compare_nodes(a->target(), b->target());
}

}  // namespace

std::strong_ordering Path::operator<=>(const Path& other) const {
  return compare_nodes(node_, other.node_);
}

}  // namespace tenon
