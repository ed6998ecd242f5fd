// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nanobind/nanobind.h>

namespace tenon::python {

/// Functions that make a file or edit one: new, pose, undo.
void bind_edit_functions(nanobind::module_& module);

}  // namespace tenon::python
