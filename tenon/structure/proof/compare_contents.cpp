// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The expected content is walked for what is missing or differs in the other, then the other one
// for what is new in it, so equality holds both ways. Order, prims that are off, blocks and empty
// lists do not count, nor does `custom`. One disagreement refutes the proof, so the first is
// enough.
#include <algorithm>

#include "tenon/formats/text/write/value_text.h"
#include "tenon/layer/fields.h"
#include "tenon/layer/time/time_samples.h"
#include "tenon/structure/layer_tree.h"
#include "tenon/structure/proof/proof.h"

namespace tenon::structure {
namespace {

namespace fields = layer::fields;
using layer::Layer;
using layer::Spec;

/// Fields that say how, not what: compared elsewhere or of no meaning in a composed scene.
bool is_passed_over(Token field) {
  return field == fields::primChildren || field == fields::properties ||
         field == fields::apiSchemas || field == fields::active || field == fields::primOrder ||
         field == fields::propertyOrder || field == fields::targetPaths ||
         field == fields::connectionPaths || field == fields::custom;
}

/// Blocked, empty, or what holds where nothing is authored: relationships are uniform.
bool is_nothing(const Spec& spec, Token field, const layer::Value& value) {
  if (field == fields::variability) {
    const bool uniform = spec.kind == layer::SpecKind::Relationship;
    const auto fallback = uniform ? layer::Variability::Uniform : layer::Variability::Varying;
    return value.get_or(fallback) == fallback;
  }
  return value.is_block() || value.empty();
}

bool is_there(const Layer& content, Path prim) {
  return content.has(prim) && is_active(content, prim);
}

class Comparison {
 public:
  Comparison(const Layer& expected, const Layer& found) : expected_(expected), found_(found) {}

  std::optional<Disagreement> run() {
    for (const Path& prim : prims_below(expected_)) {
      if (is_active(expected_, prim)) {
        compare_prims(prim);
      }
    }
    for (const Path& prim : prims_below(found_)) {
      if (is_active(found_, prim) && !is_there(expected_, prim)) {
        report(prim, Token(), "the source has no such prim");
      }
    }
    return std::move(first_);
  }

 private:
  void report(Path prim, Token property, std::string what) {
    if (!first_) {
      first_ = Disagreement{prim.str(), property.str(), std::move(what)};
    }
  }

  void compare_prims(Path prim) {
    if (!is_there(found_, prim)) {
      report(prim, Token(), "the prim is missing");
      return;
    }
    compare_fields(prim, Token(), *expected_.find(prim), *found_.find(prim));
    std::vector<Token> a = apis_of(expected_, prim);
    std::vector<Token> b = apis_of(found_, prim);
    std::sort(a.begin(), a.end());
    std::sort(b.begin(), b.end());
    if (a != b) {
      report(prim, Token(), "the API schemas differ");
    }
    for (const Path& property : properties_of(expected_, prim)) {
      compare_properties(prim, property);
    }
    for (const Path& property : properties_of(found_, prim)) {
      if (!expected_.has(property) && says_something(*found_.find(property))) {
        report(prim, property.name(), "the source does not author it");
      }
    }
  }

  void compare_properties(Path prim, Path property) {
    const Spec& expected = *expected_.find(property);
    const Spec* found = found_.find(property);
    if (found == nullptr) {
      if (says_something(expected)) {
        report(prim, property.name(), "the property is missing");
      }
      return;
    }
    if (found->kind != expected.kind || targets_of(*found) != targets_of(expected)) {
      report(prim, property.name(), "the targets differ");
    }
    compare_fields(prim, property.name(), expected, *found);
  }

  void compare_fields(Path prim, Token property, const Spec& expected, const Spec& found) {
    for (const layer::Field& field : expected.fields()) {
      const layer::Value* other = found.find(field.name);
      if (is_passed_over(field.name) || is_nothing(expected, field.name, field.value)) {
        continue;
      }
      if (other == nullptr || !are_same(*other, field.value)) {
        report(prim, property, "\"" + field.name.str() + "\" differs");
      }
    }
    for (const layer::Field& field : found.fields()) {
      if (is_passed_over(field.name) || is_nothing(found, field.name, field.value)) {
        continue;
      }
      const layer::Value* other = expected.find(field.name);
      if (other == nullptr || is_nothing(expected, field.name, *other)) {
        report(prim, property, "\"" + field.name.str() + "\" is new");
      }
    }
  }

  /// Equal, or unequal only because NaN is unequal to itself: then they are of one type and the
  /// same in text, where each number has its own.
  static bool are_same(const layer::Value& a, const layer::Value& b) {
    if (a == b || a.type() != b.type() || a.is_array() != b.is_array()) {
      return a == b;
    }
    const auto* samples = a.get<layer::TimeSamples>();
    if (samples == nullptr) {
      return !a.holds<layer::Dictionary>() && formats::value_text(a) == formats::value_text(b);
    }
    const auto& others = *b.get<layer::TimeSamples>();
    bool same = samples->times == others.times;
    for (std::size_t i = 0; same && i < samples->size(); ++i) {
      same = are_same(samples->values[i], others.values[i]);
    }
    return same;
  }

  static bool says_something(const Spec& property) {
    for (const layer::Field& field : property.fields()) {
      const bool value = field.name == fields::default_value || field.name == fields::timeSamples ||
                         field.name == fields::spline;
      if (value && !is_nothing(property, field.name, field.value)) {
        return true;
      }
    }
    return !targets_of(property).empty();
  }

  const Layer& expected_;
  const Layer& found_;
  std::optional<Disagreement> first_;
};

}  // namespace

Error differs(const std::string& variant, const Disagreement& where, const char* of) {
  Diagnostic diagnostic;
  diagnostic.severity = Severity::Error;
  diagnostic.rule = "structure.differs";
  diagnostic.message = std::string("the structured asset would not be the same: ") + of +
                       " under " + variant + ": " + where.what;
  diagnostic.prim = where.prim;
  diagnostic.property = where.property;
  diagnostic.fix = "nothing was written; please report the asset";
  return {ErrorCode::Invalid, std::move(diagnostic)};
}

std::optional<Disagreement> compare_contents(const Layer& expected, const Layer& found) {
  return Comparison(expected, found).run();
}

}  // namespace tenon::structure
