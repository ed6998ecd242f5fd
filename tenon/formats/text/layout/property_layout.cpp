// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Statements of one property: its declaration with a value, its samples, and the rest.
#include <algorithm>

#include "tenon/base/text/text_number.h"
#include "tenon/formats/text/layout/layout_state.h"
#include "tenon/formats/text/layout/list_layout.h"
#include "tenon/formats/text/write/value_text.h"
#include "tenon/formats/text/write/writer.h"
#include "tenon/layer/field_values.h"
#include "tenon/layer/spec_equality.h"

namespace tenon::formats::text {
namespace {

using layer::Spec;
using layer::SpecKind;
using layer::Value;
namespace fields = layer::fields;

bool same_value(const Spec& a, const Spec& b, Token field) {
  const Value* x = a.find(field);
  const Value* y = b.find(field);
  return x == nullptr || y == nullptr ? x == y : *x == *y;
}

class PropertyLayout {
 public:
  PropertyLayout(LayoutState& state, Path path)
      : state_(state),
        patch_(state.patch),
        path_(path),
        before_(*state.before.find(path)),
        after_(*state.after.find(path)) {}

  void run() {
    const auto found = state_.sources.properties.find(path_);
    if (found == state_.sources.properties.end()) {
      state_.failed = true;
      return;
    }
    statements_ = &found->second;
    for (const PropertyStatement& statement : *statements_) {
      if (statement.part == PropertyPart::Declaration) {
        declaration_ = declaration_ == nullptr ? &statement : declaration_;
      }
    }
    if (before_.kind != after_.kind || !edits_fit()) {
      replace_all();
      return;
    }
    if (!same_value(before_, after_, fields::default_value)) {
      edit_default();
    }
    if (!same_value(before_, after_, fields::timeSamples)) {
      edit_samples();
    }
    if (declaration_ != nullptr) {
      edit_metadata(state_, path_, {declaration_->range.begin, head_end()});
    }
  }

 private:
  /// Only values, samples and metadata differ, and what must be there for them is.
  bool edits_fit() const {
    for (const Token field : {fields::typeName, fields::variability, fields::custom,
                              fields::connectionPaths, fields::spline, fields::targetPaths}) {
      if (!same_value(before_, after_, field)) {
        return false;
      }
    }
    if (declaration_ == nullptr) {
      return only_samples_differ();
    }
    return before_.kind == SpecKind::Attribute ||
           same_value(before_, after_, fields::default_value);
  }

  bool only_samples_differ() const {
    Spec expected = before_;
    const Value* samples = after_.find(fields::timeSamples);
    if (samples == nullptr) {
      return false;
    }
    expected.set(fields::timeSamples, *samples);
    return layer::same_spec(expected, after_);
  }

  std::size_t head_end() const {
    return declaration_->value.end == 0 ? declaration_->name_end : declaration_->value.end;
  }

  std::string canonical() const {
    return reindented(part_text(state_.after, path_),
                      patch_.indent_at(statements_->front().range.begin), state_.unit);
  }

  void replace_all() {
    const SourceRange first = statements_->front().range;
    for (std::size_t i = 1; i < statements_->size(); ++i) {
      patch_.remove((*statements_)[i].range);
    }
    std::string by = canonical();
    by.erase(0, patch_.indent_at(first.begin).size());
    by.pop_back();
    if (statements_->size() != 1 || !edit_list_items(patch_, first, by)) {
      patch_.replace(first, by);
    }
  }

  void edit_default() {
    const Value* value = after_.find(fields::default_value);
    if (value == nullptr) {
      patch_.replace({declaration_->name_end, declaration_->value.end}, {});
    } else if (declaration_->value.end != 0) {
      patch_.replace(declaration_->value, value_text(*value));
    } else {
      patch_.insert(declaration_->name_end, " = " + value_text(*value));
    }
  }

  static std::string sample_text(double time, const Value& value) {
    return layer_text(time) + ": " + value_text(value);
  }

