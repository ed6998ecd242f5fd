// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace tenon {

/// Text as the value of an attribute of XML in double quotes. `letters` are those that become
/// entities, some of & < > ": ">" may stand as it is.
std::string xml_text(std::string_view text, std::string_view letters = "&<\"");

}  // namespace tenon
