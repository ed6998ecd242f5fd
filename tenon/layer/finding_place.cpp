// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/layer/finding_place.h"

#include <utility>

namespace tenon::layer {

void place_finding(Diagnostic& finding, const Layer& layer, Path path, StatementPart part) {
  place_finding(finding, layer, path, path.empty() ? nullptr : layer.find(path), std::move(part));
}

void place_finding(Diagnostic& finding, const Layer& layer, Path path, const Spec* spec,
                   StatementPart part) {
  finding.file = layer.identifier();
  finding.end_line = 0;
  finding.end_column = 0;
  finding.line = spec == nullptr ? 0 : spec->line;
  finding.column = spec == nullptr ? 0 : spec->column;
  finding.part = std::move(part);
  // The root spec has no line of its own.
  const bool is_in_text = finding.line != 0 || path.is_absolute_root();
  finding.part.spec = is_in_text ? path.str() : std::string();
}

StatementPart field_part(Token field) { return {{}, field.str()}; }

StatementPart item_part(Token field, std::string item) {
  return {{}, field.str(), {}, std::move(item)};
}

StatementPart item_part(Token field, Path item) { return item_part(field, item_text(item)); }

StatementPart entry_part(Token field, std::vector<std::string> keys, std::string item) {
  return {{}, field.str(), std::move(keys), std::move(item)};
}

std::string item_text(Path path) { return "<" + path.str() + ">"; }

std::string item_text(const std::string& asset_path, Path prim_path) {
  std::string text = asset_path.empty() ? std::string() : "@" + asset_path + "@";
  return prim_path.empty() ? text : text + item_text(prim_path);
}

}  // namespace tenon::layer
