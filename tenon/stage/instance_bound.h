// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/stage/stage_data.h"

namespace tenon::stage {

/// Counts the prims of the stage with those below instances, each as often as it is met on a walk
/// over all of them. Prototypes within prototypes multiply: a few kilobytes can mean more prims
/// than any walk can visit. Instances that lead beyond the bound (StageOptions) stay without
/// anything below them, and a diagnostic `stage.too-many-prims` names the first of them.
void bound_instances(StageData& data);

}  // namespace tenon::stage
