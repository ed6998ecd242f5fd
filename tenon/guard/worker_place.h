// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/base/result.h"

namespace tenon::guard {

/// Where the program tenon-worker lies, for a process that does not stand beside it (a library in
/// an interpreter). To be called before any file is read; an empty path undoes it.
void set_worker_program(std::string path);

/// The worker's program: as set; else the environment variable TENON_WORKER; else beside the
/// running program or in ../libexec/tenon, where it is built and installed. ErrorCode::Missing with
/// the places where it was looked for.
Result<std::string> worker_program();

}  // namespace tenon::guard
