// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/base/system/resident_memory.h"

#include <cstdlib>

#include <fcntl.h>
#include <unistd.h>

namespace tenon {

std::optional<double> resident_memory() {
  const int file = ::open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
  if (file < 0) {
    return std::nullopt;
  }
  char text[128] = {};
  const ssize_t size = ::read(file, text, sizeof(text) - 1);
  ::close(file);
  char* rest = nullptr;
  std::strtoull(text, &rest, 10);  // all that is mapped
  if (size <= 0 || rest == text) {
    return std::nullopt;
  }
  const unsigned long long pages = std::strtoull(rest, nullptr, 10);
  return static_cast<double>(pages) * static_cast<double>(::sysconf(_SC_PAGESIZE));
}

}  // namespace tenon
