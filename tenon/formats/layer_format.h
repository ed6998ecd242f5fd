// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace tenon::formats {

/// How a layer is stored.
enum class LayerFormat : unsigned char { Text, Crate, Package };

}  // namespace tenon::formats
