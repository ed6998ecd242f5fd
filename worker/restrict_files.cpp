// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Landlock: the kernel lets this process read below some folders, and write nowhere.
#include <cstdint>

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "worker/confine.h"

#if __has_include(<linux/landlock.h>)
#include <linux/landlock.h>
#endif

namespace tenon::worker {

#if defined(LANDLOCK_CREATE_RULESET_VERSION)
namespace {

/// As the newest kernel knows it; older ones take the size of what they know.
struct Ruleset {
  std::uint64_t files = 0;
  std::uint64_t network = 0;
  std::uint64_t scopes = 0;
};

constexpr std::uint64_t kReadFile = LANDLOCK_ACCESS_FS_READ_FILE;
constexpr std::uint64_t kReadFolder = LANDLOCK_ACCESS_FS_READ_DIR;

/// All rights that a version of Landlock governs: 13 in the first; 2, 3 and 5 add one each; the
/// fourth governs TCP, the sixth signals and abstract sockets to others.
Ruleset all_of(int version) {
  Ruleset rules;
  const int files = 13 + (version >= 2) + (version >= 3) + (version >= 5);
  rules.files = (std::uint64_t{1} << files) - 1;
  rules.network = version >= 4 ? 3 : 0;
  rules.scopes = version >= 6 ? 3 : 0;
  return rules;
}

std::size_t size_of(int version) { return version >= 6 ? 24 : version >= 4 ? 16 : 8; }

bool allow_below(int ruleset, const std::string& root, std::uint64_t files) {
  const int folder = open(root.c_str(), O_PATH | O_CLOEXEC);
  if (folder < 0) {
    return false;
  }
  struct stat facts{};
  const bool known = fstat(folder, &facts) == 0;
  landlock_path_beneath_attr rule{};
  rule.allowed_access = known && S_ISDIR(facts.st_mode) ? files | kReadFolder : files;
  rule.parent_fd = folder;
  const long added = syscall(SYS_landlock_add_rule, ruleset, LANDLOCK_RULE_PATH_BENEATH, &rule, 0);
  close(folder);
  return added == 0;
}

}  // namespace

int restrict_files(const std::vector<std::string>& roots,
                   const std::vector<std::string>& programs) {
  const auto version = static_cast<int>(
      syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION));
  if (version < 1) {
    return 0;
  }
  const Ruleset rules = all_of(version);
  const auto ruleset =
      static_cast<int>(syscall(SYS_landlock_create_ruleset, &rules, size_of(version), 0));
  if (ruleset < 0) {
    return 0;
  }
  for (const std::string& root : roots) {
    allow_below(ruleset, root, kReadFile);  // what cannot be allowed stays forbidden
  }
  for (const std::string& root : programs) {
    allow_below(ruleset, root, kReadFile | LANDLOCK_ACCESS_FS_EXECUTE);
  }
  const long restricted = syscall(SYS_landlock_restrict_self, ruleset, 0);
  close(ruleset);
  return restricted == 0 ? version : 0;
}

#else

int restrict_files(const std::vector<std::string>&, const std::vector<std::string>&) { return 0; }

#endif

}  // namespace tenon::worker
