// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nanobind/nanobind.h>

namespace tenon::python {

/// Functions of files: check, diff, compare, convert, structure, engines.
void bind_functions(nanobind::module_& module);

}  // namespace tenon::python
