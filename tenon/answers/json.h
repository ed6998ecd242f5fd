// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

namespace tenon::answers {

/// A value of JSON whose objects keep the order in which their keys were put in.
using Json = nlohmann::ordered_json;

}  // namespace tenon::answers
