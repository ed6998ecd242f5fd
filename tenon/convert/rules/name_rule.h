// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace tenon::convert {

/// A value for each joint, or link, whose whole name a pattern matches.
template <class Value>
struct NameRule {
  /// A name or a regular expression (base/text/name_pattern.h); empty: those that no other rule of
  /// the list matches. Where several match, the last one counts.
  std::string pattern;
  Value value{};
};

}  // namespace tenon::convert
