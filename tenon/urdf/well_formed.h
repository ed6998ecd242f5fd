// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

/// Internal to this folder.
namespace tenon::urdf {

struct XmlFault {
  std::size_t offset = 0;  ///< in the text [bytes]
  std::string message;
};

/// The first breach of XML 1.0 that the parser, which balances tags and quotes, accepts: a second
/// root, text outside of it, "<" and unknown entities in text and values, attributes given twice,
/// "--" in comments, "]]>" in text, a declaration that does not come first.
std::optional<XmlFault> well_formed_fault(std::string_view text);

}  // namespace tenon::urdf
