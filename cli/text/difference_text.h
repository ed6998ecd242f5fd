// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/asset/comparing/compare_files.h"
#include "tenon/diff/layer_difference.h"
#include "tenon/scene/fields/scene_difference.h"

namespace tenon::cli {

/// One line, "~ /A.size  default 1 -> 2", without a line feed.
std::string difference_text(const diff::Difference& difference);

/// One line, "~ joint /j  upper limit 75 deg -> 60 deg"; angles in degrees.
std::string difference_text(const scene::SceneDifference& difference);

/// The same with the file in front where there is one, or "~ NAME  file changed".
std::string difference_text(const FileDifference& difference);

}  // namespace tenon::cli
