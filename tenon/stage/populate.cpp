// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// From prim indexes to the tree of prims. Instances keep their own opinions; what is below them is
// populated once per instance key, under /__Prototype_N, from the index of one of the instances.
// Inactive prims end the walk. An explicit stack keeps deep trees off ours.
#include <algorithm>
#include <unordered_map>

#include "tenon/base/limits/fault_limits.h"
#include "tenon/base/parallel.h"
#include "tenon/compose/composition_error.h"
#include "tenon/schema/kinds.h"
#include "tenon/stage/composed_type.h"
#include "tenon/stage/instance_bound.h"
#include "tenon/stage/sources/prototype_sources.h"
#include "tenon/stage/stage_data.h"

namespace tenon::stage {
namespace {

using layer::Specifier;
namespace fields = layer::fields;

const compose::PrimIndex& empty_index() {
  static const compose::PrimIndex index;
  return index;
}

void set_flags(PrimData& prim, const PrimData& parent) {
  const compose::PrimIndex& index = *prim.index;
  prim.active = is_active(index);
  prim.loaded = prim.active && (index.has_payloads ? index.payload_loaded : parent.loaded);
  prim.specifier = composed_specifier(index);
  prim.abstract = parent.abstract || prim.specifier == Specifier::Class;
  prim.defined = parent.defined && prim.specifier != Specifier::Over;
  prim.model = prim.group = false;
  if (parent.group) {
    if (const Token* kind = strongest_opinion<Token>(index, fields::kind)) {
      prim.group = schema::is_kind(*kind, "group");
      prim.model = prim.group || schema::is_kind(*kind, "model");
    }
  }
}

void set_definition(StageData& data, PrimData& prim) {
  prim.definition =
      &data.definitions.get(composed_type_name(*prim.index), composed_api_schemas(*prim.index));
}

/// A prim behind all others. The first of a path counts.
std::uint32_t add_record(StageData& data, Path path) {
  data.prims.emplace_back().path = path;
  const auto number = static_cast<std::uint32_t>(data.prims.size());
  data.by_path.find_or_put(path, number, data.path_of());
  return number;
}

class Populator {
 public:
  explicit Populator(StageData& data)
      : data_(data), may_build_ahead_(data.options.mask.empty() && usable_processors() > 1) {}

  void run() {
    const std::uint32_t root = add(Path::absolute_root());
    data_.root = data_.numbered(root);
    data_.root->index = &data_.cache->index(data_.root->path);
    data_.root->specifier = Specifier::Def;
    data_.root->definition = &data_.definitions.get(Token(), {});
    add_findings(data_.root->index->extras().errors);
    pending_.push_back(root);
    while (!pending_.empty()) {
      build_ahead();
      const std::uint32_t parent = pending_.back();
      pending_.pop_back();
      add_children(parent);
    }
  }

 private:
  std::uint32_t add(Path path) { return add_record(data_, path); }

  /// Has the indices of all that is still to be walked built on two threads, once it seems to be
  /// worth it. What needed a layer that was not open is tried again when twice as much is there.
  void build_ahead() {
    constexpr std::size_t kWorthTwoThreads = 256;  // prims
    const std::size_t count = data_.prims.size();
    if (count < std::max(kWorthTwoThreads, next_ahead_) || count >= data_.options.max_prims ||
        pending_.size() < 2 || built_ahead_ || !may_build_ahead_) {
      return;
    }
    std::vector<const compose::PrimIndex*> roots;
    for (auto walked = pending_.rbegin(); walked != pending_.rend(); ++walked) {
      roots.push_back(&data_.cache->index(data_.numbered(*walked)->source_path()));
    }
    const auto enters = [](const compose::PrimIndex& index) {
      return !index.instanceable && is_active(index);
    };
    built_ahead_ = data_.cache->build_below(roots, enters, data_.options.max_prims - count);
    next_ahead_ = 2 * count;
  }

  void add_children(std::uint32_t parent_number) {
    PrimData& parent = *data_.numbered(parent_number);
    const compose::PrimIndex& index =
        parent.is_prototype_root ? data_.cache->index(parent.source_path()) : *parent.index;
    std::uint32_t* next_place = &parent.first_child;
    for (const Token name : index.child_names) {
      const Path path = parent.path.child(name);
      const Path source_path = index.path == parent.path ? path : index.path.child(name);
      if (!is_in_mask(data_.options.mask, source_path)) {
        continue;
      }
      if (data_.prims.size() >= data_.options.max_prims) {
        report_too_many(path);
        break;
      }
      *next_place = add_prim(parent_number, index, path);
      next_place = &data_.numbered(*next_place)->next_sibling;
    }
    std::vector<std::uint32_t> next;
    for (std::uint32_t number = parent.first_child; number != 0;) {
      PrimData& child = *data_.numbered(number);
      if (child.active) {
        next.push_back(child.index->instanceable ? use_prototype(child) : number);
      }
      number = child.next_sibling;
    }
    std::erase(next, 0u);
    // Last in, first out: the first child is walked first.
    pending_.insert(pending_.end(), next.rbegin(), next.rend());
  }

  /// Arcs that multiply give the same finding for every prim that they bring in.
  void add_findings(const Diagnostics& found) {
    for (const Diagnostic& one : found.items()) {
      // An incomplete stage is reported in any case.
      if (data_.diagnostics.size() < limits::kStageFindings || compose::is_work_exceeded(one)) {
        data_.diagnostics.add(one);
      } else if (!too_many_findings_reported_) {
        too_many_findings_reported_ = true;
        report_too_many_findings();
      }
    }
  }

