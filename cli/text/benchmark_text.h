// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/answers/json.h"

namespace tenon::cli {

/// benchmarked_json() for people: a line for each test on each engine.
std::string benchmark_text(const answers::Json& benchmarked);
/// benchmark_tests_json() for people.
std::string benchmark_tests_text(const answers::Json& listed);

}  // namespace tenon::cli
