// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nanobind/nanobind.h>

namespace tenon::python {

/// The multibody algebra of scenes (tenon/dynamics), for tenon_usd/dynamics.py.
void bind_dynamics(nanobind::module_& module);

}  // namespace tenon::python
