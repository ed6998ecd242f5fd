// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "batch.h"
#include <nanobind/nanobind.h>

namespace tenon::python {

/// Single numbers of environments, read now or again and again while they step.
void bind_record(nanobind::class_<Batch>& batch);

}  // namespace tenon::python
