// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <string>

/// Scalar value types that C++ does not have.
namespace tenon::layer {

/// The path of an asset: as authored, after variable expressions, and on disk. A layer knows only
/// the first; the stage fills the others.
struct AssetPath {
  std::string authored;
  std::string evaluated;
  std::string resolved;

  bool operator==(const AssetPath&) const = default;
};

/// A time on the timeline, moved by layer offsets, in the layer's time codes.
struct TimeCode {
  double value = 0;
  auto operator<=>(const TimeCode&) const = default;
};

/// A span of time, scaled but not moved by layer offsets, in the layer's time codes.
struct Duration {
  double value = 0;
  auto operator<=>(const Duration&) const = default;
};

/// Text of a path expression such as `/World//a*`.
struct PathExpression {
  std::string text;
  bool operator==(const PathExpression&) const = default;
};

/// "There is no value here", authored on purpose; hides weaker opinions.
struct ValueBlock {
  bool operator==(const ValueBlock&) const = default;
};

/// Blocks time samples and splines but lets a weaker default through.
struct AnimationBlock {
  bool operator==(const AnimationBlock&) const = default;
};

/// The type of attributes that never hold a value.
struct Opaque {
  bool operator==(const Opaque&) const = default;
};

enum class Specifier : unsigned char { Def, Over, Class };
enum class Permission : unsigned char { Public, Private };
enum class Variability : unsigned char { Varying, Uniform };

}  // namespace tenon::layer
