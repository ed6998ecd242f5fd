// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "tenon/base/result.h"

namespace tenon::bytes {

/// One system call of the last part of a transaction.
struct CommitStep {
  /// Sync: a folder's names reach the disk. That they may not is no error.
  enum class Kind { Link, Rename, Remove, Sync };
  Kind kind = Kind::Rename;
  std::string from;  ///< Link, Rename: an open file, or a hidden name
  std::string to;
};

/// The steps of a transaction of several files.
struct CommitPlan {
  std::vector<CommitStep> before;   ///< give hidden names, and the journal its own
  std::vector<CommitStep> changes;  ///< of files; then the journal goes
};

/// The order in which a power cut leaves the files old or new, or a journal that makes them new:
/// the hidden names are on the disk before the journal is, and the journal before the first change
/// and until the last one. `links` give hidden names; `journal` gives the journal its name in
/// `home`; `changes` rename and remove; `made` are folders that are new.
CommitPlan ordered_with_journal(std::vector<CommitStep> links, const CommitStep& journal,
                                const std::string& home, std::vector<CommitStep> changes,
                                const std::vector<std::string>& made);

/// The state of the steps.
struct StepsDone {
  int error = 0;          ///< 0 or an error number
  std::size_t count = 0;  ///< steps before the one that failed
};

/// Takes the steps. A file to be removed that is not there is no error. Calls the system and
/// nothing else, so that a child may do it right after a fork.
StepsDone take_steps(const std::vector<CommitStep>& steps);
/// The same in a child, in a session of its own, that goes on when this process is killed.
StepsDone take_steps_unkillably(const std::vector<CommitStep>& steps);

/// The hidden file in which a transaction says what it is about to do.
inline constexpr std::string_view kJournalName = ".tenon-journal";

/// The folder that holds all these files; "" where that is "/" or right below it.
std::string common_folder(const std::vector<std::string>& files);
/// Number and time of birth of an open file, which no copy of it has; "" where the file system
/// keeps no such time.
std::string file_birth(int descriptor);
/// The text of the journal in `home` for those steps that rename and remove; `birth` is that of the
/// journal's own file.
std::string journal_text(const std::string& home, const std::string& birth,
                         const std::vector<CommitStep>& steps);

/// Finishes what a transaction has left when the machine failed, in these folders and in those that
/// they lie in. Files outside of a journal's folder are not touched, whatever it says, and a
/// journal that came there by an archive or a copy is not followed.
Result<void> finish_journals(const std::set<std::string>& folders);

}  // namespace tenon::bytes
