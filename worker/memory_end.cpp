// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Memory that cannot be had ends this process at once, with a status that says so: many libraries
// go on without looking, or end with a word about something else. This program's own functions
// stand before those of the C library for all libraries in it.
#include <cerrno>
#include <cstddef>

#include <unistd.h>

#include "worker/confine.h"

#if defined(__GLIBC__) && !defined(TENON_SANITIZE)

extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* at, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
}

namespace {

void* there(void* memory, std::size_t wanted) {
  if (memory == nullptr && wanted != 0) {
    _exit(static_cast<int>(tenon::guard::WorkerExit::OutOfMemory));
  }
  return memory;
}

}  // namespace

// Under names of their own, as compilers know what the real ones do.
extern "C" {
void* tenon_malloc(std::size_t size) __asm__("malloc");
void* tenon_malloc(std::size_t size) { return there(__libc_malloc(size), size); }
void* tenon_calloc(std::size_t count, std::size_t size) __asm__("calloc");
void* tenon_calloc(std::size_t count, std::size_t size) {
  return there(__libc_calloc(count, size), count != 0 ? size : 0);
}
void* tenon_realloc(void* at, std::size_t size) __asm__("realloc");
void* tenon_realloc(void* at, std::size_t size) { return there(__libc_realloc(at, size), size); }
void* tenon_memalign(std::size_t alignment, std::size_t size) __asm__("memalign");
void* tenon_memalign(std::size_t alignment, std::size_t size) {
  return there(__libc_memalign(alignment, size), size);
}
void* tenon_aligned_alloc(std::size_t alignment, std::size_t size) __asm__("aligned_alloc");
void* tenon_aligned_alloc(std::size_t alignment, std::size_t size) {
  return there(__libc_memalign(alignment, size), size);
}
int tenon_posix_memalign(void** at, std::size_t alignment,
                         std::size_t size) __asm__("posix_memalign");
int tenon_posix_memalign(void** at, std::size_t alignment, std::size_t size) {
  *at = there(__libc_memalign(alignment, size), size);
  return 0;
}
}

#endif
