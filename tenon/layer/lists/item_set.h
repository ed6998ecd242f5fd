// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace tenon::layer {

/// Hash of an item of a list edit: its own `hash()`, or std::hash.
template <class T>
std::size_t item_hash(const T& item) {
  if constexpr (requires { item.hash(); }) {
    return item.hash();
  } else {
    return std::hash<T>{}(item);
  }
}

/// The first position of items in a list that may grow at its end: by comparing while it is short,
/// by a table when it is long, so that long lists cost no square of their length.
template <class T>
class ItemPositions {
 public:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  /// `expected_more` items at most will be put at the end of `list`.
  explicit ItemPositions(const std::vector<T>& list, std::size_t expected_more = 0) : list_(list) {
    if (list.size() + expected_more > kShort) {
      make_table(list.size() + expected_more);
    }
  }

  std::size_t find(const T& item) const {
    if (!table_.empty()) {
      return find_in_table(item);
    }
    std::size_t at = 0;
    while (at < list_.size() && !(list_[at] == item)) {
      ++at;
    }
    return at == list_.size() ? kNone : at;
  }
  bool contains(const T& item) const { return find(item) != kNone; }
  /// To be told of each item that is put at the end of the list, after that.
  void appended() {
    if (!table_.empty()) {
      enter(list_.size() - 1);
    }
  }

 private:
  static constexpr std::size_t kShort = 16;
  static constexpr std::uint32_t kFree = 0xffffffff;

  void make_table(std::size_t most);
  void enter(std::size_t position);
  std::size_t find_in_table(const T& item) const;
  std::size_t slot_of(const T& item) const;

  const std::vector<T>& list_;
  std::vector<std::uint32_t> table_;
};

template <class T>
void ItemPositions<T>::make_table(std::size_t most) {
  std::size_t slots = 2 * kShort;
  while (slots < 2 * most) {
    slots *= 2;
  }
  table_.assign(slots, kFree);
  for (std::size_t i = 0; i < list_.size(); ++i) {
    enter(i);
  }
}

template <class T>
void ItemPositions<T>::enter(std::size_t position) {
  std::uint32_t& slot = table_[slot_of(list_[position])];
  if (slot == kFree) {
    slot = static_cast<std::uint32_t>(position);
  }
}

template <class T>
std::size_t ItemPositions<T>::find_in_table(const T& item) const {
  const std::uint32_t at = table_[slot_of(item)];
  return at == kFree ? kNone : at;
}

/// The slot that holds an equal item, or the free one where it belongs.
template <class T>
std::size_t ItemPositions<T>::slot_of(const T& item) const {
  constexpr std::uint64_t kSpread = 0x9e3779b97f4a7c15;  // neighbouring hashes go far apart
  const std::uint64_t spread = item_hash(item) * kSpread;
  std::size_t slot = static_cast<std::size_t>(spread >> 32) & (table_.size() - 1);
  while (table_[slot] != kFree && !(list_[table_[slot]] == item)) {
    slot = (slot + 1) & (table_.size() - 1);
  }
  return slot;
}

/// Puts at the end of `list` what it lacks of `items`.
template <class T>
void append_absent(std::vector<T>& list, const std::vector<T>& items) {
  ItemPositions<T> positions(list, items.size());
  for (const T& item : items) {
    if (!positions.contains(item)) {
      list.push_back(item);
      positions.appended();
    }
  }
}

/// Takes out of `list` what is among `items`.
template <class T>
void remove_items(std::vector<T>& list, const std::vector<T>& items) {
  if (items.empty() || list.empty()) {
    return;
  }
  const ItemPositions<T> gone(items);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (!gone.contains(list[i])) {
      if (kept != i) {
        list[kept] = std::move(list[i]);
      }
      ++kept;
    }
  }
  list.erase(list.begin() + static_cast<std::ptrdiff_t>(kept), list.end());
}

/// Moves all of `items` to the end of `list`.
template <class T>
void append_moved(std::vector<T>& list, std::vector<T>& items) {
  for (T& item : items) {
    list.push_back(std::move(item));
  }
}

/// Items of `list`, each once, where it stands first.
template <class T>
std::vector<T> unique_keeping_first(const std::vector<T>& list) {
  std::vector<T> result;
  append_absent(result, list);
  return result;
}

/// Items of `list`, each once, where it stands last.
template <class T>
std::vector<T> unique_keeping_last(const std::vector<T>& list) {
  const std::vector<T> backwards = unique_keeping_first(std::vector<T>(list.rbegin(), list.rend()));
  return {backwards.rbegin(), backwards.rend()};
}

}  // namespace tenon::layer
