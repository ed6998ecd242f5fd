// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace tenon::engines::jolt {

/// Starts Jolt once for the process: its types, and the plane that it lacks.
void open_jolt();
/// "5.0.0"
std::string jolt_version();

}  // namespace tenon::engines::jolt
