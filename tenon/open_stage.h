// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/bytes/files.h"
#include "tenon/layer/layer.h"
#include "tenon/stage/stage.h"

/// Files opened and composed: the only place that wires files and composition together.
namespace tenon {

struct OpenOptions {
  /// Variant of the default prim's variant set "Physics", selected in the session layer.
  std::string physics_variant{};
  /// The same variant of every other prim that has the set, such as robots that a scene references,
  /// as far as it has the variant.
  bool physics_below = false;
  /// "PRIM=VARIANT": variants of "Physics" of these prims, which count before the two above.
  std::vector<std::string> physics_of{};
  /// Any variant of any set, selected in the session layer as well.
  struct Selection {
    std::string prim;
    std::string set;
    std::string variant;
  };
  std::vector<Selection> selections{};
  /// "PATH.attr=value" in text form of the attribute's type: opinions in the session layer.
  std::vector<std::string> overrides{};
  /// Source of every file that the asset and its layers name: the disk, memory, unsaved text over
  /// either. Search paths, sandbox and session layer are looked up there as well.
  bytes::Files files{};
  /// A session layer file; the two options above are written over its opinions, in memory.
  std::string session_path{};
  bool load_payloads = true;
  /// Prim paths; when not empty, only the payloads of these prims, their ancestors and their
  /// descendants are loaded.
  std::vector<std::string> load{};
  std::vector<std::string> mask{};  ///< prim paths; empty: everything
  /// Layers that count as absent, the root layer cannot: files, relative to the working directory
  /// or to the asset, or asset paths as layers name them.
  std::vector<std::string> muted{};
  std::map<std::string, std::vector<std::string>> variant_fallbacks{};
  /// When not empty, no file outside these folders is opened.
  std::vector<std::string> sandbox_roots{};
  /// Folders that asset paths without "./" are looked up in, after the layer's own folder, the
  /// working directory and the folder of the asset.
  std::vector<std::string> search_paths{};
  /// Folders and files that may go into outputs, beside those that belong to the asset; with
  /// `sandbox_roots` they may be opened, too (tenon/asset_policy.h).
  std::vector<std::string> allowed_reads{};
  /// Units of work that composition may take; 0: limits::kComposeWork and more for larger layers.
  std::size_t max_work = 0;
  /// Opinions of layers whose metersPerUnit or kilogramsPerUnit are not those of the stage are
  /// converted to them (S-11, physics/layer_units.h).
  bool layer_units = false;
};

/// Opens one layer file of any kind on the disk, without composing it.
Result<layer::LayerPtr> open_layer(const std::string& path, Diagnostics& diagnostics);

/// The same from the options' files, under their sandbox and search paths.
Result<layer::LayerPtr> open_layer(const std::string& path, const OpenOptions& options,
                                   Diagnostics& diagnostics);

/// A package (.usdz) of a layer with all files that it needs (formats/package/pack.h); `path` names
/// the asset that it comes from and that its asset paths are relative to.
Result<std::string> pack_layer(layer::Layer layer, const std::string& path,
                               const OpenOptions& options, Diagnostics& diagnostics);

/// Opens a file and composes it. Recoverable findings, composition errors included, are in the
/// stage's `diagnostics()`.
Result<stage::Stage> open(const std::string& path, const OpenOptions& options = {});

/// The same for callers that collect the findings of several steps: they go to `diagnostics`.
Result<stage::Stage> open(const std::string& path, const OpenOptions& options,
                          Diagnostics& diagnostics);

}  // namespace tenon
