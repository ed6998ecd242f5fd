// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/base/diagnostics.h"
#include "tenon/open_stage.h"

namespace tenon {

/// The finding says that something that the input names was missing, could not be read, or was
/// skipped at a limit, so that the answer is about less than was requested.
bool tells_of_missing_input(const Diagnostic& finding);

/// For verbs that work on layers without composing them: adds what composing finds missing.
void add_missing_input(const std::string& asset, const OpenOptions& options,
                       Diagnostics& diagnostics);

}  // namespace tenon
