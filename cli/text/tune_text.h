// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/answers/json.h"

namespace tenon::cli {

/// tuned_json() for people; `saved`: what is to be is about to be written.
std::string tune_text(const answers::Json& tuned, bool saved);

}  // namespace tenon::cli
