// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/live/identifying.h"

namespace tenon::cli {

/// `tenon identify` for the panel of that name of `tenon view`; `commands` is a table of commands
/// that the logs lack, or empty. Errors: those of ask_python_program().
Result<live::IdentifyEnd> ask_identify(const live::IdentifyWish& wish, const std::string& commands,
                                       live::Work& work);

}  // namespace tenon::cli
