// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "tenon/asset/export_mjcf.h"

namespace tenon {

/// The MJCF model that an asset was converted from (convert/source/record.h), with later edits
/// where the model has an attribute for them ("mjcf.patched"), and with its files in the folders
/// "<stem>_images" and "<stem>_meshes". None, and a finding where there was one, when something
/// else was changed since, or when a file is missing.
std::optional<ExportedMjcf> kept_mjcf(const stage::Stage& stage, const scene::PhysicsScene& scene,
                                      const std::string& stem, const bytes::ReadPolicy& policy,
                                      Diagnostics& diagnostics);

}  // namespace tenon
