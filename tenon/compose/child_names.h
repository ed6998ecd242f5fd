// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace tenon::compose {

struct PrimIndex;

/// From the opinions of an index, which is finished otherwise: the names of its children.
void compose_child_names(PrimIndex& index);
/// The same for its properties; again when one of the specs lists others than before.
void compose_property_names(PrimIndex& index);

}  // namespace tenon::compose
