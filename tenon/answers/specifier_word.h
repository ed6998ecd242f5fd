// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/layer/field_values.h"

namespace tenon::answers {

/// "def", "over" or "class", as text layers write it.
inline const char* specifier_word(layer::Specifier specifier) {
  return specifier == layer::Specifier::Def    ? "def"
         : specifier == layer::Specifier::Over ? "over"
                                               : "class";
}

}  // namespace tenon::answers
