// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

/// What a robot's description in XML says about its own files (written_note.h): a comment behind
/// its root element, which readers of URDF and MJCF skip,
///
///     <!-- written by tenon; digests of the files as they were
///     0123456789abcdef
///     fedcba9876543210 arm_meshes/mesh_0.obj
///     -->
///
/// of the description itself first, then of the files next to it. Python files that begin with a
/// text in three quotes have the same lines behind "# ".
namespace tenon::structure {

struct XmlNote {
  std::uint64_t own = 0;
  std::size_t own_at = 0;                       ///< where its digits are in the text
  std::map<std::string, std::uint64_t> others;  ///< by name, relative to the folder of the text
};

/// Whether a text is of a kind that has such a note: XML or Python. No layer begins so.
bool holds_xml_note(std::string_view text);

/// `text` with the note behind it. Its own digest is that of the whole with zeros for its digits,
/// which the caller puts in (`seal`).
std::string with_xml_note(std::string text, const std::map<std::string, std::uint64_t>& others);

/// The note of a text; nothing for one that has none, or none that can be read.
std::optional<XmlNote> xml_note_of(std::string_view text);

}  // namespace tenon::structure
