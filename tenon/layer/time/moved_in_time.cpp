// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/layer/time/moved_in_time.h"

namespace tenon::layer {
namespace {

TimeCode moved(TimeCode code, const LayerOffset& offset) { return {offset.apply(code.value)}; }
Duration moved(Duration span, const LayerOffset& offset) { return {span.value * offset.scale}; }

template <class T>
Value moved_value(const Value& value, const LayerOffset& offset) {
  if (!value.is_array()) {
    return moved(*value.get<T>(), offset);
  }
  const auto* array = value.get<Array<T>>();
  if (array == nullptr) {
    return value;  // corrupt data
  }
  std::vector<T> result(array->begin(), array->end());
  for (T& element : result) {
    element = moved(element, offset);
  }
  return result;
}

}  // namespace

Value moved_in_time(const Value& value, const LayerOffset& offset) {
  if (offset.is_identity()) {
    return value;
  }
  switch (value.type()) {
    case ValueType::TimeCode:
      return moved_value<TimeCode>(value, offset);
    case ValueType::Duration:
      return moved_value<Duration>(value, offset);
    case ValueType::ArrayEdit: {
      const auto& edit = *value.get<ArrayEdit>();
      return ArrayEdit{moved_in_time(edit.literals, offset), edit.instructions};
    }
    default:
      return value;
  }
}

}  // namespace tenon::layer
