// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A file is remembered by its identity, its times and, where asked for, a digest of its contents.
// Times tell most changes for free; the digest tells a file that was rewritten with the same bytes
// from one that was changed. One lock guards the record, because files are read by several threads.
#include "tenon/bytes/read_record.h"

#include <atomic>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "tenon/base/content_digest.h"
#include "tenon/bytes/posix_files.h"

namespace tenon::bytes {
namespace {

constexpr const char* kChanged = "file.changed";
constexpr std::size_t kDigestBytes = 64u << 20;  // larger files are compared by their times

constexpr std::size_t kMostMissing = 10'000;

std::atomic<ReadRecord*> installed{nullptr};

Error changed_error(const std::string& path) {
  return Error(ErrorCode::Io, "the file was changed by another program since it was read")
      .in_file(path)
      .with_rule(kChanged)
      .with_fix("nothing was written; run the command again");
}

/// The digest of the file's current contents; nothing when it cannot be read.
std::optional<std::uint64_t> digest_of_file(const std::string& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0) {
    return std::nullopt;
  }
  struct stat info = {};
  std::optional<std::uint64_t> digest;
  if (::fstat(descriptor, &info) == 0 && S_ISREG(info.st_mode) &&
      std::in_range<std::size_t>(info.st_size)) {
    std::string contents(static_cast<std::size_t>(info.st_size), '\0');
    if (read_up_to(descriptor, contents) == 0) {
      digest = content_digest(contents);
    }
  }
  ::close(descriptor);
  return digest;
}

bool is_unchanged(const std::string& path, const FileStamp& then, bool by_content) {
  const std::optional<FileStamp> now = stamp_of(path);
  if (!now) {
    return false;
  }
  const bool same = now->same_state(then);
  if (!then.digest || (same && !by_content)) {
    return same;
  }
  return now->size == then.size && digest_of_file(path) == then.digest;
}

}  // namespace

std::optional<FileStamp> stamp_of(const std::string& path) {
  struct stat info = {};
  if (::stat(path.c_str(), &info) != 0) {
    return std::nullopt;
  }
  return stamp_from(info);
}

ReadRecord::~ReadRecord() { uninstall(); }

ReadRecord* ReadRecord::current() { return installed.load(std::memory_order_acquire); }

void ReadRecord::install() { installed.store(this, std::memory_order_release); }

void ReadRecord::uninstall() {
  ReadRecord* self = this;
  installed.compare_exchange_strong(self, nullptr);
}

void ReadRecord::note(const std::string& path, FileStamp stamp, std::string_view contents) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (digests_ == Digests::Yes && contents.size() <= kDigestBytes) {
    stamp.digest = content_digest(contents);
  }
  identities_.insert(stamp.identity);
  const auto [known, is_new] = files_.try_emplace(path, stamp);
  if (is_new || known->second.same_state(stamp)) {
    return;
  }
  if (!stamp.digest || known->second.digest != stamp.digest) {
    changed_ = path;
  }
  known->second = stamp;
}

void ReadRecord::note(const std::string& path) {
  if (const std::optional<FileStamp> stamp = stamp_of(path)) {
    const std::lock_guard<std::mutex> lock(mutex_);
    identities_.insert(stamp->identity);
    files_.try_emplace(path, *stamp);
  }
}

void ReadRecord::note_missing(const std::string& path) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (missing_.size() < kMostMissing) {
    missing_.insert(path);
  }
}

std::vector<std::string> ReadRecord::missing() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return {missing_.begin(), missing_.end()};
}

void ReadRecord::clear() {
  const std::lock_guard<std::mutex> lock(mutex_);
  missing_.clear();
  files_.clear();
  identities_.clear();
  changed_.clear();
}

bool ReadRecord::has(const FileIdentity& file) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return identities_.contains(file);
}

std::vector<std::string> ReadRecord::paths() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::vector<std::string> paths;
  for (const auto& [path, stamp] : files_) {
    paths.push_back(path);
  }
  return paths;
}

Result<void> ReadRecord::check_unchanged(const std::set<FileIdentity>& by_content) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!changed_.empty()) {
    return changed_error(changed_);
  }
  for (const auto& [path, stamp] : files_) {
    if (!is_unchanged(path, stamp, by_content.contains(stamp.identity))) {
      return changed_error(path);
    }
  }
  return {};
}

void ReadRecord::refresh(const std::set<FileIdentity>& replaced) {
  const std::lock_guard<std::mutex> lock(mutex_);
  for (auto& [path, stamp] : files_) {
    if (replaced.contains(stamp.identity)) {
      stamp = stamp_of(path).value_or(stamp);
      identities_.insert(stamp.identity);
    }
  }
}

void note_read(const std::string& path) {
  if (ReadRecord* record = ReadRecord::current()) {
    record->note(path);
  }
}

void note_missing(const std::string& path) {
  if (ReadRecord* record = ReadRecord::current()) {
    record->note_missing(path);
  }
}

bool is_changed_meanwhile(const Error& error) { return error.diagnostic().rule == kChanged; }

}  // namespace tenon::bytes
