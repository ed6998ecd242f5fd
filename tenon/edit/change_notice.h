// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tenon/base/path.h"
#include "tenon/edit/layer_change.h"
#include "tenon/stage/stage.h"

namespace tenon::edit {

/// What became different in a stage. Paths are sorted; those below an instance name the proxies.
struct ChangeNotice {
  /// Prims that came, went or are composed of other opinions, with all that is below them; and
  /// properties that came or went. "/" alone: everything.
  std::vector<Path> resynced;
  /// Prims and properties outside of those whose values or metadata may differ.
  std::vector<Path> changed_info;

  bool empty() const { return resynced.empty() && changed_info.empty(); }
};

/// Compares a stage before and after edits of its layers.
ChangeNotice compare_stages(const stage::Stage& before, const stage::Stage& after,
                            const std::vector<LayerChange>& changes);

}  // namespace tenon::edit
