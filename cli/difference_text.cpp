// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/difference_text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "cli/list_item_text.h"
#include "tenon/formats/text/value_text.h"
#include "tenon/layer/field_values.h"
#include "tenon/layer/fields.h"
#include "tenon/math/angle.h"

namespace tenon::cli {
namespace {

using layer::Value;

constexpr std::size_t kLongest = 100;     ///< characters of a value in a line
constexpr std::size_t kShownNumbers = 9;  ///< of a fact in a line

std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text.size() <= kLongest ? text : text.substr(0, kLongest) + " ...";
}

const char* mark_of(diff::Change change) {
  return change == diff::Change::Added ? "+" : change == diff::Change::Removed ? "-" : "~";
}

const char* kind_name(layer::SpecKind kind) {
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

/// "prepend + A, - B" of one of the lists of an edit.
template <class T>
void add_list(std::string& text, const char* word, const std::vector<T>& before,
              const std::vector<T>& after) {
  if (before == after) {
    return;
  }
  const auto has = [](const std::vector<T>& list, const T& item) {
    return std::find(list.begin(), list.end(), item) != list.end();
  };
  std::string words;
  for (const T& item : before) {
    words += has(after, item) ? "" : (words.empty() ? " - " : ", - ") + item_text(item);
  }
  for (const T& item : after) {
    words += has(before, item) ? "" : (words.empty() ? " + " : ", + ") + item_text(item);
  }
  text += (text.empty() ? "" : "; ") + std::string(word) +
          (words.empty() ? " in another order" : words);
}

template <class T>
bool list_words(const Value& before, const Value& after, std::string& text) {
  using Op = layer::ListOp<T>;
  if (!before.holds<Op>() && !after.holds<Op>()) {
    return false;
  }
  const Op a = before.get_or(Op{});
  const Op b = after.get_or(Op{});
  if (a.is_explicit != b.is_explicit) {
    text = b.is_explicit ? "replaces the weaker list now" : "edits the weaker list now";
  }
  add_list(text, "list", a.explicit_items, b.explicit_items);
  add_list(text, "prepend", a.prepended, b.prepended);
  add_list(text, "append", a.appended, b.appended);
  add_list(text, "delete", a.deleted, b.deleted);
  add_list(text, "add", a.added, b.added);
  add_list(text, "reorder", a.ordered, b.ordered);
  return true;
}

/// What changed in a list edit; empty for other values.
std::string list_words(const Value& before, const Value& after) {
  std::string text;
  const bool is_list = list_words<Token>(before, after, text) ||
                       list_words<Path>(before, after, text) ||
                       list_words<std::string>(before, after, text) ||
                       list_words<layer::Reference>(before, after, text) ||
                       list_words<layer::Payload>(before, after, text) ||
                       list_words<std::int32_t>(before, after, text) ||
                       list_words<std::uint32_t>(before, after, text) ||
                       list_words<std::int64_t>(before, after, text) ||
                       list_words<std::uint64_t>(before, after, text);
  return is_list && text.empty() ? "list" : text;
}

std::string number_text(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.6g", value + 0.0);
  return buffer;
}

std::string value_words(const diff::Difference& difference) {
  if (difference.before.is_array() && difference.after.is_array() && difference.elements > 8) {
    std::string text = std::to_string(difference.count) + " of " +
                       std::to_string(difference.elements) + " elements differ, from [" +
                       std::to_string(difference.first) + "] on";
    if (difference.before.size() != difference.after.size()) {
      return text + ", " + std::to_string(difference.before.size()) + " -> " +
             std::to_string(difference.after.size()) + " elements";
    }
    return std::isfinite(difference.largest)
               ? text + ", by at most " + number_text(difference.largest)
               : text;
  }
  const auto text = [](const Value& value) {
    return value.empty() ? std::string() : one_line(formats::value_text(value));
  };
  switch (difference.change) {
    case diff::Change::Added:
      return text(difference.after);
    case diff::Change::Removed:
      return text(difference.before);
    case diff::Change::Changed:
      break;
  }
  return text(difference.before) + " -> " + text(difference.after);
}

Json text_or_null(const Value& value) {
  return value.empty() ? Json(nullptr) : Json(one_line(formats::value_text(value)));
}

Json number_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json line_or_null(std::uint32_t line) { return line == 0 ? Json(nullptr) : Json(line); }

struct ShownUnit {
  std::string name;
  double factor = 1;
};

/// People read angles in degrees.
ShownUnit shown_unit(const std::string& unit) {
  if (unit == "rad" || unit == "rad/s") {
    return {unit == "rad" ? "deg" : "deg/s", kDegreesPerRadian};
  }
  return {unit, 1};
}

std::string numbers_text(const diff::Fact& fact, const char* format) {
  const ShownUnit unit = shown_unit(fact.unit);
  std::string text;
  for (const double number : fact.numbers) {
    char buffer[40];
    std::snprintf(buffer, sizeof buffer, format, number * unit.factor + 0.0);
    text += (text.empty() ? "" : ", ") +
            (std::isinf(number) ? std::string(number > 0 ? "unlimited" : "-unlimited") : buffer);
  }
  if (fact.numbers.size() != 1) {
    text = "(" + text + ")";
  }
  return unit.name.empty() ? text : text + " " + unit.name;
}

std::string fact_text(const diff::Fact& fact, const char* format) {
  if (fact.numbers.empty()) {
    return fact.word.empty() ? "none" : fact.word;
  }
  return fact.numbers.size() <= kShownNumbers ? numbers_text(fact, format)
                                              : std::to_string(fact.numbers.size()) + " numbers";
}

std::string change_words(const diff::PhysicsDifference& difference) {
  const diff::Fact& before = difference.before;
  const diff::Fact& after = difference.after;
  if (difference.change == diff::Change::Added) {
    return after.name + " " + fact_text(after, "%.6g");
  }
  if (difference.change == diff::Change::Removed) {
    return before.name + " " + fact_text(before, "%.6g");
  }
  std::string text = before.name + " ";
  if (before.numbers.size() > kShownNumbers && before.numbers.size() == after.numbers.size()) {
    return text + "differ, by at most " + number_text(difference.largest) + " " + before.unit;
  }
  const bool same_digits = fact_text(before, "%.6g") == fact_text(after, "%.6g");
  const char* format = same_digits ? "%.17g" : "%.6g";
  return text + fact_text(before, format) + " -> " + fact_text(after, format);
}

Json fact_json(const diff::Fact& fact) {
  if (fact.name.empty()) {
    return nullptr;
  }
  if (fact.numbers.empty()) {
    return fact.word;
  }
  if (fact.numbers.size() == 1) {
    return number_or_null(fact.numbers.front());
  }
  Json numbers = Json::array();
  for (const double number : fact.numbers) {
    numbers.push_back(number_or_null(number));
  }
  return numbers;
}

}  // namespace

Json difference_json(const diff::Difference& difference) {
  Json row = {{"change", std::string(diff::change_name(difference.change))},
              {"path", difference.path.str()},
              {"kind", kind_name(difference.kind)}};
  row["field"] = difference.field.empty() ? Json(nullptr) : Json(difference.field.str());
  row["key"] = difference.key.empty() ? Json(nullptr) : Json(difference.key);
  row["before"] = text_or_null(difference.before);
  row["after"] = text_or_null(difference.after);
  row["beforeLine"] = line_or_null(difference.before_line);
  row["afterLine"] = line_or_null(difference.after_line);
  if (difference.field.empty()) {
    row["specs"] = difference.count;
  } else {
    row["elements"] = difference.elements;
    row["differentElements"] = difference.count;
    row["largest"] = number_or_null(difference.largest);
  }
  return row;
}

std::string difference_text(const diff::Difference& difference) {
  std::string text = std::string(mark_of(difference.change)) + " " + difference.path.str() + "  ";
  if (difference.field.empty()) {
    const std::string value = value_words(difference);
    text += kind_name(difference.kind) + std::string(" ") +
            std::string(diff::change_name(difference.change));
    text += value.empty() ? "" : ": " + value;
    return difference.count == 1
               ? text
               : text + ", with " + std::to_string(difference.count - 1) + " specs below";
  }
  const bool order = difference.field == layer::fields::primChildren;
  const bool value = difference.field == layer::fields::default_value;
  text += order ? "order of children" : value ? "value" : difference.field.str();
  text += difference.key.empty() ? "" : " " + difference.key;
  const std::string words = list_words(difference.before, difference.after);
  return text + ": " + (words.empty() ? value_words(difference) : words);
}

Json difference_json(const diff::PhysicsDifference& difference) {
  const bool object = difference.before.name.empty() && difference.after.name.empty();
  const diff::Fact& named = difference.before.name.empty() ? difference.after : difference.before;
  Json row = {{"change", std::string(diff::change_name(difference.change))},
              {"object", difference.object},
              {"path", difference.path}};
  row["what"] = object ? Json(nullptr) : Json(named.name);
  row["unit"] = named.unit.empty() ? Json(nullptr) : Json(named.unit);
  row["before"] = fact_json(difference.before);
  row["after"] = fact_json(difference.after);
  row["largest"] = number_or_null(difference.largest);
  return row;
}

std::string difference_text(const diff::PhysicsDifference& difference) {
  std::string text =
      std::string(mark_of(difference.change)) + " " + difference.object + " " + difference.path;
  const bool added = difference.change == diff::Change::Added;
  if (difference.object == "pair") {
    return text + (added ? "  is kept apart" : "  may touch");
  }
  if (difference.before.name.empty() && difference.after.name.empty()) {
    return text + (added ? "  added" : "  removed");
  }
  return text + "  " + change_words(difference);
}

}  // namespace tenon::cli
