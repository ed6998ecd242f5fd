// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/layer/layer.h"
#include "tenon/stage/stage.h"

namespace tenon::stage {

/// The whole stage as one layer without composition arcs: prims with their composed metadata and
/// properties, defaults and samples in stage time, asset paths as they resolve. Prototypes become
/// prims `/Flattened_Prototype_N` that their instances reference.
layer::Layer flatten(const Stage& stage);

/// The session layer, the root layer and their sublayers as one layer; references and other arcs
/// stay. Fields that no schema knows are skipped.
layer::Layer flatten_layer_stack(const Stage& stage);

}  // namespace tenon::stage
