// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/answers/difference_json.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "tenon/answers/or_null.h"
#include "tenon/formats/text/write/value_text.h"
#include "tenon/layer/value.h"

namespace tenon::answers {
namespace {

constexpr std::size_t kLongestSide = 100;  ///< characters of a value in a line

Json side_json(const layer::Value& value) {
  return value.empty() ? Json(nullptr) : Json(shown_side(value));
}

Json fact_json(const scene::Fact& fact) {
  if (fact.name.empty()) {
    return nullptr;
  }
  if (fact.numbers.empty()) {
    return fact.word;
  }
  if (fact.numbers.size() == 1) {
    return finite_or_null(fact.numbers.front());
  }
  Json numbers = Json::array();
  for (const double number : fact.numbers) {
    numbers.push_back(finite_or_null(number));
  }
  return numbers;
}

}  // namespace

std::string shown_side(const layer::Value& value) {
  std::string text = formats::value_text(value);
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text.size() <= kLongestSide ? text : text.substr(0, kLongestSide) + " ...";
}

const char* spec_kind_name(layer::SpecKind kind) {
  switch (kind) {
    case layer::SpecKind::PseudoRoot:
      return "layer";
    case layer::SpecKind::Prim:
      return "prim";
    case layer::SpecKind::Attribute:
      return "attribute";
    case layer::SpecKind::Relationship:
      return "relationship";
    case layer::SpecKind::VariantSet:
      return "variant set";
    case layer::SpecKind::Variant:
      return "variant";
    default:
      return "spec";
  }
}

Json difference_json(const diff::Difference& difference) {
  Json row = {{"change", std::string(change_name(difference.change))},
              {"path", difference.path.str()},
              {"kind", spec_kind_name(difference.kind)}};
  row["field"] = or_null(difference.field);
  row["key"] = or_null(difference.key);
  row["before"] = side_json(difference.before);
  row["after"] = side_json(difference.after);
  row["beforeLine"] = or_null(difference.before_line);
  row["afterLine"] = or_null(difference.after_line);
  if (difference.field.empty()) {
    row["specs"] = difference.count;
  } else {
    row["elements"] = difference.elements;
    row["differentElements"] = difference.count;
    row["largest"] = finite_or_null(difference.largest);
  }
  return row;
}

Json difference_json(const scene::SceneDifference& difference) {
  const bool object = difference.before.name.empty() && difference.after.name.empty();
  const scene::Fact& named = difference.before.name.empty() ? difference.after : difference.before;
  Json row = {{"change", std::string(change_name(difference.change))},
              {"object", difference.object},
              {"path", difference.path}};
  row["what"] = object ? Json(nullptr) : Json(named.name);
  row["unit"] = or_null(named.unit);
  row["before"] = fact_json(difference.before);
  row["after"] = fact_json(difference.after);
  row["largest"] = finite_or_null(difference.largest);
  return row;
}

}  // namespace tenon::answers
