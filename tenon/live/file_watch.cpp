// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/live/file_watch.h"

#include <algorithm>
#include <utility>

namespace tenon::live {

bool FileWatch::same(const Stamps& a, const Stamps& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& one, const auto& other) {
    if (one.first != other.first || one.second.has_value() != other.second.has_value()) {
      return false;
    }
    return !one.second || one.second->same_state(*other.second);
  });
}

FileWatch::Stamps FileWatch::stamps_now() const {
  Stamps now;
  for (const auto& [path, stamp] : known_) {
    now[path] = bytes::stamp_of(path);
  }
  return now;
}

void FileWatch::begin(const std::vector<std::string>& paths) {
  known_.clear();
  changed_.reset();
  changed_before_ = false;
  for (const std::string& path : paths) {
    known_[path] = bytes::stamp_of(path);
  }
}

bool FileWatch::look() {
  Stamps now = stamps_now();
  if (same(now, known_) && !changed_before_) {
    changed_.reset();
    return false;
  }
  const bool settled = changed_ && same(now, *changed_);
  if (settled) {
    known_ = std::move(now);
    changed_.reset();
    changed_before_ = false;
  } else {
    changed_ = std::move(now);
  }
  return settled;
}

}  // namespace tenon::live
