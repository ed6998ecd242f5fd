// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

namespace tenon {

/// Memory of this process that is in use [B]; none where the system does not tell.
std::optional<double> resident_memory();

}  // namespace tenon
