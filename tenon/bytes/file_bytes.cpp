// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A file is opened once; its real path, kind and size are then taken from the open file, since the
// name may lead elsewhere by then. Devices, which do something when they are opened, are detected
// before. Small files are read, since mapping costs more than it saves.
#include "tenon/bytes/file_bytes.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include "tenon/base/assert.h"
#include "tenon/bytes/posix_files.h"
#include "tenon/bytes/read_record.h"

namespace tenon::bytes {
namespace {

constexpr std::size_t kMapFrom = 64u << 10;  // below this size reading is cheaper

constexpr int kFlags = O_RDONLY | O_CLOEXEC | O_NOCTTY | O_NONBLOCK;  // pipes do not hold us

/// What does something when it is opened: a tape is wound, a watchdog started.
bool is_device(const std::string& path) {
  struct stat info = {};
  const bool device =
      ::stat(path.c_str(), &info) == 0 && (S_ISCHR(info.st_mode) || S_ISBLK(info.st_mode));
  errno = device ? ENXIO : errno;
  return device;
}

/// Closes its file descriptor.
struct OpenFile {
  explicit OpenFile(const std::string& path)
      : descriptor(is_device(path) ? -1 : ::open(path.c_str(), kFlags)) {}
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  ~OpenFile() {
    if (descriptor >= 0) {
      ::close(descriptor);
    }
  }
  int descriptor;
};

Error file_error(const std::string& path, const char* what, int number) {
  const ErrorCode code =
      number == ENOENT || number == ENOTDIR ? ErrorCode::NotFound : ErrorCode::Io;
  return Error(code, std::string(what) + ": " + std::strerror(number))
      .in_file(path)
      .with_rule(code == ErrorCode::NotFound ? "file.not-found" : "file.unreadable");
}

/// The path of an open file as the system knows it, whatever `path` names by now; that of `path`
/// where the system does not say.
std::string real_path_of(int descriptor, const std::string& path) {
  std::error_code error;
  const std::string link = "/proc/self/fd/" + std::to_string(descriptor);
  const std::string real = std::filesystem::read_symlink(link, error).string();
  return error ? std::filesystem::canonical(path, error).string() : real;
}

Result<std::string> read_all(int descriptor, std::size_t size, const std::string& path) {
  std::string contents(size, '\0');
  if (const int error = read_up_to(descriptor, contents); error != 0) {
    return file_error(path, "cannot read the file", error);
  }
  if (contents.size() < size) {
    return Error(ErrorCode::Io, "the file got shorter while it was read")
        .in_file(path)
        .with_rule("file.unreadable")
        .with_fix("try again when nobody writes it");
  }
  return contents;
}

std::shared_ptr<const FileBytes> noted(std::shared_ptr<const FileBytes> bytes,
                                       const std::string& path, const struct stat& info,
                                       const FileRules& rules) {
  ReadRecord* record = ReadRecord::current();
  if (record != nullptr && rules.is_input) {
    record->note(path, stamp_from(info), bytes->text());
  }
  return bytes;
}

}  // namespace

Result<void> check_size(std::uint64_t bytes, const FileRules& rules, const std::string& path) {
  const std::uint64_t most = std::min<std::uint64_t>(rules.max_bytes, PTRDIFF_MAX);
  if (bytes <= most) {
    return {};
  }
  return Error(ErrorCode::Limit, "the file has " + std::to_string(bytes) + " bytes, more than " +
                                     std::to_string(most))
      .in_file(path)
      .with_rule("file.too-large");
}

FileBytes::~FileBytes() {
  if (mapping_ != nullptr) {
    ::munmap(mapping_, span_.size());
  }
}

Result<std::shared_ptr<const FileBytes>> FileBytes::open(const std::string& path,
                                                         const FileRules& rules) {
  const OpenFile file(path);
  if (file.descriptor < 0) {
    const int number = errno;
    std::error_code ignored;
    const bool link = std::filesystem::is_symlink(path, ignored);
    const Error error = file_error(
        path, link ? "cannot open what this symbolic link leads to" : "cannot open the file",
        number);
    note_missing(path);
    return error;
  }
  if (rules.check) {
    TENON_CHECK(rules.check(real_path_of(file.descriptor, path)));
  }
  struct stat info = {};
  if (::fstat(file.descriptor, &info) != 0) {
    return file_error(path, "cannot open the file", errno);
  }
  if (!S_ISREG(info.st_mode)) {
    const bool folder = S_ISDIR(info.st_mode);
    return Error(ErrorCode::Io, folder ? "this is a folder, not a file" : "not a regular file")
        .in_file(path)
        .with_rule("file.unreadable")
        .with_fix(folder ? "" : "save what it gives to a file, and name that");
  }
  const auto claimed = static_cast<std::uint64_t>(info.st_size);
  TENON_CHECK(check_size(claimed, rules, path));
  const auto size = static_cast<std::size_t>(claimed);
  if (size < kMapFrom || !rules.may_map) {
    TENON_TRY(std::string contents, read_all(file.descriptor, size, path));
    return noted(own(std::move(contents)), path, info, rules);
  }
  void* address = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file.descriptor, 0);
  if (address == MAP_FAILED) {
    return file_error(path, "cannot map the file", errno);
  }
  const std::shared_ptr<FileBytes> bytes(new FileBytes());
  bytes->mapping_ = address;
  bytes->span_ = {static_cast<const std::byte*>(address), size};
  return noted(bytes, path, info, rules);
}

std::shared_ptr<const FileBytes> FileBytes::own(std::string contents) {
  const std::shared_ptr<FileBytes> bytes(new FileBytes());
  bytes->owned_ = std::move(contents);
  bytes->span_ = std::as_bytes(std::span(bytes->owned_.data(), bytes->owned_.size()));
  return bytes;
}

std::shared_ptr<const FileBytes> FileBytes::slice(std::shared_ptr<const FileBytes> whole,
                                                  std::size_t offset, std::size_t size) {
  TENON_ASSERT(offset <= whole->size() && size <= whole->size() - offset);
  const std::shared_ptr<FileBytes> bytes(new FileBytes());
  bytes->span_ = whole->span().subspan(offset, size);
  bytes->whole_ = std::move(whole);
  return bytes;
}

void FileBytes::let_go(std::span<const std::byte> part) const {
  if (whole_ != nullptr) {
    return whole_->let_go(part);
  }
  static const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  const auto start = static_cast<std::size_t>(part.data() - span_.data());
  const std::size_t first = (start + page - 1) / page * page;
  const std::size_t end = (start + part.size()) / page * page;
  if (mapping_ != nullptr && first < end) {
    ::madvise(static_cast<std::byte*>(mapping_) + first, end - first, MADV_DONTNEED);
  }
}

}  // namespace tenon::bytes
