// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

/// Which files the libraries in this process may open. It holds them to the folders where the
/// kernel cannot, and knows the name of what was refused, which their messages often lack.
namespace tenon::worker {

/// From now on only regular files below `roots` are opened, to be read.
void hold_to(const std::vector<std::string>& roots);

/// What was refused since this was asked last, each name once.
std::vector<std::string> take_refused();
/// The same of what was opened, without symbolic links.
std::vector<std::string> take_opened();

}  // namespace tenon::worker
