// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "prim_of.h"
#include <nanobind/nanobind.h>

namespace tenon::python {

void bind_prim_edits(nanobind::class_<PrimOf>& prim);
void bind_stage_edits(nanobind::module_& module, nanobind::class_<OpenedStage>& stage);

}  // namespace tenon::python
