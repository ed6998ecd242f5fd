// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/base/result.h"
#include "tenon/bytes/files.h"
#include "tenon/convert/convert_robot.h"

namespace tenon {

/// Puts the drives' gains into `options`: `text` is "K,D" for all joints, or the name of a JSON
/// file {"joint": [K, D], "*": [K, D]}, in N m/rad and N m s/rad (N/m and N s/m). Errors: Invalid.
Result<void> read_gains(const std::string& text, const bytes::Files& files,
                        convert::ConvertOptions& options);

}  // namespace tenon
