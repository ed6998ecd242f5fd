// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "batch.h"
#include <nanobind/nanobind.h>

namespace tenon::python {

/// States, contacts, sensors and models of environments.
void bind_outputs(nanobind::class_<Batch>& batch);

}  // namespace tenon::python
