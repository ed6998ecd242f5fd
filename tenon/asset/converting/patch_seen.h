// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/asset/converting/model_text.h"
#include "tenon/asset/converting/patch_model.h"

/// Internal to this folder.
namespace tenon {

/// Writes an edit of a camera or light ("Camera.focalLength", "Light.inputs:color"), which is
/// called `name` in the text and by its path in `seen`. Why it cannot be said; empty: it is.
std::string patch_seen(ModelText& text, const robot::RobotModel& seen, const PropertyEdit& edit,
                       const std::string& name);

}  // namespace tenon
