// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nanobind/nanobind.h>

namespace tenon::python {

/// report.
void bind_page_functions(nanobind::module_& module);

}  // namespace tenon::python
