// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/base/parallel.h"

#include <pthread.h>
#if defined(__linux__)
#include <sched.h>
#else
#include <thread>
#endif

#include <vector>

#include "tenon/base/heap.h"

namespace tenon {
namespace {

struct Numbered {
  const std::function<void(std::size_t)>* call = nullptr;
  std::size_t number = 0;
};

void* run_numbered(void* numbered) {
  prepare_thread_heap();
  const auto* task = static_cast<const Numbered*>(numbered);
  (*task->call)(task->number);
  return nullptr;
}

}  // namespace

std::size_t usable_processors() {
#if defined(__linux__)  // those that this process may use, not those of the machine
  cpu_set_t set;
  CPU_ZERO(&set);
  const int count = sched_getaffinity(0, sizeof(set), &set) == 0 ? CPU_COUNT(&set) : 1;
#else
  const unsigned count = std::thread::hardware_concurrency();
#endif
  return count < 1 ? 1 : static_cast<std::size_t>(count);
}

void run_both(const std::function<void()>& first, const std::function<void()>& second) {
  if (usable_processors() > 1) {
    run_each(2, [&](std::size_t i) { i == 0 ? first() : second(); });
  } else {
    second();
    first();
  }
}

bool run_beside(const std::function<void()>& beside, const std::function<void()>& here) {
  const std::function<void(std::size_t)> call = [&](std::size_t) { beside(); };
  Numbered task{&call, 0};
  pthread_t thread{};
  if (pthread_create(&thread, nullptr, run_numbered, &task) != 0) {
    return false;
  }
  here();
  pthread_join(thread, nullptr);
  return true;
}

// Not std::thread: where no thread can be had, that one throws.
void run_each(std::size_t count, const std::function<void(std::size_t)>& call) {
  std::vector<Numbered> tasks(count, Numbered{&call, 0});
  std::vector<pthread_t> threads;
  std::vector<std::size_t> own;
  for (std::size_t i = 0; i < count; ++i) {
    tasks[i].number = i;
    pthread_t thread{};
    if (i + 1 < count && pthread_create(&thread, nullptr, run_numbered, &tasks[i]) == 0) {
      threads.push_back(thread);
    } else {
      own.push_back(i);
    }
  }
  for (const std::size_t i : own) {
    call(i);
  }
  for (const pthread_t thread : threads) {
    pthread_join(thread, nullptr);
  }
}

}  // namespace tenon
