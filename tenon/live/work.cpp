// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/live/work.h"

#include <utility>

namespace tenon::live {

using answers::Json;

Json Work::take_progress() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!std::exchange(changed_, false)) {
    return nullptr;
  }
  return {{"is", "progress"}, {"of", request_}, {"what", what_}, {"done", done_}};
}

std::vector<Json> Work::take_found() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::exchange(found_, {});
}

void Work::at(double done, std::string what) {
  const std::lock_guard<std::mutex> lock(mutex_);
  done_ = done;
  what_ = std::move(what);
  changed_ = true;
}

void Work::found(Json notice) {
  const std::lock_guard<std::mutex> lock(mutex_);
  found_.push_back(std::move(notice));
}

}  // namespace tenon::live
