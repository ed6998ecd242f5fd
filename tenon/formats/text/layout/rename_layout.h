// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "tenon/formats/text/layout/source_map.h"
#include "tenon/layer/layer.h"

namespace tenon::formats::text {

/// The text with the new names of prims that are renamed in `after`, which is to say that one of
/// the children of a prim has another name at the same place; nothing when none is.
std::optional<std::string> with_new_names(std::string_view text, const SourceMap& sources,
                                          const layer::Layer& before, const layer::Layer& after);

}  // namespace tenon::formats::text
