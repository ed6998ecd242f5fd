// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cassert>

/// A broken invariant of our own code; never reachable from input.
#define TENON_ASSERT(condition) assert(condition)
