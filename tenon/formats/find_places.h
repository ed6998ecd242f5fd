// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/formats/source_bytes.h"

namespace tenon::formats {

/// Gives findings the place of the part that they are about, with its end. Each text layer they
/// name is looked into again, so layers in which nothing is wrong pay nothing. A place is told only
/// where the text says what the finding is about: in a file that was changed or removed since, or
/// that is no file, findings keep the place of their prim or property. `open` gives what a layer
/// was read from, or null.
using SourceOpener =
    std::function<std::shared_ptr<const bytes::FileBytes>(const std::string& identifier)>;
void find_places(const std::vector<Diagnostic*>& findings, const SourceOpener& open = source_bytes);
void find_places(Diagnostics& findings, const SourceOpener& open = source_bytes);

}  // namespace tenon::formats
