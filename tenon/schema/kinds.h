// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/base/token.h"

namespace tenon::schema {

/// `kind` is `base` or below it in the hierarchy model > (component, group > assembly);
/// "subcomponent" stands alone. Unknown kinds are nothing.
bool is_kind(Token kind, Token base);

}  // namespace tenon::schema
