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
/// True when it would write something for this field of a spec of that kind.
bool is_metadata(const layer::Field& field, layer::SpecKind kind);

/// The statements of one field in parentheses, each on lines of its own, `indent` steps in; those
/// of a layer stand one step in. Empty for fields that are written elsewhere. The comment of a spec
/// is the field "comment"; subLayerOffsets belong to subLayers.
std::string metadata_field_text(const layer::Spec& spec, Token field);
/// True for fields that go into the parentheses of a spec.
bool stands_in_parentheses(Token field, layer::SpecKind kind);

/// Appends the layer's own block, `(` lines `)`, when there is anything to say.
void append_layer_metadata(std::string& out, const layer::Spec& root);

}  // namespace tenon::formats::text
