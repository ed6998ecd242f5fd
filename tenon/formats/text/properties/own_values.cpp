// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Samples are put in order at their '}', and only when some did not ascend.
#include "tenon/formats/text/properties/own_values.h"

#include <algorithm>
#include <cmath>

#include "tenon/formats/text/array_edit_reader.h"
#include "tenon/formats/text/literals.h"
#include "tenon/formats/text/value_reader.h"
#include "tenon/layer/expressions/path_expression.h"

namespace tenon::formats::text {
namespace {

using layer::Value;
using layer::ValueType;

// A value of the attribute's type; the source text where the type is unknown. A path is taken
// for any type, as some layers give a connection in that way.
bool read_own_value(Cursor& cursor, const OwnType& own, Value& value) {
  if (cursor.peek() == '<') {
    Path path;
    const bool ok = read_path(cursor, path);
    value = Value(std::vector<Path>{path});
    return ok;
  }
  if (at_array_edit(cursor)) {
    return own.type == nullptr || !own.is_array
               ? cursor.fail_expected("a value of the attribute's type, which is not a known array")
               : read_array_edit(cursor, own.type->type, value);
  }
  if (own.type != nullptr) {
    return read_value(cursor, own.type->type, own.is_array, value);
  }
  std::string text;
  if (!read_source_text(cursor, text)) {
    return false;
  }
  value = Value(layer::UnregisteredValue{Value(std::move(text))});
  return true;
}

Path no_anchor() { return {}; }

// Path expressions are kept in canonical form; those of defaults with absolute paths from
// `anchor()` on, except for elements that an edit gives.
template <class Anchor>
void settle_expressions(LayerState& state, Value& value, std::size_t start, Anchor anchor) {
  if (const auto* edit = value.get<layer::ArrayEdit>()) {
    layer::ArrayEdit settled = *edit;
    settle_expressions(state, settled.literals, start, no_anchor);
    value = Value(std::move(settled));
  }
  if (value.type() == ValueType::PathExpression && !layer::make_canonical(value, anchor())) {
    state.warn(start, "value.path-expression",
               "this is not a path expression; it is read as an empty one", "");
  }
}

// Puts the samples in order; of equal times the last one counts.
void sort_samples(layer::TimeSamples& samples) {
  std::vector<std::size_t> order(samples.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    order[i] = i;
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return samples.times[a] < samples.times[b];
  });
  layer::TimeSamples sorted;
  for (const std::size_t i : order) {
    if (!sorted.empty() && sorted.times.back() == samples.times[i]) {
      sorted.values.back() = std::move(samples.values[i]);
      continue;
    }
    sorted.times.push_back(samples.times[i]);
    sorted.values.push_back(std::move(samples.values[i]));
  }
  samples = std::move(sorted);
}

bool read_time_sample(LayerState& state, const OwnType& own, Path path, layer::TimeSamples& samples,
                      bool& ascending) {
  Cursor& cursor = state.cursor;
  const std::size_t start = cursor.offset();
  double time = 0;
  if (!at_number(cursor)) {
    return cursor.fail_expected("the time of a sample or '}'");
  }
  if (!read_double(cursor, time)) {
    return false;
  }
  if (std::isnan(time)) {
    return cursor.fail_at(start, ErrorCode::Parse, "text.value", "nan is not a time");
  }
  cursor.skip_inline();
  if (!cursor.expect(':', "after the time of a sample")) {
    return false;
  }
  cursor.skip_inline();
  Value value;
  const std::size_t value_start = cursor.offset();
  if (cursor.accept_word("None")) {
    value = layer::ValueBlock{};
  } else if (!read_own_value(cursor, own, value)) {
    return false;
  }
  if (state.sources != nullptr) {
    const std::size_t end = cursor.offset();
    state.sources->samples[path].push_back({time, {start, end}, {value_start, end}});
  }
  settle_expressions(state, value, value_start, no_anchor);
  ascending = ascending && (samples.empty() || samples.times.back() < time);
  samples.times.push_back(time);
  samples.values.push_back(std::move(value));
  return true;
}

}  // namespace

bool read_default_value(LayerState& state, const OwnType& own, Path owner, Value& value) {
  Cursor& cursor = state.cursor;
  const std::size_t start = cursor.offset();
  if (cursor.accept_word("None")) {
    value = layer::ValueBlock{};
  } else if (cursor.accept_word("AnimationBlock")) {
    value = layer::AnimationBlock{};
  } else if (!read_own_value(cursor, own, value)) {
    return false;
  }
  settle_expressions(state, value, start, [&] { return owner.strip_variants().prim(); });
  return true;
}

bool read_time_samples(LayerState& state, const OwnType& own, Path path, Value& result) {
  Cursor& cursor = state.cursor;
  if (!cursor.expect('{', "before the time samples")) {
    return false;
  }
  layer::TimeSamples& samples = state.samples_buffer;
  samples.times.clear();
  samples.values.clear();
  bool ascending = true;
  cursor.skip_multi_line();
  const bool ok = cursor.accept('}') || read_items(cursor, '}', "of the time samples", [&] {
                    return read_time_sample(state, own, path, samples, ascending);
                  });
  if (!ok) {
    return false;
  }
  if (!ascending) {
    sort_samples(samples);
  }
  result = Value(layer::TimeSamples(samples));
  return true;
}

}  // namespace tenon::formats::text
