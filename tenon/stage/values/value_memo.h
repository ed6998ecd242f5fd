// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "tenon/stage/attribute.h"

namespace tenon::stage {

/// What attributes answer, for many of one stage that does not change meanwhile: those of a
/// prototype are looked for once for all of its instances, as long as they were asked for lately.
class ValueMemo {
 public:
  /// Attribute::value_in_place().
  const layer::Value* value_in_place(const Attribute& attribute);
  /// Attribute::has_authored_value().
  bool has_authored_value(const Attribute& attribute);

 private:
  enum class Answer : std::uint8_t { Unknown, No, Yes };
  struct Known {
    const PrimData* prim = nullptr;
    Token name;
    const layer::Value* value = nullptr;
    bool has_value = false;  ///< `value` is known
    Answer is_authored = Answer::Unknown;
  };

  /// The entry of an attribute of a prototype; nullptr for others.
  Known* known(const Attribute& attribute);

  std::vector<Known> known_;  // each attribute maps to one slot
};

}  // namespace tenon::stage
