// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/stage/values/value_memo.h"

#include <cstddef>
#include <functional>

#include "tenon/stage/stage_data.h"

namespace tenon::stage {

ValueMemo::Known* ValueMemo::known(const Attribute& attribute) {
  constexpr std::size_t kPlaces = 4096;  // a robot has hundreds of attributes
  const PrimData* const prim = attribute.prim_;
  if (prim == nullptr || !prim->in_prototype) {
    return nullptr;
  }
  if (known_.empty()) {
    known_.resize(kPlaces);
  }
  const std::size_t hash =
      (std::hash<Token>()(attribute.name_) >> 16u) ^ reinterpret_cast<std::uintptr_t>(prim) >> 4u;
  Known& known = known_[hash % kPlaces];
  if (known.prim != prim || known.name != attribute.name_) {
    known = {prim, attribute.name_};
  }
  return &known;
}

const layer::Value* ValueMemo::value_in_place(const Attribute& attribute) {
  Known* const found = known(attribute);
  if (found == nullptr) {
    return attribute.value_in_place();
  }
  if (!found->has_value) {
    found->value = attribute.value_in_place();
    found->has_value = true;
  }
  return found->value;
}

bool ValueMemo::has_authored_value(const Attribute& attribute) {
  Known* const found = known(attribute);
  if (found == nullptr) {
    return attribute.has_authored_value();
  }
  if (found->is_authored == Answer::Unknown) {
    found->is_authored = attribute.has_authored_value() ? Answer::Yes : Answer::No;
  }
  return found->is_authored == Answer::Yes;
}

}  // namespace tenon::stage
