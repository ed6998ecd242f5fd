// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The last part of a transaction is a list of system calls, guarded twice. A child in a session of
// its own, forked with all signals blocked, takes the steps even when this process is killed. A
// journal outlives a failure of the machine: it holds only renames and removals, each of which is
// skipped when it is done already, so it can be followed from the start at any point. It is
// believed only where it can do no harm: a plain file of this user and of bounded size, about files
// below its own folder without links on the way, that moves nothing but the hidden files of
// transactions. And only where it was written: its text names its own file by number and time of
// birth, which cannot be predicted by someone who packs a journal into an archive or repository.
#include "tenon/bytes/write/edit_journal.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <filesystem>
#include <optional>

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tenon/bytes/posix_files.h"
#include "tenon/bytes/write/folder_lock.h"

namespace tenon::bytes {
namespace {

namespace fs = std::filesystem;
using Kind = CommitStep::Kind;

constexpr std::string_view kJournalHeader = "tenon journal 2 ";
constexpr off_t kJournalBytes = 64 << 20;

bool take_step(const CommitStep& step) {
  switch (step.kind) {
    case Kind::Link:
      return ::linkat(AT_FDCWD, step.from.c_str(), AT_FDCWD, step.to.c_str(), AT_SYMLINK_FOLLOW) ==
             0;
    case Kind::Rename:
      return ::rename(step.from.c_str(), step.to.c_str()) == 0;
    case Kind::Remove:
      return ::unlink(step.to.c_str()) == 0 || errno == ENOENT;
    case Kind::Sync:
      if (const int folder = ::open(step.to.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
          folder >= 0) {
        ::fsync(folder);
        ::close(folder);
      }
      return true;
  }
  return false;
}

/// `path` relative to `home`, or nothing where a journal may not name it.
std::optional<std::string> name_in(const std::string& home, const std::string& path) {
  return path.starts_with(home + "/") ? std::optional(path.substr(home.size() + 1)) : std::nullopt;
}

/// The pieces of a text that each end with a zero.
std::vector<std::string> pieces_of(std::string_view text) {
  std::vector<std::string> pieces;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\0'), text.size());
    pieces.emplace_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return pieces;
}

/// A name in a journal leads to a file below its folder, without links on the way.
bool stays_inside(const std::string& home, const std::string& name) {
  const fs::path path(name);
  std::error_code error;
  if (name.empty() || path.is_absolute() || path.lexically_normal() != path ||
      *path.begin() == ".." || !path.has_filename()) {
    return false;
  }
  const fs::path folder = (fs::path(home) / path).parent_path();
  return fs::canonical(folder, error) == folder && !error;
}

/// The steps of the journal in a file of that birth; empty for a text that is none.
std::vector<CommitStep> steps_of(const std::string& home, const std::string& birth,
                                 std::string_view text) {
  const std::vector<std::string> pieces = pieces_of(text);
  if (birth.empty() || pieces.empty() || pieces.size() % 2 != 1 ||
      pieces.front() != std::string(kJournalHeader) + birth) {
    return {};
  }
  std::vector<CommitStep> steps;
  for (std::size_t i = 1; i < pieces.size(); i += 2) {
    const std::string& from = pieces[i];
    const std::string& to = pieces[i + 1];
    const bool rename = !from.empty();
    const bool sound = stays_inside(home, to) &&
                       (!rename || (stays_inside(home, from) &&
                                    fs::path(from).filename().string().starts_with(".tenon-")));
    if (!sound) {
      return {};
    }
    steps.push_back(
        {rename ? Kind::Rename : Kind::Remove, rename ? home + "/" + from : "", home + "/" + to});
  }
  return steps;
}

/// The folders in which steps change names.
std::set<std::string> folders_of(const std::vector<CommitStep>& steps) {
  std::set<std::string> folders;
  for (const CommitStep& step : steps) {
    folders.insert(fs::path(step.to).parent_path().string());
  }
  return folders;
}

std::vector<CommitStep> syncs_of(const std::set<std::string>& folders) {
  std::vector<CommitStep> steps;
  for (const std::string& folder : folders) {
    steps.push_back({Kind::Sync, "", folder});
  }
  return steps;
}

struct Journal {
  std::string birth;
  std::string text;
};

/// A journal, if it is a file that belongs to this user.
std::optional<Journal> read_journal(const std::string& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0) {
    return std::nullopt;
  }
  struct stat info = {};
  std::optional<Journal> journal;
  if (::fstat(descriptor, &info) == 0 && S_ISREG(info.st_mode) && info.st_uid == ::geteuid() &&
      info.st_size <= kJournalBytes) {
    journal.emplace();
    journal->birth = file_birth(descriptor);
    journal->text.resize(static_cast<std::size_t>(info.st_size));
    if (read_up_to(descriptor, journal->text) != 0) {
      journal.reset();
    }
  }
  ::close(descriptor);
  return journal;
}

Result<void> finish_journal(const std::string& home) {
  TENON_TRY(const FolderLock lock, FolderLock::take({home}));  // another transaction ends first
  const std::string path = home + "/" + std::string(kJournalName);
  const std::optional<Journal> journal = read_journal(path);
  if (!journal) {
    return {};
  }
  const std::vector<CommitStep> steps = steps_of(home, journal->birth, journal->text);
  for (const CommitStep& step : steps) {
    const bool done = step.kind == Kind::Rename && ::access(step.from.c_str(), F_OK) != 0;
    if (!done && !take_step(step)) {
      return Error(ErrorCode::Io, "an edit that was interrupted cannot be finished: " +
                                      std::string(unwritable("", "file", errno).message()))
          .in_file(path)
          .with_rule("file.unwritable")
          .with_fix("allow writing in this folder, then run this again");
    }
  }
  std::vector<CommitStep> end = syncs_of(folders_of(steps));
  end.push_back({Kind::Remove, "", path});
  end.push_back({Kind::Sync, "", home});
  take_steps(end);
  return {};
}

}  // namespace

CommitPlan ordered_with_journal(std::vector<CommitStep> links, const CommitStep& journal,
                                const std::string& home, std::vector<CommitStep> changes,
                                const std::vector<std::string>& made) {
  std::set<std::string> folders = folders_of(changes);
  const auto append = [](std::vector<CommitStep>& list, const std::vector<CommitStep>& more) {
    list.insert(list.end(), more.begin(), more.end());
  };
  const std::vector<CommitStep> after = syncs_of(folders);
  for (const std::string& folder : made) {
    folders.insert(fs::path(folder).parent_path().string());
  }
  append(links, syncs_of(folders));
  append(links, {journal, {Kind::Sync, "", home}});
  append(changes, after);
  append(changes, {{Kind::Remove, "", journal.to}, {Kind::Sync, "", home}});
  return {std::move(links), std::move(changes)};
}

StepsDone take_steps(const std::vector<CommitStep>& steps) {
  StepsDone done;
  for (const CommitStep& step : steps) {
    if (!take_step(step)) {
      done.error = errno;
      return done;
    }
    ++done.count;
  }
  return done;
}

StepsDone take_steps_unkillably(const std::vector<CommitStep>& steps) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) {
    return take_steps(steps);
  }
  sigset_t all;
  sigset_t before;
  ::sigfillset(&all);
  ::pthread_sigmask(SIG_SETMASK, &all, &before);
  const pid_t child = ::fork();
  if (child == 0) {
    ::setsid();
    const StepsDone done = take_steps(steps);
    const ssize_t told = ::write(ends[1], &done, sizeof done);
    ::_exit(told == static_cast<ssize_t>(sizeof done) ? 0 : 1);
  }
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
  ::close(ends[1]);
  if (child < 0) {  // no room for one more process
    ::close(ends[0]);
    return take_steps(steps);
  }
  StepsDone done{EIO, 0};
  ssize_t got = 0;
  do {
    got = ::read(ends[0], &done, sizeof done);
  } while (got < 0 && errno == EINTR);
  ::close(ends[0]);
  while (::waitpid(child, nullptr, 0) < 0 && errno == EINTR) {
  }
  return got == static_cast<ssize_t>(sizeof done) ? done : StepsDone{EIO, 0};
}

