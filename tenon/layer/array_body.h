// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>

namespace tenon::layer {

/// Contents that values share: counted, never changed while there is more than one owner.
struct SharedBody {
  SharedBody() = default;
  SharedBody(const SharedBody&) = delete;
  SharedBody& operator=(const SharedBody&) = delete;
  virtual ~SharedBody() = default;
  virtual bool equals(const SharedBody& other) const = 0;
  /// Number of elements of an array, else 1.
  virtual std::size_t size() const = 0;
  std::atomic<std::uint32_t> owners{1};
};

/// The elements of a NumberArray. Not a template: one is enough for the arrays of all types.
struct ArrayBody : SharedBody {
  /// Whether so many elements at one place are equal to those at another.
  using Equal = bool (*)(const void* a, const void* b, std::size_t count);

  /// A copy of `count` elements of `element_size` bytes, in one allocation with the body.
  static ArrayBody* copy(const void* elements, std::size_t count, std::size_t element_size,
                         Equal equal);
  /// Bytes from which elements are better kept where they are than copied.
  static constexpr std::size_t kAdoptFrom = 4096;

  /// Elements in memory that `owner` keeps alive and unchanged.
  static ArrayBody* borrow(const void* elements, std::size_t count, Equal equal,
                           std::shared_ptr<const void> owner);
  /// Elements in memory that lasts until `drop(owner)`.
  static ArrayBody* adopt(const void* elements, std::size_t count, Equal equal, void* owner,
                          void (*drop)(void* owner));

  bool equals(const SharedBody& other) const override;
  std::size_t size() const override { return count; }

  const void* data;
  std::size_t count;
  Equal equal;

 protected:
  ArrayBody(const void* d, std::size_t n, Equal e) : data(d), count(n), equal(e) {}
};

}  // namespace tenon::layer
