// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/base/shared_library.h"

#include <dlfcn.h>

namespace tenon {

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
  if (dladdr(reinterpret_cast<const void*>(&folder_of_this_code), &info) == 0 ||
      info.dli_fname == nullptr) {
    return {};
  }
  const std::string file = info.dli_fname;
  return file.substr(0, file.rfind('/') + 1);
}

}  // namespace tenon
