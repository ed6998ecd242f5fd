// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <random>

namespace tenon::fuzz {

/// std::mt19937_64 is the same everywhere; the standard's distributions are not.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : engine_(seed) {}
  std::uint64_t number() { return engine_(); }
  std::size_t below(std::size_t limit) { return limit == 0 ? 0 : engine_() % limit; }
  bool one_in(std::size_t n) { return below(n) == 0; }

  /// Numbers at which counts and offsets go wrong.
  std::uint64_t extreme() {
    static constexpr std::uint64_t kExtremes[] = {0,
                                                  1,
                                                  2,
                                                  0x7f,
                                                  0xff,
                                                  0x7fff,
                                                  0xffff,
                                                  0x10000,
                                                  0x7fffffff,
                                                  0x80000000,
                                                  0xfffffffe,
                                                  0xffffffff,
                                                  1ull << 32,
                                                  1ull << 40,
                                                  1ull << 48,
                                                  1ull << 60,
                                                  (1ull << 63) - 1,
                                                  1ull << 63,
                                                  ~0ull,
                                                  ~0ull - 7,
                                                  0x100000001};
    return kExtremes[below(std::size(kExtremes))];
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace tenon::fuzz
