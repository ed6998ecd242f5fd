// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/answers/json.h"
#include "tenon/base/result.h"

namespace tenon::answers {

/// Folds a chain of list edits, strongest first, into one reduced edit. `text` is a JSON array of
/// {"explicit_items" | "deleted_items" | "added_items" | "prepended_items" | "appended_items" |
/// "ordered_items": [..]}, or an object whose "chain" is one; items are all integers or all
/// strings. Errors: ErrorCode::Parse; Unsupported where no single edit does the same (added and
/// ordered items look at the list they are applied to).
Result<Json> fold_list_ops(const std::string& text);

}  // namespace tenon::answers
