// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The paths and all above them are put together as a tree, which is then walked from the top. Names
// of siblings are compared by eight bytes behind what all of them begin with; only where those are
// equal the paths themselves are.
#include "tenon/base/paths/path_order.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <string_view>

#include "tenon/base/paths/path_slots.h"

namespace tenon {
namespace {

constexpr std::uint32_t kNobody = 0xFFFFFFFFu;

/// The paths and all above them, by parent.
class PathFamilies {
 public:
  explicit PathFamilies(std::span<const Path> paths) : next_equal_(paths.size(), kNobody) {
    members_.push_back({});  // the empty path, which is above all roots
    grow(std::bit_ceil(2 * paths.size() + 16));
    for (std::size_t i = paths.size(); i > 0; --i) {
      const auto index = static_cast<std::uint32_t>(i - 1);
      Member& member = members_[member_of(paths[index])];
      next_equal_[index] = member.index;
      member.index = index;
    }
  }

  std::vector<std::uint32_t> in_order() {
    std::vector<std::uint32_t> order;
    order.reserve(next_equal_.size());
    std::vector<std::uint32_t> pending{0};
    while (!pending.empty()) {
      const Member& member = members_[pending.back()];
      pending.pop_back();
      for (std::uint32_t i = member.index; i != kNobody; i = next_equal_[i]) {
        order.push_back(i);
      }
      sort_children(member);
      for (auto child = siblings_.rbegin(); child != siblings_.rend(); ++child) {
        pending.push_back(child->member);
      }
    }
    return order;
  }

 private:
  struct Member {
    Path path;
    std::uint32_t index = kNobody;  // the first of the paths that is this one
    std::uint32_t first_child = kNobody;
    std::uint32_t next_sibling = kNobody;
  };
  struct Sibling {
    std::uint64_t beginning = 0;  // of its name, behind what all siblings have in common
    std::uint32_t member = 0;
    PathKind kind = PathKind::Empty;
  };

  /// The member of a path, made with those above it where it is not there yet.
  std::uint32_t member_of(Path path) {
    bool is_new = false;
    const std::uint32_t wanted = find_or_make(path, is_new);
    for (std::uint32_t child = wanted; is_new;) {
      const std::uint32_t parent = find_or_make(members_[child].path.parent(), is_new);
      members_[child].next_sibling = members_[parent].first_child;
      members_[parent].first_child = child;
      child = parent;
    }
    return wanted;
  }

  std::uint32_t find_or_make(Path path, bool& is_new) {
    if (path.empty()) {
      is_new = false;
      return 0;
    }
    if (2 * members_.size() > slots_.size()) {
      grow(2 * slots_.size());
    }
    std::uint32_t& slot = slots_[slot_of(path)];
    is_new = slot == 0;
    if (is_new) {
      slot = static_cast<std::uint32_t>(members_.size());
      members_.push_back({path});
    }
    return slot;
  }

  /// Where the member of a path is told, or would be.
  std::size_t slot_of(Path path) const {
    std::size_t at = places_.home(path.number());
    while (slots_[at] != 0 && members_[slots_[at]].path != path) {
      at = places_.next(at);
    }
    return at;
  }

  void grow(std::size_t slot_count) {
    slots_.assign(slot_count, 0);
    places_ = PathSlots(slot_count);
    for (std::uint32_t i = 1; i < members_.size(); ++i) {
      slots_[slot_of(members_[i].path)] = i;
    }
  }

  /// The children of a member in order, in `siblings_`.
  void sort_children(const Member& parent) {
    siblings_.clear();
    std::size_t common = std::string_view::npos;
    std::string_view first;
    for (std::uint32_t i = parent.first_child; i != kNobody; i = members_[i].next_sibling) {
      const Path path = members_[i].path;
      const std::string_view name = path.name().view();
      first = siblings_.empty() ? name : first;
      common = std::min({common, first.size(), name.size()});
      common = static_cast<std::size_t>(
          std::mismatch(name.begin(), name.begin() + static_cast<std::ptrdiff_t>(common),
                        first.begin())
              .first -
          name.begin());
      siblings_.push_back({0, i, path.kind()});
    }
    if (siblings_.size() < 2) {
      return;
    }
    for (Sibling& sibling : siblings_) {
      sibling.beginning = beginning_of(members_[sibling.member].path.name().view().substr(common));
    }
    const auto comes_before = [this](const Sibling& a, const Sibling& b) {
      if (a.kind != b.kind) {
        return a.kind < b.kind;
      }
      if (a.beginning != b.beginning) {
        return a.beginning < b.beginning;
      }
      const Path one = members_[a.member].path;
      const Path other = members_[b.member].path;
      return one.name() != other.name() ? one.name() < other.name() : one < other;
    };
    if (!std::is_sorted(siblings_.begin(), siblings_.end(), comes_before)) {
      std::sort(siblings_.begin(), siblings_.end(), comes_before);
    }
  }

  /// Eight bytes as a number that is ordered like them; a shorter text is filled up with zeros.
  static std::uint64_t beginning_of(std::string_view text) {
    std::uint64_t bytes = 0;
    for (std::size_t i = 0; i < sizeof(bytes); ++i) {
      bytes = bytes << 8U | (i < text.size() ? static_cast<unsigned char>(text[i]) : 0U);
    }
    return bytes;
  }

  std::vector<Member> members_;
  std::vector<std::uint32_t> next_equal_;
  std::vector<std::uint32_t> slots_;  // members by the number of their path; 0 in an empty slot
  PathSlots places_;
  std::vector<Sibling> siblings_;
};

}  // namespace

std::vector<std::uint32_t> path_order(std::span<const Path> paths) {
  return PathFamilies(paths).in_order();
}

}  // namespace tenon
