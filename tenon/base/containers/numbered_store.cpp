// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/base/containers/numbered_store.h"

namespace tenon {

void add_block(std::byte*& block, std::size_t size) {
  std::byte* none = nullptr;
  auto* const made = static_cast<std::byte*>(::operator new(size));
  if (!std::atomic_ref(block).compare_exchange_strong(none, made)) {
    ::operator delete(made);
  }
}

}  // namespace tenon
