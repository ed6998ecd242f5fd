// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <csetjmp>
#include <string>
#include <vector>

#include "tenon/base/result.h"
#include "tenon/engines/mujoco/mujoco_library.h"

/// MuJoCo ends the process on a fatal error unless its log handler leaves it. Ours jumps back to
/// the call that was guarded on this thread and collects warnings instead of printing them.
namespace tenon::engines::mujoco {

/// Where this thread goes when MuJoCo reports a fatal error; one per guarded call, nested ones
/// allowed.
struct ErrorTrap {
  ErrorTrap();
  ~ErrorTrap();
  ErrorTrap(const ErrorTrap&) = delete;
  ErrorTrap& operator=(const ErrorTrap&) = delete;

  std::jmp_buf place;
  char message[1024];                            ///< set when left
  std::vector<std::string>* warnings = nullptr;  ///< nullptr: dropped
  ErrorTrap* outer = nullptr;
};

/// Calls `call(context)` inside the trap; false when a fatal error left it.
bool run_trapped(ErrorTrap& trap, void (*call)(const void*), const void* context);

/// Runs `call`, which must own nothing that has a destructor: a fatal error leaves it by longjmp.
/// MuJoCo is open. Errors: Invalid with MuJoCo's words. The process lives on.
template <class Call>
Result<void> guarded_where_open(const Call& call, std::vector<std::string>* warnings = nullptr) {
  ErrorTrap trap;
  trap.warnings = warnings;
  const auto run = [](const void* context) { (*static_cast<const Call*>(context))(); };
  if (!run_trapped(trap, run, &call)) {
    return Error(ErrorCode::Invalid, std::string("MuJoCo: ") + trap.message)
        .with_rule("mujoco.error");
  }
  return {};
}

/// The same where MuJoCo may not be open yet. Errors: those of open_mujoco, too.
template <class Call>
Result<void> guarded(const Call& call, std::vector<std::string>* warnings = nullptr) {
  TENON_CHECK(open_mujoco());
  return guarded_where_open(call, warnings);
}

}  // namespace tenon::engines::mujoco
