// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

namespace tenon {

/// A number for contents that differs where they differ; not made against those who look for two
/// of the same. The same on every machine of this byte order.
std::uint64_t content_digest(std::string_view contents);

}  // namespace tenon
