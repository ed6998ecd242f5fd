// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <type_traits>

#include "tenon/base/path.h"
#include "tenon/base/token.h"

/// Items of list edits, as verbs print them.
namespace tenon::answers {

inline std::string item_text(Token item) { return item.str(); }
inline std::string item_text(const std::string& item) { return "\"" + item + "\""; }
inline std::string item_text(Path item) { return "<" + item.str() + ">"; }

template <class Number>
  requires std::is_arithmetic_v<Number>
std::string item_text(Number item) {
  return std::to_string(item);
}

/// "@a.usda@</A> (offset 1, scale 2)" of references and payloads.
template <class Arc>
  requires requires(const Arc& arc) { arc.asset_path; }
std::string item_text(const Arc& arc) {
  std::string text = arc.asset_path.empty() ? "" : "@" + arc.asset_path + "@";
  text += arc.prim_path.empty() ? "" : item_text(arc.prim_path);
  if (!arc.offset.is_identity()) {
    text += " (offset " + std::to_string(arc.offset.offset) + ", scale " +
            std::to_string(arc.offset.scale) + ")";
  }
  return text;
}

}  // namespace tenon::answers
