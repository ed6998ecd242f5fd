// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/base/error.h"
#include "tenon/base/path.h"

/// Why an edit is refused, each with what to do instead.
namespace tenon::edit {

Error unknown_layer(const std::string& identifier);
Error no_prim(Path prim);
Error bad_path(Path path, const std::string& wanted);
Error bad_variant(const std::string& set, const std::string& variant);
Error instance_proxy(Path prim);
Error outside_target(Path path, const std::string& layer);
/// Of a target or connection.
Error no_name_in_target(Path path, const std::string& layer);
Error no_property(Path property, const std::string& what);
Error wrong_kind(Path property, const std::string& there);
/// `wanted` and `given` are names of types.
Error type_mismatch(Path object, const std::string& what, const std::string& wanted,
                    const std::string& given);

}  // namespace tenon::edit
