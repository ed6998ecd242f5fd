// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <string_view>

/// Internal to this folder.
namespace tenon::mjcf {

/// What a prim is called in a description: its display name or its own.
using NameOf = std::function<std::string(std::string_view prim)>;

/// MuJoCo's text of a model whose things are named by paths, as descriptions have it: each thing
/// has the name of its prim, numbered where several of a kind have the same; numbers are those of
/// the asset (base/text/source_number.h); lists of solver parameters are whole, as some readers
/// count them.
std::string finished_text(const std::string& text, const NameOf& name_of);

}  // namespace tenon::mjcf
