// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "tenon/layer/lists/item_set.h"

namespace tenon::diff {

/// `first` with what `second` has beyond it: each item behind the one that stands before it in
/// `second`, at the front where there is none.
template <class T>
std::vector<T> joined_orders(const std::vector<T>& first, const std::vector<T>& second) {
  const layer::ItemPositions<T> known(first);
  std::vector<std::vector<T>> behind(first.size() + 1);  // by position in `first`, 0: the front
  std::size_t at = 0;
  bool any = false;
  for (const T& item : second) {
    const std::size_t position = known.find(item);
    if (position == layer::ItemPositions<T>::kNone) {
      behind[at].push_back(item);
      any = true;
    } else {
      at = position + 1;
    }
  }
  if (!any) {
    return first;
  }
  std::vector<T> joined = behind[0];
  for (std::size_t i = 0; i < first.size(); ++i) {
    joined.push_back(first[i]);
    joined.insert(joined.end(), behind[i + 1].begin(), behind[i + 1].end());
  }
  return joined;
}

/// A list with the changes of two sides: what either took out of `base` is out, what either added
/// is in. The order is that of `edited`, or that of `source` where no edit touched the list.
template <class T>
std::vector<T> merged_list(const std::vector<T>& base, const std::vector<T>& edited,
                           const std::vector<T>& source) {
  if (edited == base || edited == source) {
    return source;
  }
  if (source == base) {
    return edited;
  }
  std::vector<T> gone = base;  // that one of the sides lacks
  {
    const layer::ItemPositions<T> in_edited(edited);
    const layer::ItemPositions<T> in_source(source);
    std::erase_if(
        gone, [&](const T& item) { return in_edited.contains(item) && in_source.contains(item); });
  }
  std::vector<T> list = joined_orders(edited, source);
  layer::remove_items(list, gone);
  return list;
}

}  // namespace tenon::diff
