// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/stage/instance_bound.h"

#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace tenon::stage {
namespace {

/// The next prim of the tree below `root`, depth first; nullptr behind the last one.
PrimData* next_below(StageData& data, PrimData* prim, const PrimData* root) {
  if (prim->first_child != 0) {
    return data.numbered(prim->first_child);
  }
  while (prim != root && prim->next_sibling == 0) {
    prim = data.numbered(prim->parent);
  }
  return prim == root ? nullptr : data.numbered(prim->next_sibling);
}

class Counter {
 public:
  explicit Counter(StageData& data) : data_(data), most_(data.options.max_instanced_prims) {
    for (const layer::LayerPtr& layer : data.cache->used_layers()) {
      most_ += data.options.max_instanced_prims_per_spec * layer->spec_count();
    }
  }

  void run() {
    for (PrimData* prototype : data_.prototypes) {
      count_with_those_within(prototype);
    }
    count(data_.root);
    if (first_ != nullptr) {
      report();
    }
  }

 private:
  /// Prototypes within it first. One that lies within itself has no end.
  void count_with_those_within(PrimData* prototype) {
    std::vector<PrimData*> open{prototype};
    while (!open.empty()) {
      PrimData* const top = open.back();
      if (counts_.contains(top)) {
        open.pop_back();
        continue;
      }
      const bool is_new = entered_.insert(top).second;
      for (PrimData* prim = top; is_new && prim != nullptr; prim = next_below(data_, prim, top)) {
        if (prim->is_instance() && !entered_.contains(prim->prototype())) {
          open.push_back(const_cast<PrimData*>(prim->prototype()));
        }
      }
      if (open.back() == top) {
        counts_[top] = count(top);
        open.pop_back();
      }
    }
  }

  std::size_t count(PrimData* root) {
    std::size_t sum = 0;
    for (PrimData* prim = root; prim != nullptr; prim = next_below(data_, prim, root)) {
      ++sum;
      if (!prim->is_instance()) {
        continue;
      }
      const auto below = counts_.find(prim->prototype());
      if (below == counts_.end() || sum > most_ || below->second > most_ - sum) {
        cut(*prim);
      } else {
        sum += below->second;
      }
    }
    return sum;
  }

  void cut(PrimData& instance) {
    instance.extras = &data_.extras.emplace_back(PrimExtras{nullptr, instance.clips(), Path()});
    first_ = first_ == nullptr ? &instance : first_;
    ++cuts_;
  }

  void report() {
    Diagnostic diagnostic;
    diagnostic.rule = "stage.too-many-prims";
    diagnostic.message = "instances within instances make more than " + std::to_string(most_) +
                         " prims; what is below <" + first_->source_path().str() + ">" +
                         (cuts_ > 1 ? " and " + std::to_string(cuts_ - 1) + " more" : "") +
                         " is skipped";
    diagnostic.file = data_.cache->layer_stack()->identifier();
    diagnostic.prim = first_->source_path().str();
    diagnostic.fix = "reduce the references that multiply with each other";
    data_.diagnostics.add(std::move(diagnostic));
  }

  StageData& data_;
  std::size_t most_;
  std::unordered_map<const PrimData*, std::size_t> counts_;  // of prototypes
  std::unordered_set<const PrimData*> entered_;
  const PrimData* first_ = nullptr;
  std::size_t cuts_ = 0;
};

}  // namespace

void bound_instances(StageData& data) {
  if (!data.prototypes.empty()) {
    Counter(data).run();
  }
}

}  // namespace tenon::stage
