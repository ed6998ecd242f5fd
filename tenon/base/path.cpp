// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// Paths are hash-consed: each element but a property is a node that is stored once, found by its
// parent and its own words. Nodes are never freed, so comparisons need no text.
#include "tenon/base/path.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <mutex>
#include <new>
#include <utility>

#include "tenon/base/assert.h"
#include "tenon/base/containers/short_list.h"
#include "tenon/base/containers/tag_slots.h"

namespace tenon {
namespace {

/// Targets hardly ever follow properties that are elements.
bool may_hold_targets(PathKind kind) {
  return kind != PathKind::AbsoluteRoot && kind != PathKind::RelativeRoot &&
         kind != PathKind::Prim && kind != PathKind::VariantSelection;
}

constexpr std::uint32_t kNumbersAtOnce = 256;
constexpr std::uint64_t kGolden = 0x9E3779B97F4A7C15ull;

// 64 bits on every machine: shards and tags each take some of them.
std::uint64_t mix(std::uint64_t seed, std::uint64_t bits) {
  return (seed ^ bits) * kGolden + (seed >> 29u);
}

std::uint32_t tag_of(const PathNode& node) {
  std::uint64_t hash = mix(static_cast<std::uint64_t>(node.kind) + 1, node.parent.id());
  hash = mix(hash, node.name);
  return static_cast<std::uint32_t>(mix(hash, node.detail.id()) >> 32u);
}

bool same(const PathNode& a, const PathNode& b) {
  return a.parent == b.parent && a.name == b.name && a.kind == b.kind && a.detail == b.detail;
}

/// How many nodes of each row of numbers are made: others may read those while one more is added.
constinit NumberedStore<std::uint32_t> made_of_row;

constexpr std::uint32_t row_of(std::uint32_t number) { return (number - 1) / kNumbersAtOnce; }
constexpr std::uint32_t place_in_row(std::uint32_t number) { return (number - 1) % kNumbersAtOnce; }

/// Numbers for the nodes that this thread makes: it takes a row of them at once, so that those made
/// one after another are neighbours whatever other threads do.
std::uint32_t next_number() {
  static std::atomic<std::uint32_t> taken = 0;
  thread_local std::uint32_t last = 0;
  if (last % kNumbersAtOnce == 0) {
    last = taken.fetch_add(kNumbersAtOnce, std::memory_order_relaxed);
    TENON_ASSERT(last + kNumbersAtOnce != 0);
    made_of_row.make_room(row_of(last + 1)) = 0;
  }
  return ++last;
}

void note_made(std::uint32_t number) {
  std::atomic_ref(made_of_row[row_of(number)])
      .store(place_in_row(number) + 1, std::memory_order_release);
}

/// Whether the node whose number follows `number` is there; its row may end with that.
bool has_next(std::uint32_t number) {
  return place_in_row(number) + 1 < kNumbersAtOnce &&
         std::atomic_ref(made_of_row[row_of(number)]).load(std::memory_order_acquire) >
             place_in_row(number) + 1;
}

/// A part of the table of all nodes.
class NodeTable {
 public:
  std::uint32_t intern(const PathNode& node, NumberedStore<PathNode>& nodes) {
    const std::lock_guard lock(mutex_);
    return slots_.find_or_make(
        tag_of(node), [&](std::uint32_t number) { return same(nodes[number], node); },
        [&] {
          const std::uint32_t number = next_number();
          ::new (&nodes.make_room(number)) PathNode(node);
          note_made(number);
          return number;
        });
  }

