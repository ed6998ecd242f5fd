// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/measure.h"

#include <cstdio>
#include <cstdlib>
#include <cstring>

#include <sys/resource.h>

#include "tenon/base/heap.h"

namespace tenon::bench {
namespace {

std::timespec cpu_now() {
  std::timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return now;
}

double peak_rss_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

void print_laps(const char* key, const std::vector<Lap>& laps, double Lap::* member) {
  std::printf(", \"%s\": [", key);
  for (std::size_t i = 0; i < laps.size(); ++i) {
    std::printf("%s%.9f", i == 0 ? "" : ", ", laps[i].*member);
  }
  std::printf("]");
}

}  // namespace

Stopwatch::Stopwatch() : wall_(std::chrono::steady_clock::now()), cpu_(cpu_now()) {}

Lap Stopwatch::lap() const {
  const std::timespec cpu = cpu_now();
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - wall_;
  return {wall.count(), static_cast<double>(cpu.tv_sec - cpu_.tv_sec) +
                            static_cast<double>(cpu.tv_nsec - cpu_.tv_nsec) * 1e-9};
}

void Report::add(const std::string& phase, Lap lap) {
  for (auto& [name, laps] : phases_) {
    if (name == phase) {
      laps.push_back(lap);
      return;
    }
  }
  phases_.push_back({phase, {lap}});
}

void Report::count(const std::string& name, double value) {
  for (auto& [known, number] : counts_) {
    if (known == name) {
      number = value;
      return;
    }
  }
  counts_.push_back({name, value});
}

void Report::print() const {
  const char* workload = workload_.c_str();
  for (const auto& [phase, laps] : phases_) {
    std::printf("{\"workload\": \"%s\", \"phase\": \"%s\"", workload, phase.c_str());
    print_laps("wall", laps, &Lap::wall);
    print_laps("cpu", laps, &Lap::cpu);
    std::printf("}\n");
  }
  for (const auto& [name, number] : counts_) {
    std::printf("{\"workload\": \"%s\", \"count\": \"%s\", \"value\": %.17g}\n", workload,
                name.c_str(), number);
  }
  std::printf("{\"workload\": \"%s\", \"peak_rss_mb\": %.1f}\n", workload, peak_rss_mb());
}

Arguments read_arguments(int count, char** values, std::size_t file_count) {
  keep_heap_in_huge_pages();
  Arguments arguments;
  for (int i = 1; i < count; ++i) {
    if (std::strcmp(values[i], "--repeats") == 0 && i + 1 < count) {
      arguments.repeats = std::atoi(values[++i]);
    } else {
      arguments.files.emplace_back(values[i]);
    }
  }
  if (arguments.files.size() != file_count || arguments.repeats < 1) {
    std::fprintf(stderr, "usage: %s FILE%s [--repeats N]\n", values[0],
                 file_count > 1 ? "..." : "");
    std::exit(2);
  }
  return arguments;
}

void fail(const std::string& message) {
  std::fprintf(stderr, "%s\n", message.c_str());
  std::exit(1);
}

}  // namespace tenon::bench
