// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cerrno>
#include <string>
#include <string_view>

#include <sys/stat.h>

#include "tenon/base/error.h"
#include "tenon/base/result.h"
#include "tenon/bytes/read_record.h"

/// What writing files and writing folders have in common. Functions return 0 or an error number.
namespace tenon::bytes {

/// ErrorCode::Io with rule "file.unwritable" and what to do about error `number`. `kind` is "file"
/// or "folder".
Error unwritable(const std::string& path, const char* kind, int number);
/// Whether something can be made beside `path`, whose parent has to be a folder that may be written
/// to. `shown` is the name that the message has. Errors: `unwritable`.
Result<void> check_parent(const std::string& path, const std::string& shown, const char* kind);

int write_all(int descriptor, std::string_view contents);
/// Fills `contents` from the file, and shortens it to what there was.
int read_up_to(int descriptor, std::string& contents);
FileStamp stamp_from(const struct stat& info);
/// Has the system begin to write a file to its disk, so that syncing many files one after another
/// is done in little more than the time for one. That it cannot is no error: they are synced later.
void begin_to_store(int descriptor);
/// Makes what was written to a file survive a power cut.
int sync_file(const std::string& file);
/// Makes the names in a folder survive a power cut.
int sync_folder(const std::string& folder);

/// A hidden name that this process has not used before. `folder` ends with '/', or is empty.
std::string next_hidden_name(const std::string& folder);

inline constexpr int kHiddenNames = 100;  ///< that are tried

/// Calls `make(name)` with hidden names in the folder until one is free; `name` is empty then if
/// none was.
template <class Make>
int with_free_name(const std::string& folder, std::string& name, Make make) {
  int error = EEXIST;
  for (int i = 0; i < kHiddenNames && error == EEXIST; ++i) {
    name = next_hidden_name(folder);
    error = make(name) ? 0 : errno;
  }
  if (error != 0) {
    name.clear();
  }
  return error;
}

}  // namespace tenon::bytes
