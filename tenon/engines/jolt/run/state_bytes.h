// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstring>
#include <string>
#include <string_view>

#include "tenon/engines/jolt/jolt_headers.h"
//
#include <Jolt/Physics/StateRecorder.h>

namespace tenon::engines::jolt {

/// Bytes that Jolt writes its state to, or reads it from.
class StateBytes final : public JPH::StateRecorder {
 public:
  StateBytes() = default;
  explicit StateBytes(std::string_view bytes) : bytes_(bytes) {}
  const std::string& bytes() const { return bytes_; }

  // NOLINTBEGIN(readability-identifier-naming): names of Jolt
  void WriteBytes(const void* data, size_t count) override {
    bytes_.append(static_cast<const char*>(data), count);
  }
  void ReadBytes(void* data, size_t count) override {
    if (count > bytes_.size() - at_) {
      failed_ = true;
      std::memset(data, 0, count);
      return;
    }
    std::memcpy(data, bytes_.data() + at_, count);
    at_ += count;
  }
  bool IsEOF() const override { return at_ >= bytes_.size(); }
  bool IsFailed() const override { return failed_; }
  // NOLINTEND(readability-identifier-naming)

 private:
  std::string bytes_;
  std::size_t at_ = 0;
  bool failed_ = false;
};

}  // namespace tenon::engines::jolt
