// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <ctime>
#include <string>
#include <utility>
#include <vector>

/// Stopwatches and the JSON lines that bench/run.py reads.
namespace tenon::bench {

/// What one call took.
struct Lap {
  double wall = 0;  ///< [s]
  double cpu = 0;   ///< of all threads of this process [s]
};

class Stopwatch {
 public:
  Stopwatch();
  Lap lap() const;

 private:
  std::chrono::steady_clock::time_point wall_;
  std::timespec cpu_;
};

/// Times and counts of one workload. `print` writes one JSON object per line to standard output:
///   {"workload": "open_text", "phase": "parse", "wall": [s, ...], "cpu": [s, ...]}
///   {"workload": "open_text", "count": "prims", "value": 20000}
///   {"workload": "open_text", "peak_rss_mb": 81.5}
class Report {
 public:
  explicit Report(std::string workload) : workload_(std::move(workload)) {}

  /// Runs `call`, adds its time to `phase` and returns what it returns.
  template <class Call>
  auto time(const std::string& phase, const Call& call) {
    const Stopwatch watch;
    auto result = call();
    add(phase, watch.lap());
    return result;
  }
  void add(const std::string& phase, Lap lap);
  /// A figure that both sides must agree on; the last one counts.
  void count(const std::string& name, double value);
  void print() const;

 private:
  std::string workload_;
  std::vector<std::pair<std::string, std::vector<Lap>>> phases_;  // in order of first use
  std::vector<std::pair<std::string, double>> counts_;
};

/// FILE [--repeats N] of a workload.
struct Arguments {
  std::vector<std::string> files;
  int repeats = 1;
};

/// Takes the command line apart; tells how to use the program and exits with 2 when it is wrong.
/// Sets the heap up as the command `tenon` does.
Arguments read_arguments(int count, char** values, std::size_t file_count);

/// Prints `message` to standard error and exits with 1.
[[noreturn]] void fail(const std::string& message);

/// The value of a Result; `fail` with its error else.
template <class T>
T value_or_fail(T&& result) = delete;
template <template <class> class R, class T>
T value_or_fail(R<T>&& result) {
  if (!result) {
    fail(result.error().to_string());
  }
  return std::move(*result);
}

}  // namespace tenon::bench
