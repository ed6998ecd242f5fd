// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/base/path.h"
#include "tenon/base/token.h"

namespace tenon::edit {

/// The prim that the text of `defaultPrim` means: a name of a root prim, or a path. Empty where it
/// is neither.
inline Path default_prim_path(Token text) {
  if (text.empty()) {
    return {};
  }
  const auto path = Path::parse(text.view().front() == '/' ? text.str() : "/" + text.str());
  return path ? *path : Path();
}

}  // namespace tenon::edit
