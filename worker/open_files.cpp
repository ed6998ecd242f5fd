// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// This program's own fopen and open stand before those of the C library for all libraries in it.
#include "worker/open_files.h"

#include <algorithm>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <mutex>
#include <set>
#include <string_view>
#include <utility>

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/stat.h>

#include "worker/confine.h"

namespace tenon::worker {
namespace {

constexpr std::size_t kMaxRefused = 100;

struct Held {
  std::mutex lock;
  bool is_held = false;
  std::vector<std::string> roots;
  std::vector<std::string> refused;
  std::vector<std::string> opened;
  std::set<std::string, std::less<>> allowed;  // names that were looked at
  std::set<std::pair<dev_t, ino_t>> counted;   // files that memory and time were given for
};

Held& held() {
  static Held all;
  return all;
}

bool lies_in(std::string_view path, std::string_view root) {
  return path == root || root == "/" ||
         (path.size() > root.size() && path.starts_with(root) && path[root.size()] == '/');
}

int refuse(Held& all, const char* path) {
  const bool is_new = std::find(all.refused.begin(), all.refused.end(), path) == all.refused.end();
  if (is_new && all.refused.size() < kMaxRefused) {
    all.refused.emplace_back(path);
  }
  return EACCES;
}

/// 0 where the file may be opened, else the number of the error. Links count by where they lead.
int verdict(const char* path, int flags) {
  Held& all = held();
  const std::lock_guard<std::mutex> lock(all.lock);
  if (!all.is_held) {
    return 0;
  }
  if ((flags & (O_WRONLY | O_RDWR | O_CREAT | O_TRUNC | O_APPEND)) != 0) {
    return EACCES;
  }
  if (all.allowed.contains(std::string_view(path))) {
    return 0;
  }
  char* resolved = realpath(path, nullptr);
  if (resolved == nullptr) {
    return errno;
  }
  const std::string real = resolved;
  std::free(resolved);
  struct stat facts{};
  if (stat(real.c_str(), &facts) != 0) {
    return errno;
  }
  const bool inside = std::any_of(all.roots.begin(), all.roots.end(),
                                  [&](const std::string& root) { return lies_in(real, root); });
  if (S_ISDIR(facts.st_mode)) {
    return inside ? 0 : EACCES;  // looked for only, and no loss
  }
  if (!inside || !S_ISREG(facts.st_mode)) {
    return refuse(all, path);
  }
  all.allowed.emplace(path);
  if (all.counted.emplace(facts.st_dev, facts.st_ino).second) {
    all.opened.push_back(real);
    allow_more(static_cast<std::uint64_t>(facts.st_size));
  }
  return 0;
}

template <class Function>
Function next(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

int flags_of(const char* mode) {
  return mode != nullptr && mode[0] == 'r' && std::strchr(mode, '+') == nullptr ? O_RDONLY : O_RDWR;
}

std::FILE* open_stream(const char* name, const char* path, const char* mode) {
  if (const int error = verdict(path, flags_of(mode)); error != 0) {
    errno = error;
    return nullptr;
  }
  return next<std::FILE* (*)(const char*, const char*)>(name)(path, mode);
}

int open_at(const char* name, int folder, const char* path, int flags, unsigned mode) {
  const bool apart = folder != AT_FDCWD && path[0] != '/';
  if (const int error = apart ? EACCES : verdict(path, flags); error != 0) {
    errno = error;
    return -1;
  }
  return next<int (*)(int, const char*, int, ...)>(name)(folder, path, flags, mode);
}

}  // namespace

void hold_to(const std::vector<std::string>& roots) {
  Held& all = held();
  const std::lock_guard<std::mutex> lock(all.lock);
  all.is_held = true;
  all.roots = roots;
  all.allowed.clear();
  all.counted.clear();
  all.opened.clear();
}

std::vector<std::string> take_refused() {
  Held& all = held();
  const std::lock_guard<std::mutex> lock(all.lock);
  return std::exchange(all.refused, {});
}

std::vector<std::string> take_opened() {
  Held& all = held();
  const std::lock_guard<std::mutex> lock(all.lock);
  return std::exchange(all.opened, {});
}

}  // namespace tenon::worker

// Under names of their own, as headers of the C library may have wrappers for the real ones.
extern "C" {
std::FILE* tenon_fopen(const char* path, const char* mode) __asm__("fopen");
std::FILE* tenon_fopen(const char* path, const char* mode) {
  return tenon::worker::open_stream("fopen", path, mode);
}
std::FILE* tenon_fopen64(const char* path, const char* mode) __asm__("fopen64");
std::FILE* tenon_fopen64(const char* path, const char* mode) {
  return tenon::worker::open_stream("fopen64", path, mode);
}
int tenon_open(const char* path, int flags, unsigned mode) __asm__("open");
int tenon_open(const char* path, int flags, unsigned mode) {
  return tenon::worker::open_at("openat", AT_FDCWD, path, flags, mode);
}
int tenon_open64(const char* path, int flags, unsigned mode) __asm__("open64");
int tenon_open64(const char* path, int flags, unsigned mode) {
  return tenon::worker::open_at("openat", AT_FDCWD, path, flags, mode);
}
int tenon_openat(int folder, const char* path, int flags, unsigned mode) __asm__("openat");
int tenon_openat(int folder, const char* path, int flags, unsigned mode) {
  return tenon::worker::open_at("openat", folder, path, flags, mode);
}
int tenon_openat64(int folder, const char* path, int flags, unsigned mode) __asm__("openat64");
int tenon_openat64(int folder, const char* path, int flags, unsigned mode) {
  return tenon::worker::open_at("openat", folder, path, flags, mode);
}
}
