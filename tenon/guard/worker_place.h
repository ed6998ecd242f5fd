// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/base/result.h"

namespace tenon::guard {

/// The path of the program tenon-worker, for a process that is not in its folder (a library in an
/// interpreter). To be called before any file is read; an empty path undoes it.
void set_worker_program(std::string path);

/// The worker's program: as set; else the environment variable TENON_WORKER; else as it is built
/// and installed: beside the library (libtenon.so) or in ../libexec/tenon from there, then the same
/// from the running program. ErrorCode::Missing with the places where it was looked for.
Result<std::string> worker_program();

}  // namespace tenon::guard
