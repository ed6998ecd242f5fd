// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A call from one file of a library to another goes through a table of addresses, which the loader
// fills in and then locks. redirect() writes another address there.
#include "tenon/base/shared_library.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include <dlfcn.h>
#include <link.h>
#include <sys/mman.h>
#include <unistd.h>

namespace tenon {
namespace {

/// The file of the running program; the loader knows it only by the word that it was started with.
std::string program_file() {
  std::array<char, 4096> file{};
  const ssize_t length = readlink("/proc/self/exe", file.data(), file.size());
  return length > 0 ? std::string(file.data(), static_cast<std::size_t>(length)) : std::string();
}

#if defined(__GLIBC__) && defined(__LP64__) && (defined(__x86_64__) || defined(__aarch64__))
template <class T>
T* at(std::uintptr_t address) {
  return std::bit_cast<T*>(address);
}

/// What the loader has bound calls of functions with.
struct BoundCalls {
  std::span<const ElfW(Rela)> places;
  const ElfW(Sym) * symbols = nullptr;
  const char* names = nullptr;
};

BoundCalls bound_calls(const link_map& library) {
  BoundCalls calls;
  const ElfW(Rela)* first = nullptr;
  std::size_t bytes = 0;
  for (const ElfW(Dyn)* part = library.l_ld; part->d_tag != DT_NULL; ++part) {
    switch (part->d_tag) {
      case DT_JMPREL:
        first = at<const ElfW(Rela)>(part->d_un.d_ptr);
        break;
      case DT_PLTRELSZ:
        bytes = part->d_un.d_val;
        break;
      case DT_SYMTAB:
        calls.symbols = at<const ElfW(Sym)>(part->d_un.d_ptr);
        break;
      case DT_STRTAB:
        calls.names = at<const char>(part->d_un.d_ptr);
        break;
      default:
        break;
    }
  }
  if (first != nullptr && calls.symbols != nullptr && calls.names != nullptr) {
    calls.places = {first, bytes / sizeof(ElfW(Rela))};
  }
  return calls;
}

/// Whether the loader has taken away the right to write there.
bool is_locked(const link_map& library, std::uintptr_t place) {
  const auto* header = at<const ElfW(Ehdr)>(library.l_addr);
  const auto* parts = at<const ElfW(Phdr)>(library.l_addr + header->e_phoff);
  for (const ElfW(Phdr) & part : std::span(parts, header->e_phnum)) {
    const std::uintptr_t begin = library.l_addr + part.p_vaddr;
    if (part.p_type == PT_GNU_RELRO && place >= begin && place < begin + part.p_memsz) {
      return true;
    }
  }
  return false;
}

bool write_place(const link_map& library, std::uintptr_t place, void* function) {
  const auto size = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
  void* const page = at<void>(place / size * size);
  const bool locked = is_locked(library, place);
  if (locked && mprotect(page, size, PROT_READ | PROT_WRITE) != 0) {
    return false;
  }
  *at<void*>(place) = function;
  return !locked || mprotect(page, size, PROT_READ) == 0;
}

bool redirect_calls(void* handle, const char* name, void* function) {
  const link_map* library = nullptr;
  if (handle == nullptr || dlinfo(handle, RTLD_DI_LINKMAP, static_cast<void*>(&library)) != 0) {
    return false;
  }
  const BoundCalls calls = bound_calls(*library);
  for (const ElfW(Rela) & place : calls.places) {
    const ElfW(Sym)& symbol = calls.symbols[ELF64_R_SYM(place.r_info)];
    if (std::strcmp(calls.names + symbol.st_name, name) == 0) {
      return write_place(*library, library->l_addr + place.r_offset, function);
    }
  }
  return false;
}
#else
bool redirect_calls(void* /*handle*/, const char* /*name*/, void* /*function*/) { return false; }
#endif

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

bool SharedLibrary::redirect(const char* name, void* other) const {
  return redirect_calls(handle_, name, other);
}

bool SharedLibrary::is_open(const std::string& file) {
  void* const handle = dlopen(file.c_str(), RTLD_LAZY | RTLD_NOLOAD);
  if (handle != nullptr) {
    dlclose(handle);
  }
  return handle != nullptr;
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
