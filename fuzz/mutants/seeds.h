// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "fuzz/dice.h"

namespace tenon::fuzz {

enum class Kind : unsigned char {
  Text,
  Crate,
  Package,
  Urdf,
  Mjcf,
  Sdf,
  Stl,
  Obj,
  Dae,
  Gltf,
  Png,
  Other
};
inline constexpr std::size_t kKinds = 12;

struct Seed {
  std::string path;  ///< relative to the folder it was found in
  std::string bytes;
  Kind kind = Kind::Other;
  std::vector<std::size_t> companions;  ///< files beside and below it that it names, and they
};

/// Whole files to make mutants of.
class Seeds {
 public:
  /// All files of at most 256 kB at and below the folders.
  static Seeds load(const std::vector<std::string>& folders);

  bool has(Kind kind) const { return !of_kind_[static_cast<std::size_t>(kind)].empty(); }
  /// One of this kind; there is one.
  const Seed& pick(Kind kind, Dice& dice) const;
  const Seed& at(std::size_t index) const { return seeds_[index]; }
  std::size_t count() const { return seeds_.size(); }
  /// Of all names and bytes: equal digests, equal mutants.
  std::uint64_t digest() const;

 private:
  std::vector<Seed> seeds_;
  std::array<std::vector<std::size_t>, kKinds> of_kind_;
};

/// The folder of a path, with '/' at the end; "" for a name alone.
std::string_view folder_of(std::string_view path);

}  // namespace tenon::fuzz
