// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/base/heap.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#ifdef __GLIBC__
#include <malloc.h>
#include <sys/mman.h>
#include <unistd.h>
#endif

namespace tenon {

#ifdef __GLIBC__
namespace {

constexpr std::size_t kMegabyte = std::size_t{1} << 20u;
constexpr std::size_t kRoom = 64 * kMegabyte;
constexpr std::size_t kLargestOnHeap = 32 * kMegabyte;

std::atomic<bool> is_kept = false;

std::uintptr_t address_of(const void* place) { return reinterpret_cast<std::uintptr_t>(place); }

// Of the pages that lie in the block as a whole.
void use_huge_pages(char* block, std::size_t size) {
  const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  const std::size_t in_front = page - address_of(block) % page;
  if (block != nullptr && in_front + page <= size) {
    ::madvise(block + in_front, (size - in_front) / page * page, MADV_HUGEPAGE);
  }
}

}  // namespace

void keep_heap_in_huge_pages() {
  ::mallopt(M_TRIM_THRESHOLD, 256 * kMegabyte);
  ::mallopt(M_MMAP_THRESHOLD, kLargestOnHeap);
  ::mallopt(M_TOP_PAD, static_cast<int>(kRoom));
  void* const first = std::malloc(kMegabyte);  // more than is left: the heap grows
  const std::size_t room = address_of(::sbrk(0)) - address_of(first);
  if (room > kRoom - kMegabyte && room < 2 * kRoom) {
    use_huge_pages(static_cast<char*>(first), room);
  }
  std::free(first);
  is_kept = true;
}

void prepare_thread_heap() {
  if (is_kept) {
    constexpr std::size_t kMax = kLargestOnHeap - 2 * kMegabyte;
    void* const first = std::malloc(kMax);
    use_huge_pages(static_cast<char*>(first), kMax);
    std::free(first);
  }
}
#else
void keep_heap_in_huge_pages() {}
void prepare_thread_heap() {}
#endif

}  // namespace tenon
