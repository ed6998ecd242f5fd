// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "tenon/base/path.h"

namespace tenon::stage {

/// Which findings about targets of one property get the places of their targets: the first 32. The
/// others get that of the property, since each place takes a look at all targets.
class PlacedTargets {
 public:
  /// Of findings in the order in which they are made.
  bool take(Path property) {
    count_ = property == last_ ? count_ + 1 : 1;
    last_ = property;
    return count_ <= kMostPlaced;
  }

 private:
  static constexpr std::size_t kMostPlaced = 32;

  Path last_;
  std::size_t count_ = 0;
};

}  // namespace tenon::stage
