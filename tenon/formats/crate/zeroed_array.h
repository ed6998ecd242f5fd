// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <type_traits>

#include "tenon/base/error.h"
#include "tenon/base/result.h"

namespace tenon::formats::crate {

/// An array of a fixed size whose elements are zero bytes until they are set. Those that are never
/// touched cost no memory, so that a table may be as long as a file claims.
template <class T>
class ZeroedArray {
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);

 public:
  ZeroedArray() = default;
  /// ErrorCode::Limit when there is no room.
  static Result<ZeroedArray> make(std::size_t size) {
    ZeroedArray array;
    if (size != 0) {
      array.elements_.reset(static_cast<T*>(std::calloc(size, sizeof(T))));
      if (array.elements_ == nullptr) {
        return Error(ErrorCode::Limit, "there is no memory for a table of the file")
            .with_rule("crate.too-much");
      }
      array.size_ = size;
    }
    return array;
  }

  std::size_t size() const { return size_; }
  T& operator[](std::size_t at) { return elements_.get()[at]; }
  const T& operator[](std::size_t at) const { return elements_.get()[at]; }

 private:
  struct Free {
    void operator()(T* elements) const { std::free(elements); }
  };
  std::unique_ptr<T, Free> elements_;
  std::size_t size_ = 0;
};

}  // namespace tenon::formats::crate
