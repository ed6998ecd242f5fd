// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "tenon/convert/layer_builder.h"
#include "tenon/robot/robot_model.h"

/// Internal to this folder.
namespace tenon::convert {

/// The name of a module of NVIDIA's Material Definition Language.
inline bool names_mdl(std::string_view file) { return file.ends_with(".mdl"); }

/// Writes the shader of a material whose `texture` is a module: the material of the module that has
/// the module's own name, tinted with the colour where there is one.
void write_mdl(LayerBuilder& builder, Path material, const robot::Material& look);

}  // namespace tenon::convert
