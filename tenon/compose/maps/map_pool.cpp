// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/compose/maps/map_pool.h"

namespace tenon::compose {
namespace {

/// One of the last few shapes (a scene has few), or a new one.
template <class T>
const T* find_lately(std::deque<T>& shapes, const T& shape) {
  std::size_t left = 8;
  for (auto known = shapes.rbegin(); known != shapes.rend() && left > 0; ++known, --left) {
    if (*known == shape) {
      return &*known;
    }
  }
  shapes.push_back(shape);
  return &shapes.back();
}

}  // namespace

const MapFunction* MapPool::add(MapFunction map) {
  if (map.is_identity()) {
    return identity();
  }
  maps_.push_back(std::move(map));
  return &maps_.back();
}

const Node* MapPool::like(const Node& node) {
  Node shape = node;
  shape.path = Path();
  return find_lately(nodes_, shape);
}

const Opinion* MapPool::like(const Opinion& opinion) {
  Opinion shape;
  shape.layer = opinion.layer;
  shape.node = opinion.node;
  shape.offset = opinion.offset;
  return find_lately(opinions_, shape);
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
