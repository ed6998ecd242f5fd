// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace tenon::compose {

/// Arcs in strength order, strongest first ("LIVERPS" with relocates; Core Spec 1.0.1 section 10).
enum class ArcKind : std::uint8_t {
  Root,
  Inherit,
  Variant,
  Relocate,
  Reference,
  Payload,
  Specialize,
};

}  // namespace tenon::compose
