// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "bench/measure.h"
#include "tenon/stage/stage.h"

/// The steps of opening and reading a stage, each under its own name.
namespace tenon::bench {

/// Phase `open`: file to populated stage.
stage::Stage time_open(Report& report, const std::string& file);

/// Handles of all prims that are active, loaded, defined and not abstract, instance proxies
/// included when asked for.
std::vector<stage::Prim> visited_prims(const stage::Stage& stage, bool instance_proxies);

/// Phase `traverse`: those prims; count `prims`.
std::vector<stage::Prim> time_traverse(Report& report, const stage::Stage& stage,
                                       bool instance_proxies = false);

/// Phase `read_attributes`: the value of every authored attribute at the default time, arrays
/// decoded; counts `attributes` and `values`.
void time_attributes(Report& report, const std::vector<stage::Prim>& prims);

/// Phases `parse`, `compose`, `traverse` and `read_attributes` of a layer without arcs.
void time_one_layer(Report& report, const std::string& file);

}  // namespace tenon::bench
