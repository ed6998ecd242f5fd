// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/layer/fields.h"

namespace tenon::layer::fields {

FieldNames::FieldNames() = default;

}  // namespace tenon::layer::fields
