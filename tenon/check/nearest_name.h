// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <vector>

namespace tenon::check {

/// The name that `name` most likely was to be: at most two edits away (one for short names), or the
/// same but for capitals; empty when there is none, or when `name` is one of them.
std::string_view nearest_name(std::string_view name, const std::vector<std::string_view>& names);

}  // namespace tenon::check
