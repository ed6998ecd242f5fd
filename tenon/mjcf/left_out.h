// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/mjcf/mjcf_source.h"

/// Internal to this folder.
namespace tenon::mjcf {

/// Lists what a RobotModel does not support, by kind and number, with its lines.
void report_left_out(MjcfSource& source);

}  // namespace tenon::mjcf
