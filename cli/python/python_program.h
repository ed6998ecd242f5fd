// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tenon/base/result.h"

namespace tenon::cli {

/// Runs `module`.main(arguments) of the Python package tenon_usd in the user's python3, or the one
/// that TENON_PYTHON names, with this process's streams; gives its exit code. Nothing is taken from
/// the working directory. Errors: Missing (python.missing) where there is no Python or it has no
/// such package.
Result<int> run_python_program(const std::string& module,
                               const std::vector<std::string>& arguments);

}  // namespace tenon::cli
