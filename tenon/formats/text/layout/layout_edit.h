// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "tenon/layer/layer.h"

namespace tenon::formats {

/// A text that says what a layer says.
struct EditedText {
  std::string text;
  bool kept_layout = false;  ///< false: the canonical text, as `write_text` gives it
};

/// `original`, the text of a layer, changed to say what `edited` says: comments, blanks, line ends
/// and the order of statements stay except for the statements that must change; new ones follow
/// their neighbours, with their indentation. The result is verified by reading it; where that
/// fails, or where `original` is no layer, it is the canonical text. Not kept: the order of
/// properties, which text sorts.
EditedText edit_text(std::string_view original, const layer::Layer& edited);

}  // namespace tenon::formats
