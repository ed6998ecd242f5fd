// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/engines/mujoco/mujoco_library.h"

#include <string>

#include "tenon/base/shared_library.h"
#include "tenon/engines/mujoco/set_up/set_const_groups.h"

namespace tenon {

#define TENON_MUJOCO_FUNCTION(name) decltype(&::name) name = nullptr;
#include "tenon/engines/mujoco/mujoco_functions.def"
#undef TENON_MUJOCO_FUNCTION

}  // namespace tenon

namespace tenon::engines::mujoco {
namespace {

mjfConFilt* contact_filter = nullptr;
mjfGeneric* control = nullptr;
bool is_shared = false;  // the library was open before
bool set_up_redirected = false;

SharedLibrary open_own() {
  const std::string file = own_library(TENON_MUJOCO_SONAME);
  is_shared = SharedLibrary::is_open(file);
  return SharedLibrary::open({file});
}

const SharedLibrary& library() {
  static const SharedLibrary opened = open_own();
  return opened;
}

/// "": all found; else what is wrong with the library.
std::string find_symbols() {
  if (!library()) {
    return library().why_not();
  }
  if (!library().find("mj_version", mj_version) || mj_version() != mjVERSION_HEADER) {
    return "it is another version than " + std::to_string(mjVERSION_HEADER);
  }
#define TENON_MUJOCO_FUNCTION(name)          \
  if (!library().find(#name, tenon::name)) { \
    return "it has no " #name;               \
  }
#include "tenon/engines/mujoco/mujoco_functions.def"
#undef TENON_MUJOCO_FUNCTION
  if (!library().find("mjcb_control", control)) {
    return "it has no mjcb_control";
  }
  if (!library().find("mjcb_contactfilter", contact_filter)) {
    return "it has no mjcb_contactfilter";
  }
  set_up_redirected = !is_shared && library().redirect("mj_setConstGroups",
                                                       reinterpret_cast<void*>(&set_const_groups));
  return "";
}

}  // namespace

Result<void> open_mujoco() {
  static const std::string fault = find_symbols();
  if (fault.empty()) {
    return {};
  }
  return Error(ErrorCode::Missing,
               std::string("MuJoCo's library ") + TENON_MUJOCO_SONAME + " cannot be used: " + fault)
      .with_rule("engine.missing")
      .with_fix("install tenon with its folder lib/tenon, which holds the library");
}

bool sets_up_by_ours() { return set_up_redirected; }

void* find_mujoco_function(const char* name) { return library().address(name); }

mjfConFilt& contact_filter_callback() { return *contact_filter; }
mjfGeneric& control_callback() { return *control; }

}  // namespace tenon::engines::mujoco
