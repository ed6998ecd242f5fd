// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tenon/base/token.h"

namespace tenon::physics {

/// Attributes of geometry that give a collider its shape.
const std::vector<Token>& size_names();

}  // namespace tenon::physics
