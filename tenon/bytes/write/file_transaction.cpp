// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A commit is a list of passes, of which the last changes files: places are found and judged,
// devices written, contents written beside their places and synced, folders locked, and what was
// read is compared once more. Only renames and removals are left then, and what fails before them
// has changed no file. The journal gets its name after the hidden files have theirs and loses it
// last. A step that fails before the first rename takes these names back; after that, or when the
// machine fails, the journal stays and the next transaction goes on. A single file is one rename
// and needs no journal.
#include "tenon/bytes/write/file_transaction.h"

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <optional>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "tenon/base/sha256.h"
#include "tenon/bytes/asset_resolver.h"
#include "tenon/bytes/posix_files.h"
#include "tenon/bytes/read_record.h"
#include "tenon/bytes/write/edit_journal.h"
#include "tenon/bytes/write/folder_lock.h"
#include "tenon/bytes/write/held_signals.h"
#include "tenon/bytes/write/new_file.h"

namespace tenon::bytes {
namespace {

namespace fs = std::filesystem;
using Kind = CommitStep::Kind;

constexpr std::size_t kNamelessFiles = 200;  // that are open at once; more get hidden names

Error refused(const std::string& path, const std::string& why, const std::string& fix) {
  return Error(ErrorCode::Io, "cannot write the file: " + why)
      .in_file(path)
      .with_rule("file.unwritable")
      .with_fix(fix);
}

Error is_input(const std::string& path) {
  return Error(ErrorCode::Invalid, "this file is an input of the run, and writing would destroy it")
      .in_file(path)
      .with_rule("output.is-input")
      .with_fix("name another file");
}

Error twice(const std::string& path) {
  return Error(ErrorCode::Invalid, "two outputs of this run have this place")
      .in_file(path)
      .with_rule("output.twice")
      .with_fix("name two files");
}

/// An absolute path without links in its folders, as far as they exist.
std::string real_place(const std::string& path) {
  const fs::path target = absolute_file_path(follow_links(path));
  std::error_code error;
  const fs::path folder = fs::weakly_canonical(target.parent_path(), error);
  return error ? target.string() : (folder / target.filename()).string();
}

std::string folder_of(const std::string& file) {
  return file.substr(0, std::max<std::size_t>(file.rfind('/'), 1));
}

/// Makes a file's folder and those above it; `made` gets those that were not there.
int make_folders(const std::string& folder, std::vector<std::string>& made) {
  std::vector<std::string> missing;
  for (std::string at = folder; ::access(at.c_str(), F_OK) != 0 && at.size() > 1;
       at = folder_of(at)) {
    missing.push_back(at);
  }
  for (auto at = missing.rbegin(); at != missing.rend(); ++at) {
    if (::mkdir(at->c_str(), 0777) == 0) {
      made.push_back(*at);
    } else if (errno != EEXIST) {
      return errno;
    }
  }
  return 0;
}

}  // namespace

/// One commit.
class Commit {
 public:
  Commit(const FileTransaction& transaction, const CommitOptions& options)
      : transaction_(transaction), options_(options) {}
  Commit(const Commit&) = delete;
  Commit& operator=(const Commit&) = delete;
  ~Commit() {
    files_.clear();
    for (auto folder = made_folders_.rbegin(); folder != made_folders_.rend(); ++folder) {
      ::rmdir(folder->c_str());  // those in use stay
    }
  }

  Result<void> run() {
    TENON_CHECK(find_places());
    TENON_CHECK(write_devices());
    if (places_.empty() && removals_.empty()) {
      return {};
    }
    TENON_CHECK(write_beside());
    const bool alone = places_.size() == 1 && removals_.empty();
    const bool asked = options_.in_place || options_.check || options_.replaced != nullptr;
    if (alone && !asked && transaction_.held_.empty()) {
      return finish(files_.front().rename_to(places_.front().target));
    }
    const std::set<std::string> folders = folders_to_lock();
    TENON_CHECK(finish_journals(folders));
    TENON_TRY(const FolderLock lock, FolderLock::take(folders));
    TENON_CHECK(check_unchanged());
    std::optional<std::vector<ReplacedFile>> replaced_files = read_replaced();
    TENON_CHECK(finish(alone ? files_.front().rename_to(places_.front().target) : exchange()));
    if (replaced_files) {
      *options_.replaced = *std::move(replaced_files);
    }
    return {};
  }

 private:
  struct Place {
    std::string path;    // as it was given
    std::string target;  // what links lead to
    std::string_view contents;
    std::optional<struct stat> old;
  };

