// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "prim_of.h"
#include <nanobind/nanobind.h>

namespace tenon::python {

/// Makes edits, or lets them wait in a block: where they went, as Python has it. Raises what they
/// fail with; a relationship among them that leads nowhere is a warning.
nanobind::list edited(OpenedStage& stage, const std::vector<AssetEdit>& edits,
                      bool of_targets = false);
/// A value of Python as text layers write it, by a function of tenon_usd.text.
std::string as_text(const char* function, const nanobind::object& value);
/// Raises InvalidError for a type that a prim cannot have, with the one that was meant.
void check_type(const std::string& type, Path prim);

void bind_prim_edits(nanobind::class_<PrimOf>& prim);
/// Arcs, variants, metadata, order.
void bind_prim_authoring(nanobind::class_<PrimOf>& prim);
/// Variants to author in, and the requests of the command.
void bind_stage_authoring(nanobind::module_& module, nanobind::class_<OpenedStage>& stage);
void bind_stage_edits(nanobind::module_& module, nanobind::class_<OpenedStage>& stage);

}  // namespace tenon::python
