// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nanobind/nanobind.h>

namespace tenon::python {

/// Which colliders overlap in postures of a scene, for tenon_usd/identify/moving.py.
void bind_overlaps(nanobind::module_& module);

}  // namespace tenon::python
