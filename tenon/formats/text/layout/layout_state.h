// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tenon/formats/text/layout/text_patch.h"
#include "tenon/layer/layer.h"

/// What the parts of `edit_text` share.
namespace tenon::formats::text {

struct LayoutState {
  const layer::Layer& before;  ///< what the text says
  const layer::Layer& after;
  const SourceMap& sources;
  TextPatch patch;
  std::string unit = "    ";  ///< of indentation
  bool failed = false;        ///< something cannot be changed in place
};

/// Where the parentheses of a spec are, or would be.
struct MetadataPlace {
  std::size_t statement = 0;  ///< its first byte, whose indentation counts
  std::size_t head_end = 0;   ///< behind which parentheses are opened
};

/// Changes the statements in the parentheses of a spec that both layers have.
void edit_metadata(LayoutState& state, Path path, const MetadataPlace& place);

/// Changes the statements of a property that both layers have.
void edit_property(LayoutState& state, Path path);

}  // namespace tenon::formats::text
