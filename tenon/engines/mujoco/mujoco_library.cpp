// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/engines/mujoco/mujoco_library.h"

#include <string>

#include <dlfcn.h>

namespace tenon {

#define TENON_MUJOCO_FUNCTION(name) decltype(&::name) name = nullptr;
#include "tenon/engines/mujoco/mujoco_functions.def"
#undef TENON_MUJOCO_FUNCTION

}  // namespace tenon

namespace tenon::engines::mujoco {
namespace {

void* opened_library = nullptr;
mjfConFilt* contact_filter = nullptr;

template <class Symbol>
bool find_symbol(void* library, const char* name, Symbol& symbol) {
  symbol = reinterpret_cast<Symbol>(dlsym(library, name));
  return symbol != nullptr;
}

/// "": all found; else what is wrong with the library.
std::string find_symbols(void* library) {
  if (!find_symbol(library, "mj_version", mj_version) || mj_version() != mjVERSION_HEADER) {
    return "it is another version than " + std::to_string(mjVERSION_HEADER);
  }
#define TENON_MUJOCO_FUNCTION(name)                \
  if (!find_symbol(library, #name, tenon::name)) { \
    return "it has no " #name;                     \
  }
#include "tenon/engines/mujoco/mujoco_functions.def"
#undef TENON_MUJOCO_FUNCTION
  return find_symbol(library, "mjcb_contactfilter", contact_filter)
             ? ""
             : "it has no mjcb_contactfilter";
}

std::string open_library() {
  std::string why;
  for (const char* file : {TENON_MUJOCO_SONAME, TENON_MUJOCO_LIBRARY}) {
    opened_library = dlopen(file, RTLD_NOW | RTLD_LOCAL);
    if (opened_library != nullptr) {
      return find_symbols(opened_library);
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

void* find_mujoco_function(const char* name) { return dlsym(opened_library, name); }

mjfConFilt& contact_filter_callback() { return *contact_filter; }

}  // namespace tenon::engines::mujoco
