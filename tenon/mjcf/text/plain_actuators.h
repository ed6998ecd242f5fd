// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

/// Internal to this folder.
namespace tenon::mjcf {

/// MuJoCo's text of a model with its servos as <position> and <velocity>, which read as the same
/// and which every release knows: MuJoCo 4 writes what their controls are as an attribute ("input")
/// that none before it takes.
std::string plain_actuators(std::string_view text);

}  // namespace tenon::mjcf
