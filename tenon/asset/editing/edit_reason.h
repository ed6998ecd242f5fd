// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/asset/edit_asset.h"
#include "tenon/asset/editing/edit_effects.h"
#include "tenon/base/diagnostics.h"

/// Internal to the wiring.
namespace tenon {

/// Why an edit changes nothing that engines receive under the variant of `view`, which was read
/// with the edit in force, and the edit that would; `in_view_alone`: it does under another one. The
/// caller sets severity and rule.
Diagnostic no_effect_finding(const PhysicsView& view, const AssetEdit& edit, bool in_view_alone);

}  // namespace tenon
