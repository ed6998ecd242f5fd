// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Each of two threads takes roots, one after the other, and walks down from them with a cache of
// its own. Where it needs what it may not ask for, because that would open a layer or leave a
// trace, it drops the index at hand, which is then built on request.
#include "tenon/compose/cache/build_ahead.h"

#include <algorithm>
#include <atomic>
#include <limits>

#include "tenon/base/parallel.h"
#include "tenon/compose/build_index.h"
#include "tenon/compose/twins/twins.h"

namespace tenon::compose {
namespace {

class BatchBuilder {
 public:
  BatchBuilder(const KnownIndices& known, IndexBatch& batch) : known_(known), batch_(batch) {
    batch_.maps.take_from(*known_.maps, [this] { give_up(); });
    services_.maps = &batch_.maps;
    services_.options = known_.options;
    services_.root_stack = known_.root_stack;
    services_.node_count = &node_count_;
    services_.work = &work_;
    services_.twins = known_.options->shares_twins ? &twins_ : nullptr;
    services_.index = [this](Path path) -> const PrimIndex& { return index(path); };
    services_.open = [this](const std::string& path, const layer::Layer& anchor) {
      const Result<layer::LayerPtr>* const opened = known_.layer(path, anchor);
      return opened != nullptr ? *opened : give_up();
    };
    services_.stack = [this](const layer::LayerPtr& layer, const LayerStack* from) {
      const LayerStack* const stack = known_.stack(layer, from);
      return stack != nullptr ? stack : (give_up(), from);
    };
    services_.missing = [this](const MissingArc&) { give_up(); };
    node_count_ = known_.node_count;
    work_.set_max(known_.max_work);
    work_.restart(known_.work_done);
  }
  BatchBuilder(const BatchBuilder&) = delete;
  BatchBuilder& operator=(const BatchBuilder&) = delete;

  /// Roots that are alike are told before anything is built: what is met below one of them would
  /// come between it and the next.
  void note(const std::vector<const PrimIndex*>& roots) {
    for (const PrimIndex* const root : roots) {
      twins_.note_sibling(services_, *root);
    }
  }

  void build_below(const PrimIndex& root) {
    std::vector<Pending> pending{{&root, 0}};
    above_.clear();
    while (!pending.empty() && !batch_.full) {
      const Pending parent = pending.back();
      pending.pop_back();
      above_.resize(parent.depth);
      above_.push_back(parent.index);
      for (const Token name : parent.index->child_names) {
        const PrimIndex* const child = batch_.full ? nullptr : child_of(*parent.index, name);
        if (child != nullptr && !child->child_names.empty() && known_.enters(*child)) {
          pending.push_back({child, parent.depth + 1});
        }
      }
    }
  }

 private:
  struct Pending {
    const PrimIndex* index;
    std::size_t depth;  // below the root
  };

  /// Known or built; nullptr where it cannot be built ahead.
  const PrimIndex* child_of(const PrimIndex& parent, Token name) {
    const Path path = parent.path.child(name);
    if (const PrimIndex* const found = known_.index(path)) {
      return found;
    }
    if (batch_.indices.size() >= known_.max_indices || node_count_ >= known_.options->max_nodes ||
        work_.exhausted()) {
      batch_.complete = false;
      batch_.full = true;
      return nullptr;
    }
    IndexAhead& ahead = batch_.indices.emplace_back();
    ahead.index.path = path;
    const std::size_t nodes_before = node_count_;
    const std::size_t work_before = work_.done();
    gave_up_ = false;
    build_child_index(services_, parent, ahead.index);
    const std::size_t work = work_.done() - work_before;
    const std::size_t nodes = node_count_ - nodes_before;
    const bool fits = work <= std::numeric_limits<std::uint32_t>::max() &&
                      nodes <= std::numeric_limits<std::uint16_t>::max();
    std::vector<ArcCost> costs = work_.take_costs();
    if (!gave_up_ && fits && node_count_ < known_.options->max_nodes && !work_.exhausted()) {
      ahead.node_count = static_cast<std::uint16_t>(nodes);
      ahead.waits = true;
      ahead.work = static_cast<std::uint32_t>(work);
      if (!costs.empty()) {
        batch_.costs.emplace(&ahead, std::move(costs));
      }
      return &ahead.index;
    }
    batch_.complete = false;
    batch_.full = !gave_up_;
    twins_.forget_last();
    batch_.indices.pop_back();
    node_count_ = nodes_before;
    work_.restart(work_before);
    return nullptr;
  }

  /// What is being built will not be used; no arc needs to be followed any more.
  Error give_up() {
    gave_up_ = true;
    node_count_ = std::max(node_count_, known_.options->max_nodes);
    return Error(ErrorCode::NotFound, "not known yet");
  }

  const PrimIndex& index(Path path) {
    for (auto above = above_.rbegin(); above != above_.rend(); ++above) {
      if ((*above)->path == path) {
        return **above;
      }
    }
    if (const PrimIndex* const found = known_.index(path)) {
      return *found;
    }
    give_up();
    return *above_.front();
  }

  const KnownIndices& known_;
  IndexBatch& batch_;
  IndexServices services_;
  std::vector<const PrimIndex*> above_;  // the prims around the one that is built
  std::size_t node_count_ = 0;
  WorkMeter work_;
  Twins twins_;
  bool gave_up_ = false;
};

}  // namespace

std::vector<IndexBatch> build_ahead(const KnownIndices& known,
                                    const std::vector<const PrimIndex*>& roots) {
  std::vector<IndexBatch> batches(2);
  std::atomic<std::size_t> next = 0;
  const auto build = [&](IndexBatch& batch) {
    BatchBuilder builder(known, batch);
    builder.note(roots);
    for (std::size_t i = next++; i < roots.size(); i = next++) {
      builder.build_below(*roots[i]);
    }
  };
  run_both([&] { build(batches[0]); }, [&] { build(batches[1]); });
  return batches;
}

}  // namespace tenon::compose
