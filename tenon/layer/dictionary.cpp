// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/layer/dictionary.h"

#include "tenon/base/limits/limits.h"

namespace tenon::layer {
namespace {

// Depth is bounded by what the readers accept (limits::kTextNestingDepth).
void merge_into(Dictionary& stronger, const Dictionary& weaker) {
  for (const auto& [key, value] : weaker.items) {
    const auto [it, added] = stronger.items.try_emplace(key, value);
    if (added) {
      continue;
    }
    const auto* own = it->second.get<Dictionary>();
    const auto* other = value.get<Dictionary>();
    if (own != nullptr && other != nullptr) {
      Dictionary both = *own;
      merge_into(both, *other);
      it->second = Value(std::move(both));
    }
  }
}

}  // namespace

Dictionary merge(const Dictionary& stronger, const Dictionary& weaker) {
  Dictionary result = stronger;
  merge_into(result, weaker);
  return result;
}

}  // namespace tenon::layer
