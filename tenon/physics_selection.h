// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/base/path.h"
#include "tenon/base/result.h"
#include "tenon/open_stage.h"
#include "tenon/stage/stage.h"

/// Variants of "Physics" that options ask for, beside that of the default prim.
namespace tenon {

/// Every prim with a variant set "Physics", depth first; of instances also what is in them.
std::vector<stage::Prim> prims_with_physics_set(const stage::Stage& stage);

/// Prims of a stage that has been composed with the options, whose variant set "Physics" has
/// `options.physics_variant` and selects another one, and that `options.physics_of` does not name.
/// Prims below instances are skipped: opinions of session layers do not reach them.
std::vector<Path> prims_to_select(const stage::Stage& stage, const OpenOptions& options);

/// Holds what was asked for against a stage that has been composed with it. Errors: NotFound
/// (variant.unknown) for a prim or a variant that there is not. Diagnostics:
/// "variant.no-physics-set" where no prim has the set, "variant.in-instance".
Result<void> check_physics_selection(const stage::Stage& stage, const OpenOptions& options,
                                     Diagnostics& diagnostics);

}  // namespace tenon
