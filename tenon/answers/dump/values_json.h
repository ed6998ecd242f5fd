// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tenon/base/result.h"
#include "tenon/stage/stage.h"

namespace tenon::answers {

/// {TIME: value} of an attribute, in the form of layer_json.h; times are time codes or "default".
/// Errors: Invalid, for what is neither.
Result<std::string> values_at_times(const stage::Attribute& attribute,
                                    const std::vector<std::string>& times);

}  // namespace tenon::answers