  Result<void> find_places() {
    std::set<std::string> targets;
    std::set<FileIdentity> identities;
    for (const FileTransaction::Put& put : transaction_.puts_) {
      Place place{put.path, real_place(put.path), put.contents, std::nullopt};
      struct stat info = {};
      if (::stat(place.target.c_str(), &info) == 0) {
        place.old = info;
      }
      if (place.old && S_ISDIR(place.old->st_mode)) {
        return refused(put.path, "it is a folder", "name a file in it");
      }
      const bool device = place.old && !S_ISREG(place.old->st_mode);
      if (!device && (!targets.insert(place.target).second ||
                      (place.old && !identities.insert(stamp_from(*place.old).identity).second))) {
        return twice(put.path);
      }
      if (!device) {
        TENON_CHECK(check_replaceable(place));
      }
      (device ? devices_ : places_).push_back(std::move(place));
    }
    for (const FileTransaction::Removal& removal : transaction_.removals_) {
      // A link goes itself, not what it leads to.
      const fs::path path = absolute_file_path(removal.path);
      std::error_code error;
      const fs::path folder = fs::weakly_canonical(path.parent_path(), error);
      removals_.push_back({(folder / path.filename()).string(), real_place(removal.top)});
    }
    return {};
  }

  Result<void> check_replaceable(const Place& place) const {
    if (!place.old) {
      return {};
    }
    const ReadRecord* record = ReadRecord::current();
    if (!options_.in_place && record != nullptr && record->has(stamp_from(*place.old).identity)) {
      return is_input(place.path);
    }
    if ((place.old->st_mode & 0222u) == 0 || ::access(place.target.c_str(), W_OK) != 0) {
      return refused(place.path, "it is read-only",
                     "allow writing (chmod u+w), or write elsewhere");
    }
    return {};
  }

  Result<void> write_devices() const {
    for (const Place& place : devices_) {
      const int descriptor = ::open(place.target.c_str(), O_WRONLY | O_CLOEXEC);
      int error = descriptor < 0 ? errno : write_all(descriptor, place.contents);
      if (descriptor >= 0 && ::close(descriptor) != 0 && error == 0) {
        error = errno;
      }
      if (error != 0) {
        return unwritable(place.path, "file", error);
      }
    }
    return {};
  }

  Result<void> write_beside() {
    if (options_.make_folders) {
      held_.begin();
    }
    for (const Place& place : places_) {
      if (const int error = is_asked_to_end() ? EINTR : write_beside(place); error != 0) {
        return unwritable(place.path, "file", error);
      }
    }
    for (std::size_t i = 0; i < files_.size(); ++i) {
      const int error = files_[i].name().empty() || i < kNamelessFiles
                            ? files_[i].sync()
                            : sync_file(files_[i].name());
      if (error != 0) {
        return unwritable(places_[i].path, "file", error);
      }
    }
    return {};
  }

  int write_beside(const Place& place) {
    const std::string folder = folder_of(place.target);
    int error = options_.make_folders ? make_folders(folder, made_folders_) : 0;
    const bool many = files_.size() >= kNamelessFiles;
    NewFile& file = files_.emplace_back(folder == "/" ? folder : folder + "/");
    error = error != 0 ? error : file.open(many ? NewFile::Name::Hidden : NewFile::Name::None);
    if (error == 0 && place.old) {
      error = file.take_over(*place.old);
    }
    error = error != 0 ? error : file.write(place.contents);
    if (many) {
      file.close();
    }
    return error;
  }

  std::set<std::string> folders_to_lock() {
    std::set<std::string> folders = transaction_.held_;
    std::vector<std::string> all;
    for (const Place& place : places_) {
      all.push_back(place.target);
    }
    for (const FileTransaction::Removal& removal : removals_) {
      all.push_back(removal.path);
    }
    for (const std::string& file : all) {
      folders.insert(folder_of(file));
    }
    home_ = common_folder(all);
    if (!home_.empty() && all.size() > 1) {
      folders.insert(home_);
    }
    return folders;
  }

  Result<void> check_unchanged() const {
    if (options_.check) {
      TENON_CHECK(options_.check());
    }
    const ReadRecord* record = ReadRecord::current();
    if (!options_.in_place || record == nullptr) {
      return {};
    }
    return record->check_unchanged(replaced());
  }

  /// What the files hold, while nobody else may write; nothing where nobody asks, one cannot be
  /// read or they are too large.
  std::optional<std::vector<ReplacedFile>> read_replaced() const {
    if (options_.replaced == nullptr) {
      return std::nullopt;
    }
    std::vector<ReplacedFile> files;
    std::size_t left = options_.most_replaced;
    for (const Place& place : places_) {
      Sha256 digest;
      digest.update(place.contents);
      files.push_back({place.target, std::nullopt, digest.hex_digest()});
      if (place.old && !read_before(place.target, left, files.back())) {
        return std::nullopt;
      }
    }
    for (const FileTransaction::Removal& removal : removals_) {
      files.push_back({removal.path, std::nullopt, std::nullopt});
      struct stat info = {};
      const bool is_file = ::lstat(removal.path.c_str(), &info) == 0 && S_ISREG(info.st_mode);
      if (!is_file || !read_before(removal.path, left, files.back())) {
        return std::nullopt;
      }
    }
    return files;
  }

