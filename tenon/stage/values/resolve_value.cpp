// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Core Spec 1.0.1 section 12 on value resolution. A block ends the search; an animation block hides
// weaker samples and splines and lets weaker defaults through. The steps are in value_search.h.
#include "tenon/stage/values/resolve_value.h"

#include "tenon/stage/interpolate.h"
#include "tenon/stage/values/compose_array_edits.h"
#include "tenon/stage/values/compose_expression.h"
#include "tenon/stage/values/evaluate_spline.h"
#include "tenon/stage/values/value_search.h"

namespace tenon::stage {
namespace {

using layer::Value;

// Represents a generated manifest; asset paths in it have no anchor.
const layer::Layer& no_layer() {
  static const layer::Layer layer("anon:generated_manifest.usda");
  return layer;
}

/// Looks at statements until one decides.
class PlainSearch : public ValueJudge {
 public:
  static constexpr bool kSeesAll = false;
  using ValueJudge::ValueJudge;
  bool looks_at_animation() const { return !hides_animation(); }
};

ResolvedValue searched(const PrimData& prim, Token name, Asked asked, ValueSources* passed) {
  ResolvedValue result;
  PlainSearch search(asked, result, passed);
  visit_statements(prim, name, asked, search);
  return result;
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
      result.declared = definition;
    }
  }
  return result;
}

const Value* value_in_place(const PrimData& prim, Token name) {
  static const Value none;
  const Value* authored = nullptr;
  prim.index->visit_property(name, [&](const compose::Opinion& opinion) {
    authored = opinion.spec->find(layer::fields::default_value);
    return authored != nullptr;
  });
  if (authored != nullptr) {
    return means_same_anywhere(*authored) ? authored : nullptr;
  }
  const schema::PropertyDefinition* definition = prim.definition->find(name);
  if (definition == nullptr || definition->fallback.empty()) {
    return &none;
  }
  return means_same_anywhere(definition->fallback) ? &definition->fallback : nullptr;
}

Value read_value(const StageData& stage, const PrimData& prim, Token name,
                 const ResolvedValue& resolved, Time time, AssetForm form, ReadTrace* trace) {
  Value value = read_one_value(stage, prim, resolved, time, form, stage.options.interpolation);
  return value.holds<layer::ArrayEdit>() ? compose_array_edits(stage, prim, name, time, form, trace)
                                         : value;
}

Value read_attribute(const StageData& stage, const PrimData& prim, Path proxy_path, Token name,
                     Time time, ReadTrace* trace) {
  Value value = read_value(stage, prim, name, resolve_value(prim, name, asked_at(time)), time,
                           AssetForm::Resolved, trace);
  if (value.type() != layer::ValueType::PathExpression) {
    return value;
  }
  return compose_expression(stage, prim, proxy_path, name, std::move(value), time, trace);
}

Value read_one_value(const StageData& stage, const PrimData& prim, const ResolvedValue& resolved,
                     Time time, AssetForm form, Interpolation interpolation) {
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
    case ValueSource::Fallback:
      return resolved.blocked ? Value() : resolved.declared->fallback;
    default:
      return {};
  }
}

}  // namespace tenon::stage
