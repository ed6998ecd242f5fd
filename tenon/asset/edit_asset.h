// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/base/path.h"
#include "tenon/base/result.h"
#include "tenon/tenon.h"

/// Edits of assets in files: each lands in the file that owns what it changes.
namespace tenon {

/// One edit of something of the composed scene.
struct AssetEdit {
  enum class Kind : unsigned char { SetProperty, ClearProperty, ApplyApi, RemoveApi };

  Kind kind = Kind::SetProperty;
  Path object;        ///< a property; for API schemas a prim
  std::string value;  ///< of an attribute as text layers print it, quotes and @ may be left out,
                      ///< "None" blocks; of a relationship: paths, all that it has then
  Token api;          ///< "PhysicsMassAPI", "PhysicsDriveAPI:angular"
  Token type_name;    ///< of an attribute that no schema and no layer knows: makes it

  bool is_about_api() const { return kind == Kind::ApplyApi || kind == Kind::RemoveApi; }
};

struct EditOptions {
  OpenOptions open;    ///< with a physics_variant the edit has to count there
  std::string layer;   ///< this file alone, by its path or the end of it
  std::string engine;  ///< "physx", "mujoco", "newton" or another variant: its file
};

/// Where an edit went.
struct EditedPlace {
  std::size_t edit = 0;  ///< index into the edits
  std::string file;
  std::uint32_t line = 0;  ///< in the new text; 0 for binary layers
  Path spec;               ///< in that layer
  std::string why;         ///< this file and no other
  std::string before;      ///< composed value, as text; empty when there was none
  std::string after;
  std::vector<std::string> variants;  ///< of "Physics" in which it counts; empty: no such set
};

struct EditedFile {
  std::string path;
  std::string before;  ///< empty for binary layers
  std::string after;   ///< text, or the bytes of a binary layer
  bool text = false;
  bool kept_layout = true;  ///< comments and layout of text stay
};

struct EditedAsset {
  std::vector<EditedPlace> places;  ///< one for each edit; none for schemas applied already
  std::vector<EditedFile> files;    ///< that differ, sorted by path
};

/// What the edits make of the asset's files. No file is touched: `write_files` does that.
///
/// In an asset of the structure 3.0 (tenon/structure/layout.h) an edit goes to the file that owns
/// the property or API schema; what instances share to the file of the instances; with
/// `options.engine` to that engine's file. Elsewhere to the strongest layer with an opinion, else
/// to the root layer. Each edit is proved: the scene is composed again, and where the value is not
/// what was asked for, nothing comes of it. Errors: ErrorCode::NotFound (prim, property, file),
/// Invalid (types, values, an opinion elsewhere is stronger), Unsupported (files in packages).
/// Diagnostics: "edit.hidden-in-variant", "edit.has-samples".
Result<EditedAsset> edit_asset(const std::string& path, const std::vector<AssetEdit>& edits,
                               const EditOptions& options, Diagnostics& diagnostics);

/// Writes all files in one step, also when the process is killed (bytes/write/file_transaction.h).
Result<void> write_files(const std::vector<EditedFile>& files);

}  // namespace tenon
