// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace tenon::bytes {

/// A mesh, a height field or a skin in one of the forms that MuJoCo reads: STL, OBJ, and its own
/// three, which have no mark and are detected by counts that give the size of the whole to the
/// byte.
bool is_shape_file(std::string_view bytes);

}  // namespace tenon::bytes
