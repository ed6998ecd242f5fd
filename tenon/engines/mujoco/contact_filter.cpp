// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/engines/mujoco/contact_filter.h"

#include <algorithm>
#include <mutex>

#include "tenon/scene/filter_sets.h"

namespace tenon::engines::mujoco {
namespace {

thread_local const ContactFilter* current_filter = nullptr;
mjfConFilt previous_filter = nullptr;

// MuJoCo's rule, which it leaves to the callback once there is one.
bool bits_off(const mjModel* m, int a, int b) {
  return (m->geom_contype[a] & m->geom_conaffinity[b]) == 0 &&
         (m->geom_contype[b] & m->geom_conaffinity[a]) == 0;
}

bool filtered(const ContactFilter& filter, int a, int b) {
  const auto class_a = static_cast<std::size_t>(filter.geom_class[static_cast<std::size_t>(a)]);
  const auto class_b = static_cast<std::size_t>(filter.geom_class[static_cast<std::size_t>(b)]);
  if (filter.class_off[class_a * filter.class_count + class_b] != 0) {
    return true;
  }
  const std::uint64_t pair = (std::uint64_t{static_cast<std::uint32_t>(std::min(a, b))} << 32u) |
                             static_cast<std::uint32_t>(std::max(a, b));
  return std::binary_search(filter.pairs_off.begin(), filter.pairs_off.end(), pair) ||
         (!filter.sets_of_geom.empty() &&
          scene::are_apart(filter.sets_of_geom[static_cast<std::size_t>(a)],
                           filter.sets_of_geom[static_cast<std::size_t>(b)], filter.sets_off));
}

// 1 discards the pair.
int filter_pair(const mjModel* m, mjData* d, int a, int b) {
  if (current_filter == nullptr) {
    return previous_filter != nullptr ? previous_filter(m, d, a, b) : (bits_off(m, a, b) ? 1 : 0);
  }
  if (bits_off(m, a, b)) {
    return 1;  // what only tendons go around
  }
  return filtered(*current_filter, a, b) ? 1 : 0;
}

void install() {
  static std::once_flag installed;
  std::call_once(installed, [] {
    previous_filter = contact_filter_callback();
    contact_filter_callback() = &filter_pair;
  });
}

}  // namespace

void FilterScope::begin(const ContactFilter& filter) {
  install();
  outer_ = current_filter;
  current_filter = &filter;
}

void FilterScope::end() { current_filter = outer_; }

bool may_touch(const Model& model, int a, int b) {
  const mjModel* m = model.model.get();
  if (bits_off(m, a, b) || (model.filter.needed && filtered(model.filter, a, b))) {
    return false;
  }
  const int body_a = std::min(m->geom_bodyid[a], m->geom_bodyid[b]);
  const int body_b = std::max(m->geom_bodyid[a], m->geom_bodyid[b]);
  const int signature = (body_a << 16) + body_b;
  const int* first = m->exclude_signature;
  const int* end = first + m->nexclude;
  return std::find(first, end, signature) == end;
}

}  // namespace tenon::engines::mujoco
