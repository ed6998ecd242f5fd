// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A record is a line that names the format, the digest of what follows, and the entry as bytes
// (base/wire.h). Its name is a number that grows, so that names in order are edits in order. The
// folder is locked while a record is added, so that two edits do not get one number.
#include "tenon/bytes/write/undo_log.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "tenon/base/limits/undo_limits.h"
#include "tenon/base/sha256.h"
#include "tenon/base/text/text_number.h"
#include "tenon/base/wire.h"
#include "tenon/bytes/posix_files.h"
#include "tenon/bytes/write/atomic_write.h"
#include "tenon/bytes/write/folder_lock.h"

namespace tenon::bytes {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kFormat = "tenon undo 1\n";
constexpr std::string_view kEnding = ".undo";
constexpr std::size_t kDigits = 12;  // of a name
constexpr std::size_t kDigestSize = 64;

std::string digest_of(std::string_view bytes) {
  Sha256 digest;
  digest.update(bytes);
  return digest.hex_digest();
}

/// The numbers of all records, from the oldest.
std::vector<std::uint64_t> numbers_in(const std::string& folder) {
  std::vector<std::uint64_t> numbers;
  std::error_code error;
  fs::directory_iterator at(folder, error);
  for (; !error && at != fs::directory_iterator(); at.increment(error)) {
    const std::string name = at->path().filename().string();
    const auto number = name.ends_with(kEnding) && name.size() == kDigits + kEnding.size()
                            ? parse_uint64(name.substr(0, kDigits))
                            : std::nullopt;
    if (number) {
      numbers.push_back(*number);
    }
  }
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

std::string record_file(const std::string& folder, std::uint64_t number) {
  std::string digits = std::to_string(number);
  digits.insert(0, kDigits - std::min(kDigits, digits.size()), '0');
  return folder + "/" + digits + std::string(kEnding);
}

std::optional<std::string> contents_of(const std::string& file) {
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
  if (descriptor < 0) {
    return std::nullopt;
  }
  struct stat info = {};
  std::optional<std::string> contents;
  if (::fstat(descriptor, &info) == 0 && S_ISREG(info.st_mode) &&
      static_cast<std::uint64_t>(info.st_size) <= limits::kUndoBytes) {
    contents.emplace(static_cast<std::size_t>(info.st_size), '\0');
    if (read_up_to(descriptor, *contents) != 0) {
      contents.reset();
    }
  }
  ::close(descriptor);
  return contents;
}

std::optional<UndoEntry> read_record(const std::string& file) {
  const std::optional<std::string> contents = contents_of(file);
  const std::size_t head = kFormat.size() + kDigestSize;
  if (!contents || !contents->starts_with(kFormat) || contents->size() < head) {
    return std::nullopt;
  }
  const std::string_view body = std::string_view(*contents).substr(head);
  return contents->substr(kFormat.size(), kDigestSize) == digest_of(body)
             ? wire::decoded<UndoEntry>(body)
             : std::nullopt;
}

/// Of the user, and nobody else's to write: what is in it is written over the user's files.
bool is_own(const std::string& folder) {
  struct stat info = {};
  return ::stat(folder.c_str(), &info) == 0 && S_ISDIR(info.st_mode) &&
         info.st_uid == ::geteuid() && (info.st_mode & 022U) == 0;
}

/// Makes a folder for the user alone, and those above it.
Result<void> make_folder(const std::string& folder) {
  std::error_code error;
  for (fs::path at; const fs::path& part : fs::path(folder)) {
    at /= part;
    if (!fs::exists(at, error) && ::mkdir(at.c_str(), 0700) != 0 && errno != EEXIST) {
      return unwritable(at.string(), "folder", errno);
    }
  }
  return is_own(folder) ? Result<void>()
                        : Error(ErrorCode::Io, "others may write in this folder")
                              .in_file(folder)
                              .with_rule("file.unwritable")
                              .with_fix("make it yours alone: chmod 700 " + folder);
}

void remove_oldest(const std::string& folder) {
  std::vector<std::uint64_t> numbers = numbers_in(folder);
  std::reverse(numbers.begin(), numbers.end());
  std::size_t bytes = 0;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const std::string file = record_file(folder, numbers[i]);
    std::error_code error;
    bytes += static_cast<std::size_t>(fs::file_size(file, error));
    if (i >= limits::kUndoEdits || bytes > limits::kUndoBytes) {
      ::unlink(file.c_str());
    }
  }
}

}  // namespace

std::optional<UndoLog> UndoLog::of_user() {
  const char* state = secure_getenv("XDG_STATE_HOME");
  if (state != nullptr && *state == '/') {
    return UndoLog(std::string(state) + "/tenon/undo");
  }
  const char* home = secure_getenv("HOME");
  return home != nullptr && *home == '/'
             ? std::optional(UndoLog(std::string(home) + "/.local/state/tenon/undo"))
             : std::nullopt;
}

Result<void> UndoLog::add(const UndoEntry& entry) const {
  TENON_CHECK(make_folder(folder_));
  TENON_TRY(const FolderLock lock, FolderLock::take({folder_}));
  const std::vector<std::uint64_t> numbers = numbers_in(folder_);
  const std::uint64_t number = numbers.empty() ? 1 : numbers.back() + 1;
  const std::string body = wire::encoded(entry);
  const std::string file = record_file(folder_, number);
  TENON_CHECK(write_file(file, std::string(kFormat) + digest_of(body) + body));
  ::chmod(file.c_str(), 0600);
  remove_oldest(folder_);
  return {};
}

std::optional<UndoLog::Found> UndoLog::last_of(const std::string& file) const {
  if (!is_own(folder_)) {
    return std::nullopt;
  }
  const std::vector<std::uint64_t> numbers = numbers_in(folder_);
  for (auto number = numbers.rbegin(); number != numbers.rend(); ++number) {
    const std::string record = record_file(folder_, *number);
    std::optional<UndoEntry> entry = read_record(record);
    const bool fits =
        entry && (entry->asset == file ||
                  std::any_of(entry->files.begin(), entry->files.end(),
                              [&](const ReplacedFile& one) { return one.path == file; }));
    if (fits) {
      return Found{record, *std::move(entry)};
    }
  }
  return std::nullopt;
}

void UndoLog::forget(const std::string& record) const { ::unlink(record.c_str()); }

}  // namespace tenon::bytes