 private:
  std::mutex mutex_;
  TagSlots slots_;
};

constexpr std::size_t kNodeShards = 16;

/// The one that holds what is below `parent`.
NodeTable& table_below(Path parent) {
  static auto* tables = new std::array<NodeTable, kNodeShards>();
  return (*tables)[(mix(1, parent.id()) >> 40u) % kNodeShards];
}

PathNode root_node(PathKind kind) {
  PathNode node;
  node.kind = kind;
  node.absolute = kind == PathKind::AbsoluteRoot ? 1 : 0;
  return node;
}

}  // namespace

constinit NumberedStore<PathNode> Path::nodes_;

/// The empty path has a node, too, so that what asks for one need not look whether there is one.
const PathNode* const PathNode::of_empty = ::new (&Path::nodes_.make_room(0)) PathNode;

Path Path::intern(const PathNode& node) {
  return {table_below(node.parent).intern(node, nodes_), 0};
}

Path Path::absolute_root() {
  static const Path root = intern(root_node(PathKind::AbsoluteRoot));
  return root;
}

Path Path::relative_root() {
  static const Path root = intern(root_node(PathKind::RelativeRoot));
  return root;
}

/// One who walks through what is below a parent asks for one child after another: what this thread
/// asked for last there and what was made after it are found without a look into the table.
Path Path::make(PathKind kind, std::uint32_t name, Path detail) const {
  constexpr std::size_t kRecentNodes = 512;
  thread_local std::array<std::uint32_t, kRecentNodes> recent{};
  TENON_ASSERT(element_ != 0);
  PathNode made;
  made.parent = *this;
  made.detail = detail;
  made.name = name;
  made.kind = kind;
  std::uint32_t& last = recent[element_ % kRecentNodes];
  if (last != 0) {
    if (same(nodes_[last], made)) {
      return {last, 0};
    }
    if (has_next(last) && same(nodes_[last + 1], made)) {
      return {++last, 0};
    }
  }
  const PathNode& above = node();
  made.absolute = above.absolute;
  made.has_variant = kind == PathKind::VariantSelection ? 1 : above.has_variant;
  made.depth = (depth() + 1) & ((1u << 22u) - 1);
  last = intern(made).element_;
  return {last, 0};
}

Path Path::make_like(Path path, Path detail) const {
  const PathNode& last = path.node();
  if (path.property_ == 0 && last.kind != PathKind::Property) {
    return make(last.kind, last.name, detail);
  }
  const std::uint32_t name = path.property_ == 0 ? last.name : path.property_;
  return property_ == 0 ? Path(element_, name) : make(PathKind::Property, name, {});
}

Path Path::child(Token name) const { return make(PathKind::Prim, name.number(), {}); }

Path Path::property(Token name) const {
  TENON_ASSERT(element_ != 0);
  if (property_ != 0) {
    return make(PathKind::Property, name.number(), {});
  }
  return {element_, name.number()};
}

Path Path::variant_selection(Token set, Token variant) const {
  return make(PathKind::VariantSelection, set.number(), Path(variant.number(), 0));
}

Path Path::target_element(Path target) const { return make(PathKind::Target, 0, target); }

Path Path::mapper(Path target) const { return make(PathKind::Mapper, 0, target); }

Path Path::mapper_arg(Token name) const { return make(PathKind::MapperArg, name.number(), {}); }

Path Path::expression() const { return make(PathKind::Expression, 0, {}); }

Token Path::variant() const {
  return is_variant_selection() ? Token::numbered(node().detail.element_) : Token();
}

Path Path::target() const {
  const PathKind last = kind();
  return last == PathKind::Target || last == PathKind::Mapper ? node().detail : Path();
}

Path Path::prim_or_variant() const {
  Path path = *this;
  while (path.kind() > PathKind::VariantSelection) {
    path = path.parent();
  }
  return path;
}

Path Path::prim() const {
  Path path = *this;
  while (path.kind() >= PathKind::VariantSelection) {
    path = path.parent();
  }
  return path;
}

bool Path::has_prefix(Path prefix) const {
  return !prefix.empty() && above(prefix.depth()) == prefix;
}

/// The path of so many elements at the head of this one; itself where it has no more.
Path Path::above(std::uint32_t depth) const {
  Path path = *this;
  for (const PathNode* last = &node(); last->depth + (path.property_ == 0 ? 0u : 1u) > depth;) {
    path = path.property_ == 0 ? last->parent : Path(path.element_, 0);
    last = &path.node();
  }
  return path;
}

Path Path::append(Path relative) const {
  if (relative.parent().empty()) {
    return *this;
  }
  return relative.replace_prefix(relative_root(), *this, false);
}

Path Path::replace_prefix(Path from, Path to, bool fix_targets) const {
  if (empty() || from.empty() || to.empty()) {
    return *this;
  }
  fix_targets = fix_targets && may_hold_targets(node().kind);
  if (from == to && !fix_targets) {
    return *this;
  }
  ShortList<Path, 24> tail;
  Path path = *this;
  // Only what is as deep as `from` can be it; targets are looked for on the whole way.
  const std::uint32_t top = fix_targets ? 0 : from.depth();
  for (std::uint32_t depth = path.depth(); depth > top && path != from; --depth) {
    tail.push_back(path);
    path = path.parent();
  }
  const bool found = path == from;
  if (!found && !fix_targets) {
    return *this;
  }
  Path result = found ? to : path;
  for (auto it = tail.rbegin(); it != tail.rend(); ++it) {
    const PathNode& last = it->node();
    const bool moves = fix_targets && it->property_ == 0 &&
                       (last.kind == PathKind::Target || last.kind == PathKind::Mapper);
    result =
        result.make_like(*it, moves ? last.detail.replace_prefix(from, to, true) : last.detail);
  }
  return result;
}

Path Path::strip_variants() const {
  if (!has_variants()) {
    return *this;
  }
  ShortList<Path, 24> elements;
  Path path = *this;
  for (; path.depth() > 0; path = path.parent()) {
    if (!path.is_variant_selection()) {
      elements.push_back(path);
    }
  }
  for (auto it = elements.rbegin(); it != elements.rend(); ++it) {
    path = path.make_like(*it, it->node().detail);
  }
  return path;
}

Path Path::absolute(Path anchor) const {
  if (empty() || is_absolute()) {
    return *this;
  }
  ShortList<Path, 24> elements;
  for (Path path = *this; path.depth() > 0; path = path.parent()) {
    elements.push_back(path);
  }
  Path result = anchor;
  for (auto it = elements.rbegin(); it != elements.rend(); ++it) {
    if (it->is_prim() && it->name() == "..") {
      result = result.parent();
      if (result.empty()) {
        return result;
      }
      continue;
    }
    const Path target = it->target();
    result = result.make_like(*it, target.empty() ? it->node().detail : target.absolute(anchor));
  }
  return result;
}

Path Path::relative(Path anchor) const {
  if (empty() || !is_absolute()) {
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
  for (Path path = *this; !path.empty(); path = path.parent()) {
    result.push_back(path);
  }
  std::reverse(result.begin(), result.end());
  return result;
}

namespace {

std::strong_ordering compare_elements(Path a, Path b) {
  if (a.kind() != b.kind()) {
    return a.kind() <=> b.kind();
  }
  if (a.name() != b.name()) {
    return a.name() <=> b.name();
  }
  if (a.variant() != b.variant()) {
    return a.variant() <=> b.variant();
  }
  return a.target() <=> b.target();
}

}  // namespace

std::strong_ordering Path::operator<=>(const Path& other) const {
  if (*this == other) {
    return std::strong_ordering::equal;
  }
  if (element_ == other.element_) {  // something below one element
    return property_ == 0         ? std::strong_ordering::less
           : other.property_ == 0 ? std::strong_ordering::greater
                                  : name() <=> other.name();
  }
  if (empty() || other.empty()) {
    return empty() ? std::strong_ordering::less : std::strong_ordering::greater;
  }
  if (is_absolute() != other.is_absolute()) {
    return is_absolute() ? std::strong_ordering::less : std::strong_ordering::greater;
  }
  const std::uint32_t ours = depth();
  const std::uint32_t theirs = other.depth();
  Path x = ours > theirs ? above(theirs) : *this;
  Path y = theirs > ours ? other.above(ours) : other;
  if (x == y) {
    return ours <=> theirs;
  }
  for (Path up = x.parent(), above = y.parent(); up != above;) {
    x = std::exchange(up, up.parent());
    y = std::exchange(above, above.parent());
  }
  return compare_elements(x, y);
}

}  // namespace tenon
