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

}  // namespace tenon
