// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/base/containers/numbered_store.h"

#include <cstdlib>
#include <cstring>

namespace tenon {

void add_zeros(std::atomic<std::byte*>& block, std::size_t size) {
  void* zeros = std::calloc(size, 1);  // NOLINT(cppcoreguidelines-no-malloc): untouched memory
  if (zeros == nullptr) {
    zeros = std::memset(::operator new(size), 0, size);  // it says that there is none
  }
  std::byte* none = nullptr;
  if (!block.compare_exchange_strong(none, static_cast<std::byte*>(zeros))) {
    std::free(zeros);  // NOLINT(cppcoreguidelines-no-malloc)
  }
}

}  // namespace tenon
