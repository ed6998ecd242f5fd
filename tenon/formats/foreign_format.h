// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

/// Files of other formats, told by their contents, so that a message can say what to do with one.
namespace tenon::formats {

enum class ForeignFormat : std::uint8_t {
  None,  ///< USD, or nothing that is known
  Urdf,
  Xacro,
  Mjcf,
  Sdf,
  Collada,
  Obj,
  Stl,
  Gltf,
  Ply,
};

ForeignFormat foreign_format(std::string_view contents);

/// "a URDF", "an OBJ mesh"; empty for None.
std::string_view foreign_format_name(ForeignFormat format);
/// What to do with the file `name` to have a USD asset; empty for None.
std::string foreign_format_advice(ForeignFormat format, const std::string& name);

/// Behind comments, processing instructions and the document type: the name of the root element;
/// empty where the text is no XML.
std::string_view xml_root_element(std::string_view text);

}  // namespace tenon::formats
