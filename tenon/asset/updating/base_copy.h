// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "tenon/base/result.h"
#include "tenon/formats/layer_format.h"
#include "tenon/layer/layer.h"
#include "tenon/structure/package.h"
#include "tenon/structure/written_note.h"

/// The state of an asset when it was made, next to it: with it a later run tells edits from changes
/// of the source. A zip archive with the digests of all files, and each layer in binary form
/// without its long arrays, of which it holds digests.
namespace tenon {

struct BaseCopy {
  structure::Digests digests;  ///< of all files by name; of that which opens the asset its own
  std::map<std::string, layer::Layer> layers;  ///< by name; without notes
  /// Layers that are not as they were made, because edits stayed in conflicts (kept_base.h), each
  /// with the conflicts that are settled (conflict_digest).
  std::map<std::string, std::set<std::uint64_t>> kept;
};

/// What of a copy is unlike what was made.
struct BaseChanges {
  std::map<std::string, layer::Layer> layers;
  std::map<std::string, std::optional<std::uint64_t>> digests;  ///< none: no such file
  std::map<std::string, std::set<std::uint64_t>> kept;          ///< as in BaseCopy
};

/// The bytes of the copy of a package with its layers stored.
Result<std::string> encode_base(const structure::Package& package, BaseChanges changes = {});
/// structure::write_package with the copy among the files, as for every asset that tenon makes.
Result<void> write_with_base(structure::Package package, const std::string& folder,
                             const structure::WriteOptions& options);

/// The copy of `folder`/`opening` at structure::copy_place; nothing where there is none, or one of
/// another asset than that of the file's note (structure/written_note.h). Errors: those of reading
/// one that is there.
Result<std::optional<BaseCopy>> read_base(const std::string& folder, const std::string& opening);

/// A layer of a copy as a reader of a text or of a binary file has it. Arrays that the copy has
/// digests of come from one of the two layers; where neither has them the digests stay.
Result<layer::Layer> restored(layer::Layer base, const layer::Layer& edited,
                              const layer::Layer& source, formats::LayerFormat format);

}  // namespace tenon
