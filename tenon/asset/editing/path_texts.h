// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <vector>

#include "tenon/base/path.h"
#include "tenon/edit/layer_editor.h"

/// Internal to this folder.
namespace tenon {

/// Prims that get other paths.
using PrimMoves = std::map<Path, Path>;

/// Lets texts that are nothing but the path of one of the prims, or of something below it, name its
/// new path instead: strings and tokens in values of attributes, custom data, asset information and
/// custom data of the layer, keys of dictionaries too (maps of names for prims are written so). The
/// specs that changed.
std::vector<Path> follow_in_texts(edit::LayerEditor& editor, const PrimMoves& moves);

}  // namespace tenon
