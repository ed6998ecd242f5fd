// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>

#include "tenon/base/result.h"
#include "tenon/layer/layer.h"
#include "tenon/stage/stage.h"
#include "tenon/structure/layout.h"

namespace tenon::structure {

/// ErrorCode::NotFound "stage.default-prim-missing".
Error no_default_prim(const layer::Layer& root);

/// What a stage composes to as one layer without arcs: instances unfolded, asset paths absolute
/// where the asset exists, properties of vendor schemas not custom and as uniform as their schemas
/// say. A prim that is switched off is included with its type alone. All is below the default prim:
/// other prims of the root come below it, and paths follow; `moved` gets their old and new places.
/// Errors: ErrorCode::NotFound without a default prim; Limit.
Result<layer::Layer> content_of(const stage::Stage& stage, std::map<Path, Path>* moved = nullptr);

/// Takes out what belongs to engines that are not in `present`, and without Role::Physics what
/// makes things move and collide: typed prims with all below, API schemas, properties; then scopes
/// that are empty through it, and targets of the robot's lists that went.
void keep_roles(layer::Layer& content, RoleSet present);

/// Some API schema or property of the prim has this owner.
bool has_opinion_of(const layer::Layer& content, Path prim, Role owner);

/// Some prim, API schema or property of the content has this owner.
bool has_content_of(const layer::Layer& content, Role owner);

/// What changes `weak` into `strong` when put over it: overs, and definitions of what is new. Prims
/// that `strong` has not are switched off, values blocked.
layer::Layer difference(const layer::Layer& weak, const layer::Layer& strong,
                        std::string identifier);

}  // namespace tenon::structure
