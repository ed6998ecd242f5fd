// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/layer/array_body.h"

#include <cstring>
#include <new>
#include <utility>

namespace tenon::layer {
namespace {

/// Elements behind the body.
struct alignas(8) OwnElements final : ArrayBody {
  OwnElements(std::size_t n, Equal e) : ArrayBody(this + 1, n, e) {}
  static void operator delete(void* memory) { ::operator delete(memory); }
};
static_assert(sizeof(OwnElements) % 8 == 0, "elements are aligned to 8 bytes at most");

struct BorrowedElements final : ArrayBody {
  BorrowedElements(const void* d, std::size_t n, Equal e, std::shared_ptr<const void> o)
      : ArrayBody(d, n, e), owner(std::move(o)) {}
  std::shared_ptr<const void> owner;
};

}  // namespace

ArrayBody* ArrayBody::copy(const void* elements, std::size_t count, std::size_t element_size,
                           Equal equal) {
  void* memory = ::operator new(sizeof(OwnElements) + count * element_size);
  auto* body = ::new (memory) OwnElements(count, equal);
  std::memcpy(static_cast<void*>(body + 1), elements, count * element_size);
  return body;
}

ArrayBody* ArrayBody::borrow(const void* elements, std::size_t count, Equal equal,
                             std::shared_ptr<const void> owner) {
  return new BorrowedElements(elements, count, equal, std::move(owner));
}

ArrayBody* ArrayBody::adopt(const void* elements, std::size_t count, Equal equal, void* owner,
                            void (*drop)(void* owner)) {
  return borrow(elements, count, equal, std::shared_ptr<const void>(owner, drop));
}

bool ArrayBody::equals(const SharedBody& other) const {
  const auto& o = static_cast<const ArrayBody&>(other);
  return count == o.count && equal(data, o.data, count);
}

}  // namespace tenon::layer
