// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tenon/base/token.h"

namespace tenon::schema {

/// API schemas that declare a property of that name, sorted, with the instance that the name
/// belongs to: {"PhysicsDriveAPI:rotZ"} for "drive:rotZ:physics:stiffness". Schemas that only build
/// in others do not count for the properties of those. Empty when no API schema declares it.
std::vector<Token> declaring_apis(Token property);

/// Types, abstract ones too, that declare a property of that name themselves and do not inherit
/// it, sorted.
std::vector<Token> declaring_types(Token property);

}  // namespace tenon::schema
