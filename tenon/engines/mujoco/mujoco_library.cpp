// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/engines/mujoco/mujoco_library.h"

#include <string>

#include <dlfcn.h>

namespace tenon {

#define TENON_DEFINE_FUNCTION(name) decltype(&::name) name = nullptr;
TENON_MUJOCO_FUNCTIONS(TENON_DEFINE_FUNCTION)
#undef TENON_DEFINE_FUNCTION

}  // namespace tenon

namespace tenon::engines::mujoco {
namespace {

mjfConFilt* contact_filter = nullptr;

/// "": opened; else why not.
std::string find_symbols(void* library) {
  std::string missing;
  const auto find = [&](const char* name, auto& symbol) {
    symbol = reinterpret_cast<std::remove_reference_t<decltype(symbol)>>(dlsym(library, name));
    if (symbol == nullptr) {
      missing += (missing.empty() ? "it has no " : ", ") + std::string(name);
    }
  };
#define TENON_FIND_FUNCTION(name) find(#name, tenon::name);
  TENON_MUJOCO_FUNCTIONS(TENON_FIND_FUNCTION)
#undef TENON_FIND_FUNCTION
  find("mjcb_contactfilter", contact_filter);
  if (missing.empty() && mj_version() != mjVERSION_HEADER) {
    missing = std::string("it is version ") + mj_versionString();
  }
  return missing;
}

std::string open_library() {
  void* library = nullptr;
  std::string why;
  for (const char* file : {TENON_MUJOCO_SONAME, TENON_MUJOCO_LIBRARY}) {
    library = dlopen(file, RTLD_NOW | RTLD_LOCAL);
    if (library != nullptr) {
      return find_symbols(library);
    }
    const char* words = dlerror();
    why += (why.empty() ? "" : "; ") + std::string(words == nullptr ? file : words);
  }
  return why;
}

}  // namespace

Result<void> open_mujoco() {
  static const std::string fault = open_library();
  if (fault.empty()) {
    return {};
  }
  return Error(ErrorCode::Missing,
               std::string("MuJoCo's library ") + TENON_MUJOCO_SONAME + " cannot be used: " + fault)
      .with_rule("engine.missing")
      .with_fix("install tenon with its folder lib/tenon, which holds the library");
}

mjfConFilt& contact_filter_callback() { return *contact_filter; }

}  // namespace tenon::engines::mujoco
