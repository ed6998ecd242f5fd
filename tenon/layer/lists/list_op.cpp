// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/layer/lists/list_op.h"

#include "tenon/layer/arcs.h"
#include "tenon/layer/lists/fold_list_ops.h"

namespace tenon::layer {

std::vector<std::size_t> reordered(const std::vector<std::size_t>& ranks, std::size_t order_size) {
  constexpr std::size_t kNone = ItemPositions<int>::kNone;
  std::vector<std::size_t> result;
  std::vector<std::size_t> first_of(order_size, kNone);
  for (std::size_t at = 0; at < ranks.size(); ++at) {
    if (ranks[at] != kNone && first_of[ranks[at]] == kNone) {
      first_of[ranks[at]] = at;
    }
  }
  const auto take_unnamed = [&](std::size_t at) {
    for (; at < ranks.size() && ranks[at] == kNone; ++at) {
      result.push_back(at);
    }
  };
  take_unnamed(0);
  for (const std::size_t first : first_of) {
    if (first != kNone) {
      result.push_back(first);
      take_unnamed(first + 1);
    }
  }
  return result;
}

#define TENON_COMPILE(type)     \
  template struct ListOp<type>; \
  template std::optional<ListOp<type>> fold(const ListOp<type>&, const ListOp<type>&);
TENON_LIST_ITEMS(TENON_COMPILE)
#undef TENON_COMPILE

}  // namespace tenon::layer
