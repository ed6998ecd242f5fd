// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>

#include "tenon/check/simready/judged_asset.h"

namespace tenon {

/// What the header of a PNG or JPEG file says; none for other bytes and for damaged headers.
std::optional<check::simready::ImageFacts> image_header(std::string_view bytes);

}  // namespace tenon
