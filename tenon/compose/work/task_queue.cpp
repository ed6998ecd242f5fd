// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/compose/work/task_queue.h"

#include <algorithm>

#include "tenon/compose/strength_order.h"

namespace tenon::compose {
namespace {

/// The bit of a task that is kept once per node; 0 for others.
std::uint8_t implied_bit(TaskKind kind) {
  return kind == TaskKind::ImpliedClasses       ? std::uint8_t{1}
         : kind == TaskKind::ImpliedSpecializes ? std::uint8_t{2}
                                                : std::uint8_t{0};
}

bool is_in_order_of_strength(TaskKind kind) {
  return kind == TaskKind::AncestralVariantAuthored || kind == TaskKind::AncestralVariantFallback ||
         kind == TaskKind::VariantAuthored || kind == TaskKind::VariantFallback;
}

}  // namespace

/// `a` waits until `b` is done.
bool TaskQueue::later(const Task& a, const Task& b) const {
  if (a.kind != b.kind) {
    return a.kind > b.kind;
  }
  if (a.kind == TaskKind::ImpliedClasses) {
    // A whole hierarchy of classes must be there before it is carried further up.
    if (a.node != b.node && a.node != 0 && b.node != 0) {
      if (graph_.is_ancestor(a.node, b.node)) {
        return true;
      }
      if (graph_.is_ancestor(b.node, a.node)) {
        return false;
      }
    }
    return compare_nodes(graph_, a.node, b.node) > 0;
  }
  if (is_in_order_of_strength(a.kind) && a.node != b.node) {
    return compare_nodes(graph_, a.node, b.node) > 0;
  }
  return std::tie(a.node, a.set_path, a.set_number) > std::tie(b.node, b.set_path, b.set_number);
}

/// Notes that such a task of the node is open; false when one was.
bool TaskQueue::is_first_implied(const Task& task) {
  if (task.node >= implied_.size()) {
    implied_.resize(task.node + std::size_t{1}, 0);
  }
  std::uint8_t& open = implied_[task.node];
  const bool first = (open & implied_bit(task.kind)) == 0;
  open |= implied_bit(task.kind);
  return first;
}

void TaskQueue::push(Task task) {
  if (implied_bit(task.kind) != 0 && !is_first_implied(task)) {
    return;
  }
  tasks_.push_back(std::move(task));
  std::push_heap(tasks_.begin(), tasks_.end(),
                 [this](const Task& a, const Task& b) { return later(a, b); });
}

Task TaskQueue::pop() {
  std::pop_heap(tasks_.begin(), tasks_.end(),
                [this](const Task& a, const Task& b) { return later(a, b); });
  Task task = std::move(tasks_.back());
  tasks_.pop_back();
  if (const std::uint8_t bit = implied_bit(task.kind); bit != 0) {
    implied_[task.node] &= static_cast<std::uint8_t>(~bit);
  }
  return task;
}

void TaskQueue::retry_variants() {
  for (Task& task : tasks_) {
    if (task.kind == TaskKind::VariantFallback || task.kind == TaskKind::VariantNone) {
      task.kind = TaskKind::VariantAuthored;
    } else if (task.kind == TaskKind::AncestralVariantFallback ||
               task.kind == TaskKind::AncestralVariantNone) {
      task.kind = TaskKind::AncestralVariantAuthored;
    }
  }
  std::make_heap(tasks_.begin(), tasks_.end(),
                 [this](const Task& a, const Task& b) { return later(a, b); });
}

}  // namespace tenon::compose
