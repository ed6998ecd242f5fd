// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/scene/physics_scene.h"

/// How logs and commands name what a joint has several of.
namespace tenon::bake {

/// Behind the name of a joint's number: "" of the only one of `count`, ".K" of one of several.
std::string part_label(std::size_t k, std::size_t count);

/// Of drive `k` of a joint: "" of the only one, its axis (".rotX") where no other drive has it,
/// else ".K".
std::string drive_label(const scene::Joint& joint, std::size_t k);

}  // namespace tenon::bake
