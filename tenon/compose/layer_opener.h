// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/base/function.h"
#include "tenon/base/result.h"
#include "tenon/layer/layer.h"

namespace tenon::compose {

/// How composition gets at other layers: opens the layer that `asset_path`, authored in `anchor`,
/// means. Must return the same pointer for the same identifier. Knows files so that compose does
/// not have to.
using LayerOpener =
    Function<Result<layer::LayerPtr>(const std::string& asset_path, const layer::Layer& anchor)>;

}  // namespace tenon::compose
