// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "tenon/bake/commands/commands.h"
#include "tenon/bytes/file_bytes.h"

namespace tenon::bake {

/// Reads an archive of numpy.savez: `time` (rows) [s], ascending; `columns` (columns), texts with
/// the names of commands_from_csv; `values` (rows x columns) in the same units, NaN leaves what was
/// there. Numbers may be of any real type of 4 or 8 bytes. Errors (rule sim.commands), which name
/// the array: NotFound, Parse, Limit; Unsupported for compressed archives.
Result<Commands> commands_from_npz(std::shared_ptr<const bytes::FileBytes> file,
                                   const scene::PhysicsScene& scene,
                                   const engines::Simulation& simulation);

}  // namespace tenon::bake
