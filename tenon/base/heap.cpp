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

void use_huge_pages(std::uintptr_t begin, std::uintptr_t end) {
  const auto page = static_cast<std::uintptr_t>(::sysconf(_SC_PAGESIZE));
  begin = (begin / page + 1) * page;
  end = end / page * page;
  if (begin < end) {
    ::madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
  }
}

}  // namespace

void keep_heap_in_huge_pages() {
  ::mallopt(M_TRIM_THRESHOLD, 256 * kMegabyte);
  ::mallopt(M_MMAP_THRESHOLD, kLargestOnHeap);
  ::mallopt(M_TOP_PAD, static_cast<int>(kRoom));
  void* const first = std::malloc(kMegabyte);  // more than is left: the heap grows
  const auto begin = reinterpret_cast<std::uintptr_t>(first);
  std::free(first);
  const auto end = reinterpret_cast<std::uintptr_t>(::sbrk(0));
  if (begin < end && end - begin > kRoom - kMegabyte && end - begin < 2 * kRoom) {
    use_huge_pages(begin, end);
  }
  is_kept = true;
}

void prepare_thread_heap() {
  if (is_kept) {
    constexpr std::size_t kMax = kLargestOnHeap - 2 * kMegabyte;
    void* const first = std::malloc(kMax);
    const auto begin = reinterpret_cast<std::uintptr_t>(first);
    std::free(first);
    use_huge_pages(begin, begin + kMax);
  }
}
#else
void keep_heap_in_huge_pages() {}
void prepare_thread_heap() {}
#endif

}  // namespace tenon
