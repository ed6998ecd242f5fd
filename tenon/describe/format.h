// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace tenon::describe {

/// The format that a robot is described for, which decides what of a scene is taken, and what is
/// skipped and reported.
enum class Format : std::uint8_t { Urdf, Mjcf, Sdf };

}  // namespace tenon::describe
