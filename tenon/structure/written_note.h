// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tenon/base/result.h"
#include "tenon/formats/layer_format.h"
#include "tenon/layer/layer.h"

/// What a made asset says about its own files: in the layer that opens it, in customLayerData,
///
///     dictionary tenon = {
///         dictionary written = {
///             string "hand.usda" = "0123456789abcdef"
///             string "payloads/base.usda" = "fedcba9876543210"
///         }
///     }
///
/// are digests of all of its files, its own among them. Making it again compares them: what differs
/// was edited since, and is not overwritten unasked. Binary layers hold their own digest as the
/// second of two numbers instead, `int64[] self`. Descriptions in XML have a comment (xml_note.h).
namespace tenon::structure {

/// Digests by name, relative to the folder of the layer that holds them.
using Digests = std::map<std::string, std::uint64_t>;

/// Gives `layer` the note, without its own digest yet: `seal` puts that into its bytes.
/// `own` is the name of its file.
void add_note(layer::Layer& layer, const std::string& own, const Digests& others,
              formats::LayerFormat format);
/// Takes the note out.
void remove_note(layer::Layer& layer);

/// Puts the digest of the bytes of a layer with a note in its place in them. Not for packages,
/// which hold checksums over it: they are made twice, with `own_digest` of the first in the second.
void seal(std::string& contents, const std::string& own);
/// The digest of a file's contents without the place of its own digest.
std::uint64_t own_digest(std::string_view contents, const std::string& own);
/// The digest of its own that a file's note has; nothing for a file without a note. Packages aside.
std::optional<std::uint64_t> noted_own_digest(std::string_view contents, const std::string& own);
/// What the note of the layer that opens an asset says of the other files.
Digests noted_digests(const layer::Layer& layer, const std::string& own);
/// Takes the note of `from` over, as it is there; without one there is none.
void copy_note(const layer::Layer& from, layer::Layer& layer);
/// The same in a layer of a package.
void set_own_digest(layer::Layer& layer, std::uint64_t digest);

/// The text of a description with its note, sealed.
std::string noted_description(std::string text, const Digests& others);

/// How the files of an asset are beside what was written.
struct WrittenState {
  bool noted = false;                ///< there is a note
  std::vector<std::string> written;  ///< names of files that are as they were written
  std::vector<std::string> edited;   ///< names of those that differ, or are gone
};
/// Of the asset that `file` opens; nothing for other files, or without a note.
WrittenState written_state(const std::string& file);

/// The copy that tells edits of the asset that `opening` opens from the written state, in the
/// asset's folder; and whether a file in that folder is such a copy. No note lists copies.
std::string copy_place(const std::string& opening);
bool is_copy_place(std::string_view name);

/// Error with rule "output.edited" that names what was edited since; nothing when `file` does not
/// exist or is as it was written. For files that say nothing about themselves, too.
/// `beside` are what is to be written with it, named from its folder: for one of them that is there
/// with other contents, and was not written with `file`, an Error with rule "output.unknown".
Result<void> check_not_edited(const std::string& file, const Digests& beside = {});

}  // namespace tenon::structure