  void report_too_many_findings() {
    Diagnostic last;
    last.rule = "stage.too-many-findings";
    last.message = "there are more than " + std::to_string(limits::kStageFindings) +
                   " findings of composition; no more are given";
    last.file = data_.cache->layer_stack()->identifier();
    last.fix = "fix the first of them";
    data_.diagnostics.add(std::move(last));
  }

  void report_too_many(Path path) {
    if (!too_many_reported_) {
      too_many_reported_ = true;
      Diagnostic diagnostic;
      diagnostic.rule = "stage.too-many-prims";
      diagnostic.message = "the stage has more than " + std::to_string(data_.options.max_prims) +
                           " prims; those from <" + path.str() + "> on are skipped";
      diagnostic.file = data_.cache->layer_stack()->identifier();
      diagnostic.prim = path.str();
      diagnostic.fix = "reduce the references that multiply with each other, or make instances";
      data_.diagnostics.add(std::move(diagnostic));
    }
  }

  /// The prototype when it is new and must be walked; 0: it is not.
  std::uint32_t use_prototype(PrimData& instance) {
    Diagnostics known;  // from when the instance was added
    const std::vector<ClipDefinition> clips = own_clip_definitions(data_, *instance.index, known);
    const std::string key = prototype_key(data_, *instance.index, clips);
    const auto [it, inserted] = data_.prototype_of_key.try_emplace(key, nullptr);
    std::uint32_t number = 0;
    if (inserted) {
      const std::string name = "__Prototype_" + std::to_string(data_.prototypes.size() + 1);
      number = add(Path::absolute_root().child(Token(name)));
      PrimData& root = *data_.numbered(number);
      root.index = &empty_index();
      root.definition = &data_.definitions.get(Token(), {});
      root.parent = 1;  // the pseudo-root, which comes first
      root.specifier = Specifier::Def;
      root.is_prototype_root = true;
      root.in_prototype = true;
      root.extras = &data_.extras.emplace_back(PrimExtras{
          nullptr, add_clips(clips, nullptr, instance.path, known), source_of(key, instance)});
      data_.prototypes.push_back(&root);
      built_ahead_ = false;
      it->second = &root;
    }
    instance.extras = &data_.extras.emplace_back(PrimExtras{it->second, instance.clips(), Path()});
    return number;
  }

  Path source_of(const std::string& key, const PrimData& instance) {
    if (sources_.empty()) {
      sources_ = prototype_sources(data_);
    }
    const auto found = sources_.find(key);
    return found == sources_.end() ? instance.source_path() : found->second;
  }

  std::uint32_t add_prim(std::uint32_t parent_number, const compose::PrimIndex& source, Path path) {
    const std::uint32_t number = add(path);
    PrimData& prim = *data_.numbered(number);
    const PrimData& parent = *data_.numbered(parent_number);
    prim.index = &data_.cache->child_index(source, path.name());
    prim.parent = parent_number;
    prim.in_prototype = parent.in_prototype;
    add_findings(prim.index->extras().errors);
    set_flags(prim, parent);
    const ClipSets* const clips =
        add_clips(own_clip_definitions(data_, *prim.index, data_.diagnostics), parent.clips(), path,
                  data_.diagnostics);
    prim.extras = clips == nullptr ? nullptr : extras_with(*clips, parent);
    set_definition(data_, prim);
    return number;
  }

  /// Those of the parent where they have nothing else.
  const PrimExtras* extras_with(const ClipSets& clips, const PrimData& parent) {
    const bool same =
        parent.clips() == &clips && !parent.is_instance() && !parent.is_prototype_root;
    return same ? parent.extras : &data_.extras.emplace_back(PrimExtras{nullptr, &clips, Path()});
  }

  const ClipSets* add_clips(const std::vector<ClipDefinition>& definitions,
                            const ClipSets* inherited, Path path, Diagnostics& diagnostics) {
    if (definitions.empty()) {
      return inherited;
    }
    ClipSets sets = clip_sets(definitions, inherited, *data_.clip_layers, path.str(), diagnostics);
    return sets.empty() ? nullptr : &data_.clip_sets.emplace_back(std::move(sets));
  }

  StageData& data_;
  const bool may_build_ahead_;                     // asked of the system once, not for every prim
  std::unordered_map<std::string, Path> sources_;  // of prototypes; filled for the first instance
  bool too_many_reported_ = false;
  bool too_many_findings_reported_ = false;
  std::vector<std::uint32_t> pending_;  // numbers of prims
  bool built_ahead_ = false;            // the indices of all that is below `pending_`
  std::size_t next_ahead_ = 0;
};

}  // namespace

void populate(StageData& data) {
  Populator(data).run();
  bound_instances(data);
}

std::uint32_t add_plain_child(StageData& data, std::uint32_t parent_number, Token name) {
  const PrimData& parent = *data.numbered(parent_number);
  const compose::PrimIndex& index = data.cache->child_index(*parent.index, name);
  if (parent.extras != nullptr || index.instanceable || !index.extras().errors.empty() ||
      data.record(index.path) != nullptr || data.prims.size() >= data.options.max_prims) {
    return 0;
  }
  const std::uint32_t number = add_record(data, index.path);
  PrimData& prim = *data.numbered(number);
  prim.index = &index;
  prim.parent = parent_number;
  set_flags(prim, parent);
  set_definition(data, prim);
  return number;
}

}  // namespace tenon::stage
