// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tenon/base/function.h"
#include "tenon/base/result.h"

namespace tenon::cli {

/// Runs `module`.main(arguments) of the Python package tenon_usd in the user's python3, or the one
/// that TENON_PYTHON names, with this process's streams; gives its exit code. Nothing is taken from
/// the working directory. Errors: Missing (python.missing) where there is no Python or it has no
/// such package.
Result<int> run_python_program(const std::string& module,
                               const std::vector<std::string>& arguments);

/// What a module printed, and its exit code.
struct PythonAnswer {
  int code = 0;
  std::string output;
  std::string complaint;  ///< the last lines of its standard error
};

/// The same with nothing on standard input and the output kept: `told` gets each line of standard
/// error as it comes. Once `is_ended` says so it is interrupted as by Ctrl-C, and killed where that
/// does not end it within 10 s. Errors: also Io where the system gives no pipe, and Limit
/// (python.output) for more than 256 MiB of output.
Result<PythonAnswer> ask_python_program(const std::string& module,
                                        const std::vector<std::string>& arguments,
                                        const Function<void(const std::string& line)>& told,
                                        const Function<bool()>& is_ended);

}  // namespace tenon::cli
