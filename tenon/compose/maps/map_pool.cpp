// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/compose/maps/map_pool.h"

namespace tenon::compose {

const MapFunction* MapPool::add(MapFunction map) {
  if (map.is_identity()) {
    return identity();
  }
  maps_.push_back(std::move(map));
  return &maps_.back();
}

const Node* MapPool::like(const Node& node) {
  constexpr std::size_t kLately = 8;  // a scene has few of them
  Node shape = node;
  shape.path = Path();
  std::size_t left = kLately;
  for (auto known = nodes_.rbegin(); known != nodes_.rend() && left > 0; ++known, --left) {
    if (*known == shape) {
      return &*known;
    }
  }
  nodes_.push_back(shape);
  return &nodes_.back();
}

const MapFunction* MapPool::compose(const MapFunction* outer, const MapFunction* inner,
                                    WorkMeter& work) {
  if (outer->is_identity()) {
    return inner;
  }
  if (inner->is_identity()) {
    return outer;
  }
  const std::size_t pairs = outer->pairs().size() + inner->pairs().size();
  if (pairs <= kFewPairs) {
    return add(outer->compose(*inner));
  }
  return find_or_make({outer, inner, {}, {}, {}, false}, [&] {
    work.count(map_making_units(pairs));
    return outer->compose(*inner);
  });
}

const MapFunction* MapPool::find_or_make(const MapRecipe& recipe,
                                         const std::function<MapFunction()>& make) {
  const MapPool& known = known_ == nullptr ? *this : *known_;
  const auto found = known.made_.find(recipe);
  if (found != known.made_.end()) {
    return found->second;
  }
  if (known_ != nullptr) {
    lacking_();
    return identity();
  }
  const MapFunction* const made = add(make());
  made_.emplace(recipe, made);
  return made;
}

}  // namespace tenon::compose
