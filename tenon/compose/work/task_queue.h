// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include "tenon/compose/node_graph.h"

namespace tenon::compose {

/// Steps of indexing a prim, those to take first on top. Arcs that say where opinions come from are
/// expanded before variants, whose selection may be among those opinions.
enum class TaskKind : std::uint8_t {
  NodeRelocates,
  ImpliedRelocates,
  References,
  Payloads,
  Inherits,
  Specializes,
  ImpliedSpecializes,
  ImpliedClasses,
  AncestralVariantSets,
  AncestralVariantAuthored,
  AncestralVariantFallback,
  AncestralVariantNone,
  VariantSets,
  VariantAuthored,
  VariantFallback,
  VariantNone,
  UnresolvedPrimPath,
};

struct Task {
  TaskKind kind = TaskKind::References;
  NodeId node = kNoNode;
  Path set_path = {};  ///< of variant tasks: the prim or variant that has the set
  std::string set_name = {};
  std::uint16_t set_number = 0;
};

/// Open tasks of one index. A task for implied arcs is kept once per node.
class TaskQueue {
 public:
  explicit TaskQueue(const NodeGraph& graph) : graph_(graph) {}

  bool empty() const { return tasks_.empty(); }
  std::size_t size() const { return tasks_.size(); }
  void push(Task task);
  void push(TaskKind kind, NodeId node) { push(Task{kind, node}); }
  Task pop();
  /// Sets without a selection so far get another chance after new opinions came in.
  void retry_variants();

 private:
  bool is_first_implied(const Task& task);
  bool later(const Task& a, const Task& b) const;

  const NodeGraph& graph_;
  std::vector<Task> tasks_;              // a heap
  ShortList<std::uint8_t, 24> implied_;  // by node, a bit for each kind that is open
};

}  // namespace tenon::compose
