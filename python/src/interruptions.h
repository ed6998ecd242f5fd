// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include <nanobind/nanobind.h>

#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/engines/environments.h"

/// Ctrl-C, other signals and exceptions that another thread sends, while the library works: Python
/// gets to see them every kBetweenLooks instead of when the call is over.
namespace tenon::python {

inline constexpr std::chrono::milliseconds kBetweenLooks{50};

/// Lets Python see to its signals. The caller holds no interpreter. Throws nb::python_error.
void look_for_signals();
/// From here on it looks no more: Python ends, and threads that ask for it would be torn down.
void end_looks();

/// The same for a loop: looks when it is time to, and not each time that it is called.
class Interruptions {
 public:
  void look();

 private:
  std::chrono::steady_clock::time_point looked_ = std::chrono::steady_clock::now();
};

/// Steps environments in blocks that take a few milliseconds each, and looks for signals between
/// them: what is raised there leaves all environments at the same step. The caller holds no
/// interpreter.
class BlockStepper {
 public:
  /// Environments that stand still.
  std::size_t step(engines::Environments& environments, std::size_t count);
  /// Between short calls, where there are many.
  void look() { interruptions_.look(); }

 private:
  std::size_t block_ = 1;  // steps of one block, as measured
  Interruptions interruptions_;
};

/// Work on a thread of its own, which its caller can leave: then it goes on to its end by itself,
/// nothing more is written, and nobody gets its result.
class Leavable {
 public:
  /// False once the caller has left.
  bool go_on() const;
  /// Claims the right to write: false where the caller has left; a caller that is interrupted later
  /// waits until the work is done.
  bool may_write();

 protected:
  Leavable() = default;
  ~Leavable() = default;
  /// Runs `work`, which calls finish() when its result is there, and waits for that. The caller
  /// holds no interpreter. Throws nb::python_error.
  template <class Work>
  void run(Work work) {
    begin();
    std::thread([work = std::move(work)]() mutable {
      {
        Work own = std::move(work);
        own();
      }
      end();
    }).detach();
    wait();
  }
  void finish();

 private:
  static void begin();
  static void end();
  void wait();

  mutable std::mutex mutex_;
  std::condition_variable done_;
  bool is_done_ = false;
  bool left_ = false;
  bool writes_ = false;
};

/// A call on a thread of its own, with the findings of its way.
template <class T>
class LeavableCall : public Leavable, public std::enable_shared_from_this<LeavableCall<T>> {
 public:
  Diagnostics found;

  /// `call(*this)` gives a Result<T>. It owns all that it takes, for it may outlive the caller.
  template <class Call>
  Result<T> operator()(Call call) {
    run([self = this->shared_from_this(), call = std::move(call)]() mutable {
      self->result_.emplace(call(*self));
      self->finish();
    });
    return *std::move(result_);
  }

 private:
  std::optional<Result<T>> result_;
};

/// To be called before anything is written. Errors: Invalid where the caller has left.
Result<void> check_may_write(Leavable& call);

/// At the end of the program: waits for calls that were left. Throws nb::python_error.
void wait_for_left_calls();

}  // namespace tenon::python
