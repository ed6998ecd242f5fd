// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/formats/text/layout/text_patch.h"

namespace tenon::formats::text {

/// Changes a statement with a list of texts or paths in brackets into one that says what
/// `canonical` does, item by item: items that stay keep their places and what is between them. Only
/// for items that go, or that come behind all others; false where that does not do.
bool edit_list_items(TextPatch& patch, SourceRange statement, const std::string& canonical);

}  // namespace tenon::formats::text
