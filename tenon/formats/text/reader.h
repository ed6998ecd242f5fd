// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/layer/layer.h"

namespace tenon::formats {
namespace text {
struct SourceMap;
}

/// Reads a text layer (.usda). Accepts what OpenUSD 26.11 accepts (Core Spec 1.0.1 section 16.2),
/// headers `#usda 1.0` to `#usda 1.4`. Every spec knows its source line and column.
/// Errors: ErrorCode::Parse with file (`identifier`), line, column, what was expected and found;
/// Unsupported for other versions; Limit for nesting beyond limits::kTextNestingDepth.
/// Diagnostics: warnings about text that is read but does not mean what it seems to.
Result<layer::Layer> read_text(std::string_view text, std::string identifier,
                               Diagnostics& diagnostics);

/// The same, with the second half read beside the first where the layout of the lines tells which
/// prims it is in; `read_text` does so with long text. Equal results for every text.
Result<layer::Layer> read_text_in_halves(std::string_view text, std::string identifier,
                                         Diagnostics& diagnostics);

/// The same; notes in `sources` (source_map.h) where all statements stand.
Result<layer::Layer> read_text_with_sources(std::string_view text, std::string identifier,
                                            Diagnostics& diagnostics, text::SourceMap& sources);

}  // namespace tenon::formats
