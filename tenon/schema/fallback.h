// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "tenon/layer/type_names.h"
#include "tenon/layer/value.h"

namespace tenon::schema {

/// A value from the text of a schema table (see PropertyRow::fallback); empty for types that no
/// table uses or text that does not fit the type.
layer::Value read_fallback(const layer::TypeName& type, std::string_view text);

}  // namespace tenon::schema
