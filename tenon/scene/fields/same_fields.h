// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/scene/fields/data_type.h"

namespace tenon::scene {

/// Two values of one type agree in all that lies in them, as deep as it lies: lists are as long,
/// and `agree(x, y)` holds for what is neither an optional, a pair, a list nor a struct.
bool data_agrees(DataView a, DataView b, bool (*agree)(DataView, DataView));

/// Equal in every field, as deep as it lies; one not-a-number equals another, 0 equals -0.
bool same_data(DataView a, DataView b);

template <class T>
bool same_fields(const T& a, const T& b) {
  return same_data(view_of(a), view_of(b));
}

}  // namespace tenon::scene
