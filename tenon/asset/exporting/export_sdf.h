// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/asset/export_urdf.h"

namespace tenon {

/// A stage's robot as SDFormat (sdf/write_sdf.h), with OBJ files as export_urdf has them. What SDF
/// does not support goes to `diagnostics` as "sdf.left-out", what is written as something else as
/// "sdf.replaced". Errors: those of describe_robot.
Result<ExportedUrdf> export_sdf(const stage::Stage& stage, const std::string& folder,
                                Diagnostics& diagnostics);

}  // namespace tenon
