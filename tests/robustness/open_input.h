// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace tenon::robustness {

enum Outcome { kRefused = 0, kRead = 1, kComposed = 2 };

/// Reads the bytes as a layer of whichever format and decodes every value in it.
Outcome read_input(const std::string& bytes);
/// The same, then composes a stage of the layer alone, with small limits, and reads all of it.
Outcome compose_input(const std::string& bytes);

}  // namespace tenon::robustness
