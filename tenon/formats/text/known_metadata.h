// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <vector>

#include "tenon/layer/spec.h"

namespace tenon::formats::text {

/// Blocks of metadata that were read, from '(' to ')', and the fields that they gave to specs which
/// had no metadata before. Prims of one kind apply the same schemas over and over; equal bytes mean
/// the same, so a block that is known needs no second look.
class KnownMetadata {
 public:
  /// Gives `spec` the fields of the block that `rest` begins with. -> its length in bytes, 0 for
  /// one that is not known. The texts are parts of one text that outlives this.
  std::size_t take(std::string_view rest, layer::Spec& spec) const;
  /// The fields of `spec` from `first` on came from `block`, and would anywhere.
  void note(std::string_view block, const layer::Spec& spec, std::size_t first);

 private:
  static constexpr std::size_t kLongestBlock = 1024;

  struct Known {
    std::string_view text;
    layer::SpecKind kind = layer::SpecKind::Prim;
    std::vector<layer::Field> fields;
  };
  std::vector<Known> slots_;
};

}  // namespace tenon::formats::text
