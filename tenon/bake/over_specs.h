// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/base/path.h"
#include "tenon/base/token.h"
#include "tenon/layer/layer.h"

/// Specs that only override: for layers laid over an asset.
namespace tenon::bake {

/// The `over` at an absolute prim path, made with all its ancestors where absent.
layer::Spec& over_prim(layer::Layer& layer, Path prim);

/// An attribute of such a prim.
layer::Spec& over_attribute(layer::Layer& layer, Path prim, Token name, Token type_name);

}  // namespace tenon::bake
