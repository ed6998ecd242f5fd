// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// An attribute is a name on a prim: it holds no value, and each question goes to the opinions in
// the index of the prim. What a stock schema declares beats what layers say about type, variability
// and custom. Without such a declaration the strongest opinion gives the type and, as in OpenUSD,
// the weakest one the variability. Declarations of vendors, which stock OpenUSD does not know,
// count only where no layer says anything. resolve_value.cpp decides which opinion gives the value.
#include "tenon/stage/attribute.h"

#include <algorithm>

#include "tenon/stage/composed_fields.h"
#include "tenon/stage/property_facts.h"
#include "tenon/stage/stage_data.h"
#include "tenon/stage/values/compose_array_edits.h"
#include "tenon/stage/values/evaluate_spline.h"
#include "tenon/stage/values/resolve_value.h"
#include "tenon/stage/values/trace_value.h"

namespace tenon::stage {

using layer::Value;
namespace fields = layer::fields;

namespace {

const schema::PropertyDefinition* stock_definition(const PrimData& prim, Token name) {
  const schema::PropertyDefinition* found = prim.definition->find_stock(name);
  return found == nullptr || found->is_relationship ? nullptr : found;
}

}  // namespace

const schema::PropertyDefinition* Attribute::definition() const {
  if (prim_ == nullptr) {
    return nullptr;
  }
  const schema::PropertyDefinition* found = prim_->definition->find(name_);
  return found == nullptr || found->is_relationship ? nullptr : found;
}

bool Attribute::is_defined() const { return definition() != nullptr || is_authored(); }

Token Attribute::type_name() const {
  if (prim_ == nullptr) {
    return {};
  }
  if (const schema::PropertyDefinition* declared = stock_definition(*prim_, name_)) {
    return declared->type_name;
  }
  Token result;
  visit_property_opinions(*prim_, name_, [&](const compose::Opinion& opinion) {
    result = opinion.spec->get_or<Token>(fields::typeName, Token());
    return !result.empty();
  });
  const schema::PropertyDefinition* declared = definition();
  return result.empty() && declared != nullptr ? declared->type_name : result;
}

layer::Variability Attribute::variability() const {
  if (prim_ == nullptr) {
    return layer::Variability::Varying;
  }
  if (const schema::PropertyDefinition* declared = stock_definition(*prim_, name_)) {
    return declared->variability;
  }
  const schema::PropertyDefinition* declared = definition();
  layer::Variability result =
      declared == nullptr ? layer::Variability::Varying : declared->variability;
  visit_property_opinions(*prim_, name_, [&](const compose::Opinion& opinion) {
    result = opinion.spec->get_or(fields::variability, layer::Variability::Varying);
    return false;
  });
  return result;
}

bool Attribute::is_custom() const {
  return prim_ != nullptr && stock_definition(*prim_, name_) == nullptr &&
         any_opinion_is_custom(*prim_, name_);
}

Value Attribute::get(Time time) const {
  return prim_ == nullptr ? Value() : read_attribute(*stage_, *prim_, proxy_path_, name_, time);
}

const Value* Attribute::value_in_place() const {
  return prim_ == nullptr ? nullptr : stage::value_in_place(*prim_, name_);
}

ValueTrace Attribute::trace(Time time) const {
  return prim_ == nullptr ? ValueTrace() : trace_value(*stage_, *prim_, proxy_path_, name_, time);
}

Value Attribute::fallback() const {
  const schema::PropertyDefinition* declared = definition();
  return declared == nullptr ? Value() : declared->fallback;
}

ValueSource Attribute::value_source(Time time) const {
  return prim_ == nullptr ? ValueSource::None : resolve_value(*prim_, name_, asked_at(time)).source;
}

bool Attribute::has_authored_value() const {
  if (prim_ == nullptr || (prim_->clips() == nullptr && !prim_->index->may_have_property(name_))) {
    return false;
  }
  const ValueSource source = resolve_value(*prim_, name_, Asked::AnyTime).source;
  return source != ValueSource::None && source != ValueSource::Fallback;
}

bool Attribute::is_blocked(Time time) const {
  return prim_ != nullptr && resolve_value(*prim_, name_, asked_at(time)).blocked;
}

std::vector<double> Attribute::time_samples() const {
  std::vector<double> result;
  if (prim_ != nullptr) {
    const ResolvedValue resolved = resolve_value(*prim_, name_, Asked::AnyTime);
    if (may_edit(resolved)) {
      return edited_times(*stage_, *prim_, value_sources(*prim_, name_, Asked::AnyTime));
    }
    if (resolved.samples != nullptr) {
      for (const double time : resolved.samples->times) {
        result.push_back(resolved.opinion.offset.apply(time));
      }
    }
  }
  return result;
}

bool Attribute::is_animated() const {
  if (prim_ == nullptr) {
    return false;
  }
  const ResolvedValue resolved = resolve_value(*prim_, name_, Asked::AnyTime);
  if (resolved.clips != nullptr) {
    return resolved.clips->may_vary(resolved.opinion.path);
  }
  if (may_edit(resolved)) {
    const ValueSources sources = value_sources(*prim_, name_, Asked::AnyTime);
    return std::any_of(sources.begin(), sources.end(), [](const ResolvedValue& source) {
      return source.samples != nullptr || source.clips != nullptr;
    });
  }
  return resolved.spline != nullptr ||
         (resolved.samples != nullptr && resolved.samples->size() > 1);
}

std::optional<layer::Spline> Attribute::spline() const {
  if (prim_ == nullptr) {
    return std::nullopt;
  }
  const ResolvedValue resolved = resolve_value(*prim_, name_, Asked::AnyTime);
  return resolved.spline == nullptr
             ? std::nullopt
             : std::optional(moved_spline(*resolved.spline, resolved.opinion.offset));
}

bool Attribute::has_authored_connections() const {
  return prim_ != nullptr && has_field(*prim_, name_, fields::connectionPaths);
}

Value Attribute::metadata(Token field) const {
  if (prim_ == nullptr) {
    return {};
  }
  if (field == fields::typeName) {
    return type_name();
  }
  if (field == fields::variability) {
    return variability();
  }
  if (field == fields::custom) {
    return is_custom();
  }
  Value authored = compose_field(*stage_, *prim_, property_opinions(*prim_, name_), field);
  const schema::PropertyDefinition* declared = definition();
  if (authored.empty() && field == fields::allowedTokens && declared != nullptr &&
      !declared->allowed_tokens.empty()) {
    return declared->allowed_tokens;
  }
  return authored;
}

}  // namespace tenon::stage
