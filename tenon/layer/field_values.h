// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// All types that a Value can hold, complete.
#include "tenon/layer/arcs.h"
#include "tenon/layer/array_edit.h"
#include "tenon/layer/dictionary.h"
#include "tenon/layer/lists/list_op.h"
#include "tenon/layer/scalar_types.h"
#include "tenon/layer/time/spline.h"
#include "tenon/layer/time/time_samples.h"
#include "tenon/layer/value.h"

namespace tenon::layer {

// What large contents are kept in, compiled once, in value.cpp.
#define TENON_FIELD(enumerator, cpp_type, crate_id) extern template struct Value::Held<cpp_type>;
#include "tenon/layer/value_types.def"

}  // namespace tenon::layer