  /// False where the file cannot be read or holds more than `left` bytes, which it takes off.
  static bool read_before(const std::string& path, std::size_t& left, ReplacedFile& file) {
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    struct stat info = {};
    if (descriptor < 0) {
      return false;
    }
    bool read = ::fstat(descriptor, &info) == 0 && S_ISREG(info.st_mode) &&
                static_cast<std::uint64_t>(info.st_size) <= left;
    if (read) {
      std::string contents(static_cast<std::size_t>(info.st_size), '\0');
      read = read_up_to(descriptor, contents) == 0 &&
             contents.size() == static_cast<std::size_t>(info.st_size);
      left -= contents.size();
      file.before = std::move(contents);
    }
    ::close(descriptor);
    return read;
  }

  std::set<FileIdentity> replaced() const {
    std::set<FileIdentity> identities;
    for (const Place& place : places_) {
      if (place.old) {
        identities.insert(stamp_from(*place.old).identity);
      }
    }
    return identities;
  }

  /// Gives all files their places. 0 or an error number.
  int exchange() {
    std::vector<CommitStep> links;
    std::vector<CommitStep> steps;
    for (std::size_t i = 0; i < places_.size(); ++i) {
      std::string name = files_[i].name();
      if (name.empty()) {
        name = next_hidden_name(folder_of(places_[i].target) + "/");
        links.push_back({Kind::Link, files_[i].link_source(), name});
      }
      steps.push_back({Kind::Rename, name, places_[i].target});
    }
    for (const FileTransaction::Removal& removal : removals_) {
      steps.push_back({Kind::Remove, "", removal.path});
    }
    NewFile journal(home_ + "/");
    const CommitPlan plan = with_journal(journal, std::move(links), std::move(steps));
    std::vector<CommitStep> all = plan.before;
    all.insert(all.end(), plan.changes.begin(), plan.changes.end());
    const StepsDone done = take_steps_unkillably(all);
    if (done.error != 0 && done.count <= plan.before.size()) {
      undo_links(plan.before, done.count);
      return done.error;
    }
    for (NewFile& file : files_) {
      file.let_go();  // it has its place, or the journal names it
    }
    return done.error;
  }

  /// Where it cannot be written, an unkillable child is all there is.
  CommitPlan with_journal(NewFile& journal, std::vector<CommitStep> links,
                          std::vector<CommitStep> steps) const {
    const auto is_written = [&] {
      if (home_.empty() || journal.open() != 0) {
        return false;
      }
      const std::string birth = file_birth(journal.descriptor());
      return !birth.empty() && journal.write(journal_text(home_, birth, steps)) == 0 &&
             journal.sync() == 0;
    };
    if (!is_written()) {
      return {std::move(links), std::move(steps)};
    }
    const bool nameless = journal.name().empty();
    const CommitStep name{nameless ? Kind::Link : Kind::Rename,
                          nameless ? journal.link_source() : journal.name(),
                          home_ + "/" + std::string(kJournalName)};
    return ordered_with_journal(std::move(links), name, home_, std::move(steps), made_folders_);
  }

  static void undo_links(const std::vector<CommitStep>& links, std::size_t count) {
    for (std::size_t i = 0; i < std::min(count, links.size()); ++i) {
      if (links[i].kind != Kind::Sync) {
        ::unlink(links[i].to.c_str());
      }
    }
  }

  Result<void> finish(int error) {
    if (error != 0) {
      const std::string& path = places_.empty() ? removals_.front().path : places_.front().path;
      return unwritable(path, "file", error);
    }
    std::set<std::string> folders;
    for (const Place& place : places_) {
      folders.insert(folder_of(place.target));
    }
    for (const FileTransaction::Removal& removal : removals_) {
      for (std::string at = folder_of(removal.path);
           at.starts_with(removal.top + "/") && ::rmdir(at.c_str()) == 0; at = folder_of(at)) {
      }
    }
    for (const std::string& folder : folders) {
      sync_folder(folder);  // that it may be lost in a power cut is no error
    }
    if (ReadRecord* record = ReadRecord::current()) {
      record->refresh(replaced());
    }
    return {};
  }

  const FileTransaction& transaction_;
  const CommitOptions& options_;
  std::vector<Place> places_;
  std::vector<Place> devices_;
  std::vector<FileTransaction::Removal> removals_;
  std::vector<NewFile> files_;  // for each place
  std::vector<std::string> made_folders_;
  HeldSignals held_;  // while folders may be new and empty
  std::string home_;
};

void FileTransaction::put(std::string path, std::string_view contents) {
  puts_.push_back({std::move(path), contents});
}

void FileTransaction::remove(std::string path, std::string top) {
  removals_.push_back({std::move(path), std::move(top)});
}

Result<void> FileTransaction::commit(const CommitOptions& options) const {
  return Commit(*this, options).run();
}

Result<void> check_holds_no_input(const std::string& folder) {
  const ReadRecord* record = ReadRecord::current();
  if (record == nullptr) {
    return {};
  }
  std::error_code error;
  fs::recursive_directory_iterator at(folder, error);
  for (; !error && at != fs::recursive_directory_iterator(); at.increment(error)) {
    const auto stamp = stamp_of(at->path().string());
    if (stamp && record->has(stamp->identity)) {
      return is_input(at->path().string());
    }
  }
  return {};
}

}  // namespace tenon::bytes
