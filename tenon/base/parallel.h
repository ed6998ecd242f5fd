// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>

namespace tenon {

/// Processors that this process may run on, at least 1; see taskset(1) for how to give it fewer.
std::size_t usable_processors();

/// Runs both calls and returns when both have ended: side by side where there are two processors,
/// else one after the other. They must not throw.
void run_both(const std::function<void()>& first, const std::function<void()>& second);

/// Calls `call(i)` for i = 0 .. count - 1, each on a thread of its own beside this one, which has
/// the last; returns when all have ended. Where no thread can be had, this one does it. They must
/// not throw.
void run_each(std::size_t count, const std::function<void(std::size_t)>& call);

/// Runs `beside` on a thread of its own while `here` runs on this one, and returns when both have
/// ended; they wait for each other in their own ways. False where no thread can be had: then
/// neither has run. They must not throw.
bool run_beside(const std::function<void()>& beside, const std::function<void()>& here);

}  // namespace tenon
