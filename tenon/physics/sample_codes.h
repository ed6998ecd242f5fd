// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "tenon/physics/read_state.h"
#include "tenon/stage/stage.h"

namespace tenon::physics {

/// Time codes, ascending and each once.
std::vector<double> ascending_codes(std::vector<double> codes);
/// Those at which any of the attributes has a sample.
std::vector<double> sample_codes(const std::vector<stage::Attribute>& attributes);
/// Codes with others between them, four in a frame, but no more than `most`; none where samples
/// hold.
std::vector<double> dense_codes(const ReadState& state, std::vector<double> codes,
                                std::size_t most);

}  // namespace tenon::physics