  void edit_samples() {
    const PropertyStatement* statement = nullptr;
    for (const PropertyStatement& one : *statements_) {
      statement = one.part == PropertyPart::Samples ? &one : statement;
    }
    const auto* samples = after_.get<layer::TimeSamples>(fields::timeSamples);
    if (statement == nullptr || samples == nullptr) {
      samples == nullptr ? patch_.remove(statement->range) : add_samples(*samples);
      return;
    }
    const auto entries = state_.sources.samples.find(path_);
    const auto* old = before_.get<layer::TimeSamples>(fields::timeSamples);
    if (entries == state_.sources.samples.end() || entries->second.size() != old->size()) {
      replace_samples(*statement);
      return;
    }
    edit_entries(entries->second, *old, *samples);
  }

  /// `.timeSamples = {...}` of the canonical text.
  std::string samples_text(const layer::TimeSamples& samples) const {
    std::string text = "{\n";
    for (std::size_t i = 0; i < samples.size(); ++i) {
      text += "    " + sample_text(samples.times[i], samples.values[i]) + ",\n";
    }
    return text + "}";
  }

  void replace_samples(const PropertyStatement& statement) {
    std::string text =
        reindented(samples_text(*after_.get<layer::TimeSamples>(fields::timeSamples)) + "\n",
                   patch_.indent_at(statement.range.begin), state_.unit);
    text.erase(0, patch_.indent_at(statement.range.begin).size());
    text.pop_back();
    patch_.replace(statement.value, text);
  }

  void add_samples(const layer::TimeSamples& samples) {
    std::string head;
    if (after_.get_or(fields::variability, layer::Variability::Varying) ==
        layer::Variability::Uniform) {
      head = "uniform ";
    }
    head += after_.get_or(fields::typeName, Token()).str() + " " + path_.name().str();
    const std::string indent = patch_.indent_at(statements_->front().range.begin);
    patch_.insert_after(
        statements_->back().range,
        reindented(head + ".timeSamples = " + samples_text(samples) + "\n", indent, state_.unit));
  }

  /// Entries are in the order of the text; new ones go behind the sample before them.
  void edit_entries(const std::vector<SampleEntry>& entries, const layer::TimeSamples& old,
                    const layer::TimeSamples& samples) {
    for (const SampleEntry& entry : entries) {
      const auto now = std::find(samples.times.begin(), samples.times.end(), entry.time);
      const auto was = std::find(old.times.begin(), old.times.end(), entry.time);
      if (now == samples.times.end()) {
        patch_.remove(entry.range, ',');
        continue;
      }
      const Value& value = samples.values[static_cast<std::size_t>(now - samples.times.begin())];
      if (!(old.values[static_cast<std::size_t>(was - old.times.begin())] == value)) {
        patch_.replace(entry.value, value_text(value));
      }
    }
    for (std::size_t i = 0; i < samples.size(); ++i) {
      if (std::find(old.times.begin(), old.times.end(), samples.times[i]) == old.times.end()) {
        insert_entry(entries, samples.times[i], samples.values[i]);
      }
    }
  }

  void insert_entry(const std::vector<SampleEntry>& entries, double time, const Value& value) {
    const SampleEntry* previous = nullptr;
    for (const SampleEntry& entry : entries) {
      if (entry.time < time && (previous == nullptr || entry.time > previous->time)) {
        previous = &entry;
      }
    }
    const std::string text = sample_text(time, value);
    const SampleEntry& next_to = previous == nullptr ? entries.front() : *previous;
    const std::string indent = patch_.indent_at(next_to.range.begin);
    if (previous == nullptr) {
      patch_.insert(next_to.range.begin,
                    text + (patch_.starts_line(next_to.range.begin) ? ",\n" + indent : ", "));
      return;
    }
    const std::string_view rest = patch_.text().substr(next_to.range.end);
    const std::size_t comma = rest.find_first_not_of(" \t");
    if (comma == std::string_view::npos || rest[comma] != ',') {
      patch_.insert(next_to.range.end, ",");
    }
    patch_.insert_after(next_to.range, indent + text + ",\n", ',');
  }

  LayoutState& state_;
  TextPatch& patch_;
  Path path_;
  const Spec& before_;
  const Spec& after_;
  const std::vector<PropertyStatement>* statements_ = nullptr;
  const PropertyStatement* declaration_ = nullptr;
};

}  // namespace

void edit_property(LayoutState& state, Path path) { PropertyLayout(state, path).run(); }

}  // namespace tenon::formats::text
