// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Core Spec 1.0.1 section 12 on value resolution. A block ends the search; an animation block hides
// weaker samples and splines and lets weaker defaults through.
#include "tenon/stage/resolve_value.h"

#include "tenon/stage/compose_array_edits.h"
#include "tenon/stage/evaluate_spline.h"
#include "tenon/stage/interpolate.h"

namespace tenon::stage {
namespace {

using layer::Value;
namespace fields = layer::fields;

// What stands for a manifest that was generated; asset paths start from nowhere in it.
const layer::Layer& no_layer() {
  static const layer::Layer layer("anon:generated_manifest.usda");
  return layer;
}

// True when this opinion decides.
bool take_animation(const compose::Opinion& opinion, ResolvedValue& result) {
  const auto* samples = opinion.spec->get<layer::TimeSamples>(fields::timeSamples);
  if (samples != nullptr && !samples->empty()) {
    result.source = ValueSource::TimeSamples;
    result.samples = samples;
    return true;
  }
  const auto* spline = opinion.spec->get<layer::Spline>(fields::spline);
  if (spline != nullptr && !spline->knots.empty()) {
    result.source = ValueSource::Spline;
    result.spline = spline;
    return true;
  }
  return false;
}

struct Search {
  ResolvedValue result;
  bool animation_blocked = false;
  ValueSources* passed = nullptr;  // where sources go that may edit weaker ones, if they are asked

  // True when this opinion decides.
  bool take(const compose::Opinion& opinion) { return take_opinion(opinion) && !pass(); }

  // True when the search goes on below what was found.
  bool pass() {
    if (passed == nullptr || !may_edit(result)) {
      return false;
    }
    passed->push_back(result);
    result = ResolvedValue();
    return true;
  }

  bool take_opinion(const compose::Opinion& opinion) {
    if (!animation_blocked && take_animation(opinion, result)) {
      result.opinion = opinion;
      return true;
    }
    const Value* value = opinion.spec->find(fields::default_value);
    if (value == nullptr) {
      return false;
    }
    if (value->holds<layer::AnimationBlock>()) {
      animation_blocked = true;
      return false;
    }
    result.blocked = value->is_block();
    if (!result.blocked) {
      result.source = ValueSource::Default;
      result.value = value;
      result.opinion = opinion;
    }
    return true;
  }

  // One node's layers; clips also count where no layer has a spec.
  bool take_node(const compose::Node& node, std::uint32_t id, Token name,
                 const std::vector<const ClipSet*>& sets) {
    compose::Opinion opinion;
    opinion.node = id;
    opinion.path = node.path.property(name);
    for (const compose::StackedLayer& stacked : node.layer_stack->layers) {
      opinion.layer = stacked.layer.get();
      opinion.offset = node.map_to_root->offset() * stacked.offset;
      opinion.spec = node.has_specs ? stacked.layer->find(opinion.path) : nullptr;
      if (opinion.spec != nullptr && take(opinion)) {
        return true;
      }
      for (const ClipSet* set : sets) {
        if (&set->layer() == opinion.layer) {
          result.source = ValueSource::ValueClips;
          result.clips = set;
          result.opinion = opinion;
          if (!pass()) {
            return true;
          }
        }
      }
    }
    return false;
  }

  void take_nodes(const PrimData& prim, Token name) {
    const std::vector<compose::Node>& nodes = prim.index->nodes;
    for (std::uint32_t id = 0; id < nodes.size(); ++id) {
      const compose::Node& node = nodes[id];
      if (!node.can_contribute()) {
        continue;
      }
      std::vector<const ClipSet*> sets;
      for (const auto& set : *prim.clips) {
        if (set->applies_to(node) && set->declares(node.path.property(name))) {
          sets.push_back(set.get());
        }
      }
      if ((node.has_specs || !sets.empty()) && take_node(node, id, name, sets)) {
        return;
      }
    }
  }
};

ResolvedValue searched(const PrimData& prim, Token name, Asked asked, ValueSources* passed) {
  Search search;
  search.animation_blocked = asked == Asked::DefaultTime;
  search.passed = passed;
  if (prim.clips != nullptr && asked == Asked::AnyTime) {
    search.take_nodes(prim, name);
  } else {
    visit_property_opinions(prim, name,
                            [&](const compose::Opinion& opinion) { return search.take(opinion); });
  }
  return search.result;
}

}  // namespace

ValueSources value_sources(const PrimData& prim, Token name, Asked asked) {
  ValueSources sources;
  ResolvedValue last = searched(prim, name, asked, &sources);
  sources.push_back(last);
  return sources;
}

ResolvedValue resolve_value(const PrimData& prim, Token name, Asked asked) {
  ResolvedValue result = searched(prim, name, asked, nullptr);
  if (result.source == ValueSource::None) {
    const schema::PropertyDefinition* definition = prim.definition->find(name);
    if (definition != nullptr && !definition->fallback.empty()) {
      result.source = ValueSource::Fallback;
    }
  }
  return result;
}

Value read_value(const StageData& stage, const PrimData& prim, Token name,
                 const ResolvedValue& resolved, Time time, AssetForm form) {
  Value value =
      read_one_value(stage, prim, name, resolved, time, form, stage.options.interpolation);
  return value.holds<layer::ArrayEdit>() ? compose_array_edits(stage, prim, name, time, form)
                                         : value;
}

Value read_one_value(const StageData& stage, const PrimData& prim, Token name,
                     const ResolvedValue& resolved, Time time, AssetForm form,
                     Interpolation interpolation) {
  switch (resolved.source) {
    case ValueSource::Default:
      return localize(stage, prim, resolved.opinion, *resolved.value, form);
    case ValueSource::TimeSamples: {
      const Value value =
          value_at(*resolved.samples, resolved.opinion.offset, time.code(), interpolation);
      return value.is_block() ? Value() : localize(stage, prim, resolved.opinion, value, form);
    }
    case ValueSource::Spline: {
      const double at = layer_time(resolved.opinion.offset, time.code());
      return localize(stage, prim, resolved.opinion, evaluate_spline(*resolved.spline, at));
    }
    case ValueSource::ValueClips: {
      const ClipSet::Found found =
          resolved.clips->value_at(resolved.opinion.path, time.code(), interpolation);
      compose::Opinion opinion = resolved.opinion;
      opinion.layer = found.anchor == nullptr ? &no_layer() : found.anchor;
      opinion.offset = resolved.clips->offset();
      return localize(stage, prim, opinion, found.value, form);
    }
    case ValueSource::Fallback: {
      const schema::PropertyDefinition* declared = prim.definition->find(name);
      return resolved.blocked || declared == nullptr ? Value() : declared->fallback;
    }
    default:
      return {};
  }
}

}  // namespace tenon::stage
