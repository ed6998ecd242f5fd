// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/formats/text/cursor.h"
#include "tenon/layer/value.h"

namespace tenon::formats::text {

/// True where the word `edit` starts a value.
bool at_array_edit(const Cursor& cursor);

/// Reads `edit [append 1; write 2 to [0]]` for arrays of `element`: a layer::ArrayEdit.
bool read_array_edit(Cursor& cursor, layer::ValueType element, layer::Value& value);

}  // namespace tenon::formats::text
