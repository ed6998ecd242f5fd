// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/layer/fields.h"
#include "tenon/stage/values/compose_array_edits.h"

/// The steps of value resolution: in which order statements about a value are looked at, and what
/// becomes of each. resolve_value.cpp takes them until one decides, trace_value.cpp to the end.
/// Internal to tenon/stage.
namespace tenon::stage {

/// One thing said about a value: by a field of a layer's spec or by a clip set.
struct Statement {
  ValueSource kind = ValueSource::None;  ///< None: a spec without a value
  const compose::Opinion& opinion;       ///< of clips: node, layer and path without a spec
  const layer::Value* value = nullptr;   ///< the field's
  const ClipSet* clips = nullptr;
};

enum class Verdict : unsigned char {
  SaysNothing,      ///< samples without a sample, a spline without a knot
  Hidden,           ///< animation below an animation block or at the default time
  BlocksAnimation,  ///< an animation block: weaker defaults still count
  Edits,            ///< may edit an array of weaker layers: these are looked at next
  Decides,
};

/// Judges statements one by one, strongest first; after one that decides there is no other.
class ValueJudge {
 public:
  /// What decides goes into `result`: nothing, or a block, where no statement gives a value.
  /// Sources that may edit weaker ones go into `passed`; where it is null they decide.
  ValueJudge(Asked asked, ResolvedValue& result, ValueSources* passed)
      : result_(result),
        at_default_(asked == Asked::DefaultTime),
        hides_animation_(at_default_),
        passed_(passed) {}

  Verdict take(const Statement& statement);
  /// Samples and splines no longer count.
  bool hides_animation() const { return hides_animation_; }

 private:
  Verdict take_samples(const Statement& statement);
  Verdict take_spline(const Statement& statement);
  Verdict take_default(const Statement& statement);
  Verdict found(const Statement& statement);

  ResolvedValue& result_;
  bool at_default_;
  bool hides_animation_;
  ValueSources* passed_;
};

inline Verdict ValueJudge::found(const Statement& statement) {
  result_.source = statement.kind;
  result_.opinion = statement.opinion;
  if (passed_ == nullptr || !may_edit(result_)) {
    return Verdict::Decides;
  }
  passed_->push_back(result_);
  result_ = ResolvedValue();
  return Verdict::Edits;
}

inline Verdict ValueJudge::take_samples(const Statement& statement) {
  const auto* samples = statement.value->get<layer::TimeSamples>();
  if (hides_animation_ || samples == nullptr || samples->empty()) {
    return hides_animation_ ? Verdict::Hidden : Verdict::SaysNothing;
  }
  result_.samples = samples;
  return found(statement);
}

inline Verdict ValueJudge::take_spline(const Statement& statement) {
  const auto* spline = statement.value->get<layer::Spline>();
  if (hides_animation_ || spline == nullptr || spline->knots.empty()) {
    return hides_animation_ ? Verdict::Hidden : Verdict::SaysNothing;
  }
  result_.spline = spline;
  return found(statement);
}

inline Verdict ValueJudge::take_default(const Statement& statement) {
  if (statement.value->holds<layer::AnimationBlock>()) {
    hides_animation_ = true;
    return Verdict::BlocksAnimation;
  }
  if (statement.value->is_block()) {
    result_.blocked = true;
    return Verdict::Decides;
  }
  result_.value = statement.value;
  return found(statement);
}

inline Verdict ValueJudge::take(const Statement& statement) {
  switch (statement.kind) {
    case ValueSource::TimeSamples:
      return take_samples(statement);
    case ValueSource::Spline:
      return take_spline(statement);
    case ValueSource::Default:
      return take_default(statement);
    case ValueSource::ValueClips:
      if (at_default_) {
        return Verdict::Hidden;
      }
      result_.clips = statement.clips;
      return found(statement);
    default:
      return Verdict::SaysNothing;
  }
}

/// A search is what statements are shown to: `take(statement)` says what becomes of one,
/// `looks_at_animation()` whether samples and splines are wanted. `kSeesAll`: it is shown every
/// statement, specs without a value and clips at the default time included.
///
/// The fields of one spec. True when the search ends.
template <class Search>
bool visit_spec(const compose::Opinion& opinion, Search& search) {
  const auto show = [&](ValueSource kind, Token field, Verdict& verdict) {
    const layer::Value* value = opinion.spec->find(field);
    if (value == nullptr) {
      return false;
    }
    verdict = search.take({kind, opinion, value});
    return true;
  };
  Verdict verdict = Verdict::SaysNothing;
  bool said = false;
  if (search.looks_at_animation()) {
    said = show(ValueSource::TimeSamples, layer::fields::timeSamples, verdict);
    if (verdict < Verdict::Edits) {
      said |= show(ValueSource::Spline, layer::fields::spline, verdict);
    }
    if (verdict >= Verdict::Edits) {
      return verdict == Verdict::Decides;
    }
  }
  said |= show(ValueSource::Default, layer::fields::default_value, verdict);
  if constexpr (Search::kSeesAll) {
    if (!said) {
      search.take({ValueSource::None, opinion});
    }
  }
  return verdict == Verdict::Decides;
}

/// The layers of one node, each with the clips that come in there, which also count where no layer
/// has a spec. True when the search ends.
template <class Search>
bool visit_node(const compose::Node& node, compose::Opinion opinion,
                const std::vector<const ClipSet*>& sets, Search& search) {
  for (const compose::StackedLayer& stacked : node.layer_stack->layers) {
    opinion.layer = stacked.layer.get();
    opinion.offset = node.map_to_root->offset() * stacked.offset;
    opinion.spec = node.has_specs ? stacked.layer->find(opinion.path) : nullptr;
    if (opinion.spec != nullptr && visit_spec(opinion, search)) {
      return true;
    }
    for (const ClipSet* set : sets) {
      if (&set->layer() == opinion.layer &&
          search.take({ValueSource::ValueClips, opinion, nullptr, set}) == Verdict::Decides) {
        return true;
      }
    }
  }
  return false;
}

/// The same for a prim with clips.
template <class Search>
void visit_nodes(const PrimData& prim, Token name, Search& search) {
  const auto& nodes = prim.index->nodes();
  for (std::uint32_t id = 0; id < nodes.size(); ++id) {
    const compose::Node& node = nodes[id];
    if (!node.can_contribute()) {
      continue;
    }
    compose::Opinion opinion;
    opinion.node = id;
    opinion.path = node.path.property(name);
    std::vector<const ClipSet*> sets;
    for (const auto& set : *prim.clips()) {
      if (set->applies_to(node) && set->declares(opinion.path)) {
        sets.push_back(set.get());
      }
    }
    if ((node.has_specs || !sets.empty()) && visit_node(node, opinion, sets, search)) {
      return;
    }
  }
}

/// Shows the statements about an attribute's value, strongest first, until one decides.
template <class Search>
void visit_statements(const PrimData& prim, Token name, Asked asked, Search& search) {
  if (prim.clips() != nullptr && (Search::kSeesAll || asked == Asked::AnyTime)) {
    visit_nodes(prim, name, search);
  } else {
    visit_property_opinions(
        prim, name, [&](const compose::Opinion& opinion) { return visit_spec(opinion, search); });
  }
}

}  // namespace tenon::stage
