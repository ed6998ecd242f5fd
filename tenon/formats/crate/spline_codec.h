// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "tenon/base/result.h"
#include "tenon/formats/crate/layout.h"
#include "tenon/layer/time/spline.h"

namespace tenon::formats::crate {

/// Decodes a spline without the custom data of its knots, which is stored next to it. Errors:
/// ErrorCode::Corrupt; Unsupported for a form of a later version.
Result<layer::Spline> decode_spline(std::span<const std::byte> bytes);

struct EncodedSpline {
  std::string bytes;
  Version needed;  ///< the lowest version of files that may hold it
};
EncodedSpline encode_spline(const layer::Spline& spline);

}  // namespace tenon::formats::crate
