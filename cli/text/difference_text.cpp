// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// One line for each difference, in the shortest form that still tells what changed. Edits of lists
// are shown by the items that came and went, long arrays by how many elements differ, from which on
// and by how much. Numbers of the physics have six digits; where both sides would read alike, they
// have 17, which tell any two doubles apart. Angles are held in radians and shown in degrees.
#include "cli/text/difference_text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tenon/answers/difference_json.h"
#include "tenon/answers/list_item_text.h"
#include "tenon/base/text/counted.h"
#include "tenon/layer/field_values.h"
#include "tenon/layer/fields.h"
#include "tenon/math/angle.h"

namespace tenon::cli {
namespace {

using layer::Value;

constexpr std::size_t kShownNumbers = 9;  ///< of a fact in a line

const char* mark_of(Change change) {
  return change == Change::Added ? "+" : change == Change::Removed ? "-" : "~";
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
    words += has(after, item) ? "" : (words.empty() ? " - " : ", - ") + answers::item_text(item);
  }
  for (const T& item : after) {
    words += has(before, item) ? "" : (words.empty() ? " + " : ", + ") + answers::item_text(item);
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
    return value.empty() ? std::string() : answers::shown_side(value);
  };
  switch (difference.change) {
    case Change::Added:
      return text(difference.after);
    case Change::Removed:
      return text(difference.before);
    case Change::Changed:
      break;
  }
  return text(difference.before) + " -> " + text(difference.after);
}

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

std::string numbers_text(const scene::Fact& fact, const char* format) {
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

std::string fact_text(const scene::Fact& fact, const char* format) {
  if (fact.numbers.empty()) {
    return fact.word.empty() ? "none" : fact.word;
  }
  return fact.numbers.size() <= kShownNumbers ? numbers_text(fact, format)
                                              : std::to_string(fact.numbers.size()) + " numbers";
}

std::string change_words(const scene::SceneDifference& difference) {
  const scene::Fact& before = difference.before;
  const scene::Fact& after = difference.after;
  if (difference.change == Change::Added) {
    return after.name + " " + fact_text(after, "%.6g");
  }
  if (difference.change == Change::Removed) {
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

}  // namespace

std::string difference_text(const diff::Difference& difference) {
  std::string text = std::string(mark_of(difference.change)) + " " + difference.path.str() + "  ";
  if (difference.field.empty()) {
    const std::string value = value_words(difference);
    text += answers::spec_kind_name(difference.kind) + std::string(" ") +
            std::string(change_name(difference.change));
    text += value.empty() ? "" : ": " + value;
    return difference.count == 1
               ? text
               : text + ", with " + counted(difference.count - 1, "spec") + " below";
  }
  const bool order = difference.field == layer::fields::primChildren;
  const bool value = difference.field == layer::fields::default_value;
  text += order ? "order of children" : value ? "value" : difference.field.str();
  text += difference.key.empty() ? "" : " " + difference.key;
  const std::string words = list_words(difference.before, difference.after);
  return text + ": " + (words.empty() ? value_words(difference) : words);
}

std::string difference_text(const scene::SceneDifference& difference) {
  std::string text =
      std::string(mark_of(difference.change)) + " " + difference.object + " " + difference.path;
  const bool added = difference.change == Change::Added;
  if (difference.object == "pair") {
    return text + (added ? "  do not collide" : "  may collide");
  }
  if (difference.object == "pair for good") {
    return std::string(mark_of(difference.change)) + " " + difference.path +
           (added ? "  never collide (always filtered)" : "  are not always filtered any more");
  }
  if (difference.before.name.empty() && difference.after.name.empty()) {
    return text + (added ? "  added" : "  removed");
  }
  return text + "  " + change_words(difference);
}

std::string difference_text(const FileDifference& difference) {
  if (const auto* file = std::get_if<FileChange>(&difference.what)) {
    return std::string(mark_of(file->change)) + " " + difference.file + "  file " +
           std::string(change_name(file->change));
  }
  const auto* layers = std::get_if<diff::Difference>(&difference.what);
  const std::string text = layers != nullptr
                               ? difference_text(*layers)
                               : difference_text(std::get<scene::SceneDifference>(difference.what));
  return (difference.file.empty() ? "" : difference.file + ": ") + text;
}

}  // namespace tenon::cli
