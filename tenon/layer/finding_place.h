// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/base/path.h"
#include "tenon/layer/arcs.h"
#include "tenon/layer/layer.h"

/// The places of findings in layers.
namespace tenon::layer {

/// Places a finding at the spec at `path` of `layer`: its file, and line and column where they are
/// known. The place of `part` is looked up when the finding is shown.
void place_finding(Diagnostic& finding, const Layer& layer, Path path, StatementPart part = {});
/// The same for a spec at hand.
void place_finding(Diagnostic& finding, const Layer& layer, Path path, const Spec* spec,
                   StatementPart part = {});

/// All that a field says.
StatementPart field_part(Token field);
/// One item of the list in a field, or the value in it.
StatementPart item_part(Token field, std::string item);
StatementPart item_part(Token field, Path item);
/// One entry of the dictionary in a field.
StatementPart entry_part(Token field, std::vector<std::string> keys, std::string item = {});

/// Items as StatementPart::item names them.
std::string item_text(Path path);
std::string item_text(const std::string& asset_path, Path prim_path);
inline std::string item_text(const Reference& arc) {
  return item_text(arc.asset_path, arc.prim_path);
}
inline std::string item_text(const Payload& arc) {
  return item_text(arc.asset_path, arc.prim_path);
}

}  // namespace tenon::layer
