// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/convert/layer_builder.h"
#include "tenon/robot/robot_model.h"

/// Internal to this folder.
namespace tenon::convert {

/// Writes below `material` how it looks; `linear`: its colour is that of the surface, not as
/// displayed.
void write_preview(LayerBuilder& builder, Path material, const robot::Material& look, bool linear);

}  // namespace tenon::convert
