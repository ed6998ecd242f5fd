// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/asset/edit_asset.h"
#include "tenon/base/path.h"
#include "tenon/base/result.h"
#include "tenon/edit/stage_editor.h"
#include "tenon/property_value.h"

/// Internal to the wiring.
namespace tenon {

/// Authors an edit of one file at the editor's target, as one step; `spec` is the object there.
Result<void> author_edit(edit::StageEditor& editor, const AssetEdit& edit, Path spec,
                         const PropertyValue& typed);

}  // namespace tenon
