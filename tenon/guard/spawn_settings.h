// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <csignal>
#include <string>

#include <fcntl.h>
#include <spawn.h>
#include <unistd.h>

/// Internal to this folder.
namespace tenon::guard {

/// What posix_spawn is told: which descriptors the new program has, and that no signal is ignored
/// or held back there. No code of this process runs in it.
class SpawnSettings {
 public:
  /// `flags`: of posix_spawnattr_setflags, beside those for signals.
  explicit SpawnSettings(short flags = 0) {
    posix_spawn_file_actions_init(&actions_);
    posix_spawnattr_init(&attributes_);
    sigset_t all;
    sigset_t none;
    sigfillset(&all);
    sigemptyset(&none);
    posix_spawnattr_setsigdefault(&attributes_, &all);
    posix_spawnattr_setsigmask(&attributes_, &none);
    posix_spawnattr_setflags(
        &attributes_, static_cast<short>(flags | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK));
  }
  SpawnSettings(const SpawnSettings&) = delete;
  SpawnSettings& operator=(const SpawnSettings&) = delete;
  ~SpawnSettings() {
    posix_spawn_file_actions_destroy(&actions_);
    posix_spawnattr_destroy(&attributes_);
  }

  /// What the program reads from or writes to `there` leads nowhere.
  void lead_nowhere(int there) {
    posix_spawn_file_actions_addopen(&actions_, there, "/dev/null", O_RDWR, 0);
  }
  /// Ours is the program's as the descriptor `there`.
  void give(int ours, int there) { posix_spawn_file_actions_adddup2(&actions_, ours, there); }
  /// The program has no descriptor from this one on.
  void close_from(int first) { posix_spawn_file_actions_addclosefrom_np(&actions_, first); }

  /// Starts it. -> 0, or the number of the error.
  int spawn(const std::string& program, char* const arguments[], char* const environment[],
            pid_t& process) const {
    return posix_spawn(&process, program.c_str(), &actions_, &attributes_, arguments, environment);
  }

 private:
  posix_spawn_file_actions_t actions_;
  posix_spawnattr_t attributes_;
};

}  // namespace tenon::guard
