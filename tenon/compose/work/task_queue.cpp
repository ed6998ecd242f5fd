// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/compose/work/task_queue.h"

#include <algorithm>

#include "tenon/compose/strength_order.h"

namespace tenon::compose {
namespace {

bool is_implied(TaskKind kind) {
  return kind == TaskKind::ImpliedClasses || kind == TaskKind::ImpliedSpecializes;
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

void TaskQueue::push(Task task) {
  if (is_implied(task.kind) && !implied_.emplace(task.kind, task.node).second) {
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
  if (is_implied(task.kind)) {
    implied_.erase({task.kind, task.node});
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
