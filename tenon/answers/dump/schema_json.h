// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ostream>

namespace tenon::answers {

/// Every schema that tenon knows, as JSON: `{name: {"kind", "base", "vendor", "builtInApis",
/// "canOnlyApplyTo", "properties": {name: {"type", "variability", "fallback", "allowedTokens"}}}}`.
/// Values as in write_plain_value; relationships have the type "rel"; without a fallback that
/// member is missing.
void write_schemas_json(std::ostream& out);

}  // namespace tenon::answers
