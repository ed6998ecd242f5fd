// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <vector>

#include "tenon/base/result.h"
#include "tenon/layer/layer.h"

namespace tenon::structure {

/// Wrappers of the meshes of a content, in its order. A wrapper that is switched off has no mesh
/// and is none.
std::vector<Path> wrapped_meshes(const layer::Layer& content);

/// Gives the meshes their own copies of the materials that are bound to them, in a scope of that
/// name below the wrapper: what instances share can name nothing outside of itself.
/// Errors: Limit "structure.materials" where that would be more than kMaterialCopies prims.
Result<void> localize_materials(layer::Layer& content, std::string_view scope);

}  // namespace tenon::structure
