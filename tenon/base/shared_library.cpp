// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/base/shared_library.h"

#include <array>

#include <dlfcn.h>
#include <link.h>
#include <unistd.h>

namespace tenon {
namespace {

/// The file of the running program; the loader knows it only by the word that it was started with.
std::string program_file() {
  std::array<char, 4096> file{};
  const ssize_t length = readlink("/proc/self/exe", file.data(), file.size());
  return length > 0 ? std::string(file.data(), static_cast<std::size_t>(length)) : std::string();
}

}  // namespace

SharedLibrary SharedLibrary::open(const std::vector<std::string>& files, Binding binding) {
  SharedLibrary library;
  for (const std::string& file : files) {
    if (file.empty()) {
      continue;
    }
    library.handle_ =
        dlopen(file.c_str(), (binding == Binding::Now ? RTLD_NOW : RTLD_LAZY) | RTLD_LOCAL);
    if (library.handle_ != nullptr) {
      library.why_not_.clear();
      return library;
    }
    const char* words = dlerror();
    library.why_not_ += (library.why_not_.empty() ? "" : "; ") + (words == nullptr ? file : words);
  }
  return library;
}

void* SharedLibrary::address(const char* name) const {
  return handle_ == nullptr ? nullptr : dlsym(handle_, name);
}

std::string folder_of_this_code() {
  Dl_info info{};
  void* found = nullptr;
  if (dladdr1(reinterpret_cast<const void*>(&folder_of_this_code), &info, &found,
              RTLD_DL_LINKMAP) == 0 ||
      found == nullptr) {
    return {};
  }
  const std::string name = static_cast<const link_map*>(found)->l_name;  // the program has none
  const std::string file = name.empty() ? program_file() : name;
  // A relative path would be another one after a change of the working directory.
  return file.starts_with('/') ? file.substr(0, file.rfind('/') + 1) : std::string();
}

std::string own_library(const std::string& name) {
  const std::string folder = folder_of_this_code();
  const std::string file = folder + "tenon/" + name;
  return !folder.empty() && access(file.c_str(), R_OK) == 0 ? file : name;
}

}  // namespace tenon
