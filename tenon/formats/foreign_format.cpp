// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Formats are told by their contents, as names of files mislead: XML by its root element, meshes
// by the bytes at their beginning. Text without such a sign is OBJ where its first lines are
// statements of that format.
#include "tenon/formats/foreign_format.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <utility>

#include "tenon/base/text/shell_word.h"

namespace tenon::formats {
namespace {

/// Behind the first `end` from `at` on; the size of `text` where there is none.
std::size_t behind(std::string_view text, std::string_view end, std::size_t at) {
  const std::size_t found = text.find(end, at);
  return found == std::string_view::npos ? text.size() : found + end.size();
}

/// Behind a document type, whose own declarations are in brackets.
std::size_t behind_document_type(std::string_view text, std::size_t at) {
  const std::size_t open = text.find_first_of("[>", at);
  const bool has_declarations = open != std::string_view::npos && text[open] == '[';
  return behind(text, ">", has_declarations ? behind(text, "]", open) : at);
}

ForeignFormat xml_format(std::string_view text) {
  const std::string_view root = xml_root_element(text);
  if (root == "robot") {
    const bool macros = text.find("<xacro:") != std::string_view::npos;
    return macros ? ForeignFormat::Xacro : ForeignFormat::Urdf;
  }
  return root == "mujoco" || root == "mujocoinclude" ? ForeignFormat::Mjcf
         : root == "sdf"                             ? ForeignFormat::Sdf
         : root == "COLLADA"                         ? ForeignFormat::Collada
                                                     : ForeignFormat::None;
}

/// 80 bytes of anything, the number of triangles, and 50 bytes for each.
bool is_binary_stl(std::string_view contents) {
  constexpr std::size_t kHead = 84;
  if (contents.size() < kHead) {
    return false;
  }
  std::uint32_t triangles = 0;
  std::memcpy(&triangles, contents.data() + 80, sizeof triangles);
  return contents.size() == kHead + std::size_t{50} * triangles;
}

/// "solid NAME", and then facets.
bool is_text_stl(std::string_view text) {
  constexpr std::size_t kSearched = 4096;
  return text.starts_with("solid") &&
         text.substr(0, kSearched).find("facet") != std::string_view::npos;
}

/// Statements of geometry alone, with comments, groups and materials between.
bool is_obj(std::string_view text) {
  constexpr std::size_t kLines = 100;
  bool has_vertex = false;
  for (std::size_t line_number = 0; line_number < kLines && !text.empty(); ++line_number) {
    std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    line.remove_prefix(std::min(line.find_first_not_of(" \t\r"), line.size()));
    const std::string_view word = line.substr(0, line.find_first_of(" \t\r"));
    if (word.empty() || word.front() == '#') {
      continue;
    }
    constexpr std::string_view kWords[] = {"v", "vt", "vn", "vp", "f",      "l",
                                           "p", "g",  "o",  "s",  "mtllib", "usemtl"};
    if (std::find(std::begin(kWords), std::end(kWords), word) == std::end(kWords)) {
      return false;
    }
    has_vertex = has_vertex || word == "v";
  }
  return has_vertex;
}

bool is_json_gltf(std::string_view text) {
  constexpr std::size_t kSearched = 1u << 16u;
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  const std::string_view head = text.substr(0, kSearched);
  return first != std::string_view::npos && text[first] == '{' &&
         head.find("\"asset\"") != std::string_view::npos &&
         head.find("\"version\"") != std::string_view::npos;
}

}  // namespace

std::string_view xml_root_element(std::string_view text) {
  std::size_t at = text.starts_with("\xEF\xBB\xBF") ? 3 : 0;
  for (;;) {
    at = std::min(text.find_first_not_of(" \t\r\n", at), text.size());
    const std::string_view rest = text.substr(at);
    if (rest.starts_with("<!--")) {
      at = behind(text, "-->", at + 4);
    } else if (rest.starts_with("<?")) {
      at = behind(text, "?>", at);
    } else if (rest.starts_with("<!")) {
      at = behind_document_type(text, at);
    } else {
      return rest.starts_with('<') ? rest.substr(1, rest.find_first_of(" \t\r\n/>") - 1)
                                   : std::string_view();
    }
  }
}

ForeignFormat foreign_format(std::string_view contents) {
  if (contents.starts_with("#usda") || contents.starts_with("PXR-USDC")) {
    return ForeignFormat::None;
  }
  if (const ForeignFormat xml = xml_format(contents); xml != ForeignFormat::None) {
    return xml;
  }
  return contents.starts_with("glTF") || is_json_gltf(contents)           ? ForeignFormat::Gltf
         : contents.starts_with("ply\n") || contents.starts_with("ply\r") ? ForeignFormat::Ply
         : is_text_stl(contents) || is_binary_stl(contents)               ? ForeignFormat::Stl
         : is_obj(contents)                                               ? ForeignFormat::Obj
                                                                          : ForeignFormat::None;
}

std::string_view foreign_format_name(ForeignFormat format) {
  switch (format) {
    case ForeignFormat::None:
      break;
    case ForeignFormat::Urdf:
      return "a URDF";
    case ForeignFormat::Xacro:
      return "a URDF with macros of xacro";
    case ForeignFormat::Mjcf:
      return "an MJCF model";
    case ForeignFormat::Sdf:
      return "an SDF model";
    case ForeignFormat::Collada:
      return "a Collada mesh";
    case ForeignFormat::Obj:
      return "an OBJ mesh";
    case ForeignFormat::Stl:
      return "an STL mesh";
    case ForeignFormat::Gltf:
      return "a glTF mesh";
    case ForeignFormat::Ply:
      return "a PLY mesh";
  }
  return {};
}

std::string foreign_format_advice(ForeignFormat format, const std::string& name) {
  switch (format) {
    case ForeignFormat::None:
      return {};
    case ForeignFormat::Urdf:
    case ForeignFormat::Xacro:
    case ForeignFormat::Sdf:
    case ForeignFormat::Mjcf:
      return "run `tenon convert " + shell_word(name) + " out/`";
    case ForeignFormat::Obj:
    case ForeignFormat::Stl:
    case ForeignFormat::Gltf:
    case ForeignFormat::Ply:
      return "run `tenon new scene.usda`, then `tenon add scene.usda /World/part=mesh --file " +
             shell_word(name) + "`";
    case ForeignFormat::Collada:
      return "name it as the <mesh filename=\"" + name +
             "\"/> of a link in a URDF, and run `tenon "
             "convert` on that";
  }
  return {};
}

}  // namespace tenon::formats
