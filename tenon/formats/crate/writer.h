// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/base/result.h"
#include "tenon/layer/layer.h"

namespace tenon::formats {

/// The layer as a binary file (.usdc) of the lowest version from 0.8.0 on that has all that is in
/// it; equal layers give equal bytes. Errors: ErrorCode::Corrupt for a deferred array that cannot
/// be decoded, Invalid for text with a zero byte, Limit for a file beyond 2^48 bytes or tables
/// beyond 2^31 rows.
Result<std::string> write_crate(const layer::Layer& layer);

}  // namespace tenon::formats
