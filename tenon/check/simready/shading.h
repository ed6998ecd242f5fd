// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tenon/check/simready/requirement.h"

/// Shaders, their inputs and what they are connected with.
namespace tenon::check::simready {

inline constexpr const char* kPreview = "outputs:surface";
inline constexpr const char* kMaterialX = "outputs:mtlx:surface";
inline constexpr const char* kMdl = "outputs:mdl:surface";

bool is_shader(const stage::Prim& prim);
bool is_graph(const stage::Prim& prim);
bool is_mdl_shader(const stage::Prim& shader);

/// Names of the inputs that are authored, without "inputs:".
std::vector<std::string> inputs_of(const stage::Prim& prim);
stage::Attribute input_of(const stage::Prim& shader, const std::string& name);

/// The shader that a terminal leads to, through graphs of nodes; invalid where it leads to none.
stage::Prim terminal_shader(const stage::Prim& material, const char* terminal);

/// All prims of type Material, what instances share included.
std::vector<stage::Prim> materials_in(const Judged& judged);

}  // namespace tenon::check::simready
