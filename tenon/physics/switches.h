// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/physics/read_state.h"

namespace tenon::physics {

/// Samples of enable flags, joint bounds and gravity (S-28, S-91, S-116).
void read_switches(ReadState& state);

}  // namespace tenon::physics
