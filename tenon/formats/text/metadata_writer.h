// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/layer/layer.h"

namespace tenon::formats::text {

/// Appends ` (` lines `)` with the comment and the metadata of a prim, variant, attribute or
/// relationship; nothing when it has none. False in the last case.
bool append_metadata(std::string& out, const layer::Spec& spec, std::size_t indent);
/// True when `append_metadata` would write something.
bool has_metadata(const layer::Spec& spec);

/// Appends the layer's own block, `(` lines `)`, when there is anything to say.
void append_layer_metadata(std::string& out, const layer::Spec& root);

}  // namespace tenon::formats::text
