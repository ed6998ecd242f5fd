// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tenon/asset/edited_file.h"
#include "tenon/base/diagnostics.h"
#include "tenon/base/path.h"
#include "tenon/base/result.h"
#include "tenon/diff/merge/merge_layers.h"
#include "tenon/structure/package.h"

/// An asset that was edited, converted again from its source.
namespace tenon {

/// What an edit and the source changed, each in another way; of a file that is no layer, or that
/// one of them removed, without a path.
struct UpdateConflict {
  std::string file;  ///< name in the asset's folder
  diff::MergeConflict what;
};

struct UpdatedAsset {
  std::vector<EditedFile> files;  ///< that differ, for write_files
  std::vector<UpdateConflict> conflicts;
  std::map<Path, Path> moved;  ///< prims that the source has elsewhere; their edits went along
  std::size_t edits = 0;       ///< fields, specs and files that stay as edits made them
  std::size_t changes = 0;     ///< those that become what the source says now
};

/// What becomes of conflicts.
struct UpdateChoice {
  diff::Side keep = diff::Side::Edits;
  /// With edits kept: for good, so that later updates do not tell these conflicts again.
  bool settles = false;
};

/// The asset in `folder`, whose files are read, with the differences between the conversion that
/// made it and `made`, the new one with its layers stored. Edits stay: their base is the copy of
/// the former output (base_copy.h), or the asset itself where its note says that it is unedited.
/// Where both changed the same thing, `choice` decides, and a finding of the rule "update.conflict"
/// names it in each run until the conflict is resolved or settled. Where the source is unchanged
/// nothing differs, and no file is in the answer. No file is touched. Errors: NotFound
/// "update.nothing" where there is no such asset; Invalid "update.no-base" where it was edited and
/// its former state is unknown; those of reading.
Result<UpdatedAsset> update_asset(const structure::Package& made, const std::string& folder,
                                  const UpdateChoice& choice, Diagnostics& diagnostics);

/// update_asset for what `made.interface` opens in `folder`; nothing where there is no such file,
/// so that `made` must be written as it is.
Result<std::optional<UpdatedAsset>> update_folder(const structure::Package& made,
                                                  const std::string& folder,
                                                  const UpdateChoice& choice,
                                                  Diagnostics& diagnostics);

}  // namespace tenon
