// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tenon::cli {

/// The name that was probably meant by `text`: few edits away or begun with it; empty when none is
/// near. Case does not count. Of equally near ones the first.
std::string nearest_name(std::string_view text, const std::vector<std::string>& names);

/// "did you mean \"info\"?", or `otherwise` when no name is near.
std::string did_you_mean(std::string_view text, const std::vector<std::string>& names,
                         const std::string& otherwise);

/// The same for a verb, which other tools call differently: "validate" is check.
std::string verb_advice(std::string_view text, const std::vector<std::string>& verbs);

/// What to do about a file that cannot be opened: a folder, a URL, a mistyped name; or empty.
std::string file_advice(const std::string& file);

}  // namespace tenon::cli