std::string common_folder(const std::vector<std::string>& files) {
  fs::path common = fs::path(files.front()).parent_path();
  for (const std::string& file : files) {
    while (common.has_relative_path() && !file.starts_with(common.string() + "/")) {
      common = common.parent_path();
    }
  }
  return common.parent_path().has_relative_path() ? common.string() : std::string();
}

std::string file_birth(int descriptor) {
#ifdef STATX_BTIME
  struct statx info = {};
  if (::statx(descriptor, "", AT_EMPTY_PATH, STATX_INO | STATX_BTIME, &info) == 0 &&
      (info.stx_mask & STATX_BTIME) != 0) {
    return std::to_string(info.stx_ino) + " " + std::to_string(info.stx_btime.tv_sec) + " " +
           std::to_string(info.stx_btime.tv_nsec);
  }
#endif
  return {};
}

std::string journal_text(const std::string& home, const std::string& birth,
                         const std::vector<CommitStep>& steps) {
  std::string text = std::string(kJournalHeader) + birth;
  text += '\0';
  for (const CommitStep& step : steps) {
    const auto to = name_in(home, step.to);
    const auto from = step.kind == Kind::Rename ? name_in(home, step.from) : std::string();
    if (step.kind != Kind::Link && to && from) {
      text += *from + '\0' + *to + '\0';
    }
  }
  return text;
}

Result<void> finish_journals(const std::set<std::string>& folders) {
  std::set<std::string> seen;
  for (std::string folder : folders) {
    while (folder.size() > 1 && seen.insert(folder).second) {
      if (::access((folder + "/" + std::string(kJournalName)).c_str(), F_OK) == 0) {
        TENON_CHECK(finish_journal(folder));
      }
      folder = fs::path(folder).parent_path().string();
    }
  }
  return {};
}

}  // namespace tenon::bytes
