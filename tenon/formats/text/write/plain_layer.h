// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/layer/layer.h"

namespace tenon::formats::text {

/// True where all fields of the layer are of forms that surely have a text which can be read back:
/// known type names with values of their type, registered metadata, names and targets met once.
/// False says nothing; layers with arcs, variants or fields that no schema knows are such.
bool has_plain_text(const layer::Layer& layer);

}  // namespace tenon::formats::text
