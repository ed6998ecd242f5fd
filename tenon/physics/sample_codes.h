// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tenon/stage/stage.h"

namespace tenon::physics {

/// Time codes, ascending and each once.
std::vector<double> ascending_codes(std::vector<double> codes);
/// Those at which any of the attributes has a sample.
std::vector<double> sample_codes(const std::vector<stage::Attribute>& attributes);

}  // namespace tenon::physics
