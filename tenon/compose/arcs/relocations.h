// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/compose/layer_stack.h"

namespace tenon::compose {

/// Reads `relocates` of all layers of `stack` (layer metadata only; those on prims count for
/// nothing since OpenUSD 24.05), drops what is invalid by itself or contradicts another one, with a
/// diagnostic each, and fills the three relocates lists of the stack. Core Spec 1.0.1 section on
/// relocates.
void compose_relocates(LayerStack& stack);

}  // namespace tenon::compose
