// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/base/token.h"
#include "tenon/layer/fields.h"

namespace tenon::layer {

/// A field that lists the specs below a spec, which is structure and no opinion.
inline bool is_child_list(Token field) {
  return field == fields::primChildren || field == fields::properties ||
         field == fields::variantSetChildren || field == fields::variantChildren ||
         field == fields::targetChildren || field == fields::connectionChildren;
}

}  // namespace tenon::layer
