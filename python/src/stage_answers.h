// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "opened_stage.h"
#include <nanobind/nanobind.h>

namespace tenon::python {

/// Queries of a stage: explain, where, masses, physics.
void bind_stage_answers(nanobind::class_<OpenedStage>& stage);

}  // namespace tenon::python
