// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/layer/spec.h"

namespace tenon::layer {

/// Same kind and equal fields, in any order; the places in the source do not count.
bool same_spec(const Spec& a, const Spec& b);

}  // namespace tenon::layer
