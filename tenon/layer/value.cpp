// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/layer/value.h"

#include <mutex>

#include "tenon/layer/field_values.h"

namespace tenon::layer {

struct Value::DeferredBody final : SharedBody {
  explicit DeferredBody(std::unique_ptr<DeferredArray> s) : source(std::move(s)) {}

  const Value& decode_once() const {
    std::call_once(once, [this] {
      if (auto result = source->decode()) {
        decoded = *std::move(result);
      } else {
        error.emplace(std::move(result).error());
      }
    });
    return decoded;
  }
  bool equals(const SharedBody& other) const override { return this == &other; }
  std::size_t size() const override { return source->size(); }

  std::unique_ptr<DeferredArray> source;
  mutable std::once_flag once;
  mutable Value decoded;
  mutable std::optional<Error> error;
};

Value Value::deferred(ValueType element, std::unique_ptr<DeferredArray> source) {
  Value value;
  value.type_ = element;
  value.is_array_ = true;
  value.holding_ = Holding::Deferred;
  new (&value.storage_) SharedBody*(new DeferredBody(std::move(source)));
  return value;
}

void Value::release_body() {
  if (body()->owners.fetch_sub(1, std::memory_order_acq_rel) == 1) {
    delete body();
  }
}

const Value* Value::decoded_or_null() const {
  if (holding_ != Holding::Deferred) {
    return this;
  }
  const Value& value = static_cast<const DeferredBody*>(body())->decode_once();
  return value.type_ == type_ && value.is_array_ ? &value : nullptr;
}

Result<Value> Value::decoded() const {
  if (holding_ != Holding::Deferred) {
    return *this;
  }
  const auto* deferred = static_cast<const DeferredBody*>(body());
  const Value& value = deferred->decode_once();
  if (deferred->error) {
    return *deferred->error;
  }
  return value;
}

std::size_t Value::size() const {
  if (holding_ == Holding::Inline) {
    return empty() || is_array_ ? 0 : 1;
  }
  return body()->size();
}

namespace {

template <class T>
bool equal_inline(const Value& a, const Value& b) {
  if constexpr (std::is_trivially_copyable_v<T>) {  // as all that is kept inline
    return *a.get<T>() == *b.get<T>();
  } else {
    return true;
  }
}

}  // namespace

bool Value::operator==(const Value& other) const {
  if (type_ != other.type_ || is_array_ != other.is_array_) {
    return false;
  }
  if (is_array_) {
    return equal_arrays(other);
  }
  if (holding_ == Holding::Inline) {
    if (type_ == ValueType::None) {
      return true;
    }
    switch (type_) {
#define TENON_SCALAR(enumerator, type, name, crate_id) \
  case ValueType::enumerator:                          \
    return equal_inline<type>(*this, other);
#define TENON_FIELD(enumerator, type, crate_id) TENON_SCALAR(enumerator, type, "", crate_id)
#include "tenon/layer/value_types.def"
      case ValueType::None:
        break;
    }
    return true;
  }
  return body() == other.body() || body()->equals(*other.body());
}

/// Arrays are deferred, shared, or nothing at all when they are empty.
bool Value::equal_arrays(const Value& other) const {
  const Value* a = decoded_or_null();
  const Value* b = other.decoded_or_null();
  if (a == nullptr || b == nullptr) {
    return body() == other.body();
  }
  if (a->holding_ == Holding::Inline || b->holding_ == Holding::Inline) {
    return a->size() == b->size();
  }
  return a->body() == b->body() || a->body()->equals(*b->body());
}

#define TENON_NUMBER(enumerator, cpp_type, name, crate_id)              \
  template NumberArray<cpp_type>::NumberArray(std::vector<cpp_type>&&); \
  template bool NumberArray<cpp_type>::equal(const void*, const void*, std::size_t);
#define TENON_FIELD(enumerator, cpp_type, crate_id) template struct Value::Held<cpp_type>;
#include "tenon/layer/value_types.def"

}  // namespace tenon::layer
