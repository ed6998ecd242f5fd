// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/base/path.h"
#include "tenon/base/result.h"
#include "tenon/base/token.h"
#include "tenon/stage/prim.h"

/// Whether an API schema may be applied. Errors: ErrorCode::Invalid, rule edit.unknown-schema.
namespace tenon::edit {

/// There is an applied API schema of that name, with an instance name where it takes one:
/// "PhysicsMassAPI", "PhysicsDriveAPI:angular".
Result<void> check_api_name(Path prim, Token api);

/// The same, and the schema is for prims of that type.
Result<void> check_api(const stage::Prim& prim, Token api);

}  // namespace tenon::edit
