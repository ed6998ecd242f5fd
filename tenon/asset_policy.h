// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/base/diagnostics.h"
#include "tenon/bytes/read_policy.h"
#include "tenon/open_stage.h"
#include "tenon/stage/stage.h"

/// What may go from files into an output that is made of an asset (docs/reading.md).
namespace tenon {

/// The folders of the asset at `path` (bytes/asset_roots.h), the search paths and what the options
/// allow; with a sandbox its folders and what the options allow, alone.
bytes::ReadPolicy policy_for(const std::string& path, const OpenOptions& options);

/// The rule of a finding about a layer from elsewhere that an output has something of.
inline constexpr const char* kOutsideLayerRule = "read.outside-layer";

/// Names the layers of a stage that lie elsewhere. Composition reads layers wherever they are, and
/// what they say goes into a flattened stage; it does not go there unsaid.
void name_outside_layers(const stage::Stage& stage, const bytes::ReadPolicy& policy,
                         Diagnostics& diagnostics);
/// The same for one layer; `asset` is the file that the output is made of.
void name_outside_layer(const std::string& layer, const std::string& asset,
                        const bytes::ReadPolicy& policy, Diagnostics& diagnostics);

/// Whether something that the asset names was kept out of an output: the output lacks it.
bool left_out(const Diagnostics& diagnostics);

}  // namespace tenon
