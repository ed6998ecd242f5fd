// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/bytes/files.h"

namespace tenon::formats {

/// Gives findings the place of the part that they are about, with its end. Each text layer they
/// name is looked into again, so layers in which nothing is wrong pay nothing. A place is told only
/// where the text says what the finding is about: in a file that was changed or removed since, or
/// that is no file, findings keep the place of their prim or property. `files` are those that the
/// layers were read from.
void find_places(const std::vector<Diagnostic*>& findings, const bytes::Files& files);
void find_places(Diagnostics& findings, const bytes::Files& files);

}  // namespace tenon::formats
