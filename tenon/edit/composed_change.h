// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tenon/edit/layer_change.h"
#include "tenon/stage/edited/spec_follower.h"

/// What a change of a layer means for scenes that are composed of it. Internal to this folder.
namespace tenon::edit {

/// Prims may be composed of other specs after it.
bool changes_composition(const LayerChange& change);

/// Appends what a scene of `layer`, in which the change is made, has to take over. False, with some
/// of it appended, where that takes another scene: specs of prims went, or changed in more than
/// properties, type, applied schemas and new children, or new ones have arcs, variants and the
/// like.
bool add_news(const LayerChange& change, const layer::Layer& layer,
              std::vector<stage::SpecNews>& news);

}  // namespace tenon::edit
