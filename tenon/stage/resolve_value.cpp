// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Core Spec 1.0.1 section 12 on value resolution. A block ends the search; an animation block hides
// weaker samples and splines and lets weaker defaults through.
#include "tenon/stage/resolve_value.h"

#include "tenon/stage/evaluate_spline.h"
#include "tenon/stage/interpolate.h"

namespace tenon::stage {
namespace {

using layer::Value;
namespace fields = layer::fields;

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

}  // namespace

ResolvedValue resolve_value(const PrimData& prim, Token name, Asked asked) {
  ResolvedValue result;
  bool animation_blocked = asked == Asked::DefaultTime;
  visit_property_opinions(prim, name, [&](const compose::Opinion& opinion) {
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
  });
  if (result.source == ValueSource::None) {
    const schema::PropertyDefinition* definition = prim.definition->find(name);
    if (definition != nullptr && !definition->fallback.empty()) {
      result.source = ValueSource::Fallback;
    }
  }
  return result;
}

Value read_value(const StageData& stage, const PrimData& prim, Token name,
                 const ResolvedValue& resolved, Time time) {
  switch (resolved.source) {
    case ValueSource::Default:
      return localize(stage, prim, resolved.opinion, *resolved.value);
    case ValueSource::TimeSamples: {
      const double at = resolved.opinion.offset.inverse().apply(time.code());
      const Value value = value_at(*resolved.samples, at);
      return value.is_block() ? Value() : localize(stage, prim, resolved.opinion, value);
    }
    case ValueSource::Spline: {
      const double at = resolved.opinion.offset.inverse().apply(time.code());
      return localize(stage, prim, resolved.opinion, evaluate_spline(*resolved.spline, at));
    }
    case ValueSource::Fallback:
      return resolved.blocked ? Value() : prim.definition->find(name)->fallback;
    default:
      return {};
  }
}

}  // namespace tenon::stage
