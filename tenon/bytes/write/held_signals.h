// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>

/// Signals that ask this process to end, kept waiting while there is something to tidy up.
namespace tenon::bytes {

/// Between `begin` and `end` SIGHUP, SIGINT and SIGTERM wait in this thread, so that hidden files
/// and folders go before the process does. Holds of one thread may overlap; they end in the thread
/// in which they began. Other threads take signals as before.
class HeldSignals {
 public:
  HeldSignals() = default;
  HeldSignals(HeldSignals&& other) noexcept : holds_(std::exchange(other.holds_, false)) {}
  HeldSignals& operator=(HeldSignals&&) = delete;
  HeldSignals(const HeldSignals&) = delete;
  HeldSignals& operator=(const HeldSignals&) = delete;
  ~HeldSignals() { end(); }

  void begin();
  /// What waited arrives, unless another hold goes on.
  void end();

 private:
  bool holds_ = false;
};

/// A signal waits that will end the process or call a function of it: long work ends early.
bool is_asked_to_end();

}  // namespace tenon::bytes
