// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nanobind/nanobind.h>

#include "tenon/answers/json.h"

namespace tenon::python {

/// Dictionaries, lists, strings, numbers, None: what json.loads() would make of the printed answer.
nanobind::object to_python(const answers::Json& json);

}  // namespace tenon::python
