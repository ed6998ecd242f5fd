// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/engines/mujoco/error_hook.h"

#include <cstdio>

#include "tenon/engines/mujoco/mujoco_library.h"

namespace tenon::engines::mujoco {
namespace {

thread_local ErrorTrap* current_trap = nullptr;
mjfLogHandler previous_handler = nullptr;

// The handler is one for the whole process: calls of other users of MuJoCo, which no trap of ours
// guards, go to the handler that was there before.
void handle_message(const mjLogMessage* message) {
  ErrorTrap* trap = current_trap;
  if (trap == nullptr) {
    if (previous_handler != nullptr) {
      previous_handler(message);
    }
    return;
  }
  if (message->level == mjLOG_ERROR) {
    std::snprintf(trap->message, sizeof(trap->message), "%s", message->subject);
    std::longjmp(trap->place, 1);
  }
  if (message->level == mjLOG_WARNING && trap->warnings != nullptr) {
    trap->warnings->push_back(message->subject);
  }
}

void install_handler() {
  static const bool installed = [] {
    previous_handler = mju_setLogHandler(&handle_message);
    return true;
  }();
  static_cast<void>(installed);
}

}  // namespace

ErrorTrap::ErrorTrap() : outer(current_trap) {
  message[0] = '\0';
  install_handler();
  current_trap = this;
}

ErrorTrap::~ErrorTrap() { current_trap = outer; }

bool run_trapped(ErrorTrap& trap, void (*call)(const void*), const void* context) {
  if (setjmp(trap.place) != 0) {  // NOLINT: the only way out of MuJoCo's error function
    return false;
  }
  call(context);
  return true;
}

}  // namespace tenon::engines::mujoco
