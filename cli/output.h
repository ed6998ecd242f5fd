// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/print.h"
#include "cli/report.h"
#include "tenon/asset/edited_file.h"
#include "tenon/asset/made_file.h"
#include "tenon/asset/undoing/undo_edit.h"
#include "tenon/base/result.h"
#include "tenon/bytes/zip/zip_archive.h"
#include "tenon/formats/open_layer.h"
#include "tenon/structure/package.h"

/// All output of the command goes through here, files and standard output alike; no other file of
/// cli/ writes (tools/check_outputs.py, a test).
namespace tenon::cli {

/// What an output is. Which endings its name may have is a table in output.cpp.
enum class OutputKind : std::uint8_t {
  Layer,        ///< any layer, packages included
  NamedFormat,  ///< the same, in a format that was asked for by its own name
  Overlay,      ///< a layer over another one, which a package would be without
  Package,      ///< .usdz
  Log,          ///< what a simulation did
  NamedLog,     ///< the same, in a format that was asked for by its own name
  State,        ///< of a simulation, to go on from
  Description,  ///< of a robot, for other programs
  Pairs,        ///< of links that do not collide, for other programs
  Poses,        ///< of a robot by name, for other programs
  Dump,         ///< of a stage
  Sarif,
  Baseline,
  Comparison,  ///< of motions
  Motion,      ///< of bodies: a layer over an asset, or a scene for other programs
  Page,        ///< that browsers show
  Picture,     ///< .png
  Recording,   ///< a picture or a film
};

/// Which verb edits which asset: what it replaces is kept for tenon undo.
struct EditOf {
  std::string verb;
  std::string asset;
};

/// The files of one run. They are claimed before the work, so that nobody waits for what cannot be
/// written, then filled, then written all together or not at all.
class Outputs {
 public:
  Outputs() = default;
  /// In place: over files that the run has read, as long as they are still what was read.
  static Outputs in_place(EditOf edit) {
    Outputs outputs;
    outputs.in_place_ = true;
    outputs.edit_ = std::move(edit);
    return outputs;
  }

  /// Looks at the name alone and at the place that it names. "-" is standard output, "" nothing.
  /// Errors: ErrorCode::Invalid (rules "output.kind", "output.twice"), Io ("file.unwritable").
  Result<void> claim(OutputKind kind, const std::string& path);
  /// A file, or standard output for "-".
  void put(const std::string& path, std::string contents);
  /// A file of an output of several, in folders that are made for it.
  void put_beside(const std::string& path, std::string contents);
  /// Files that were made of an asset, in folders that are made for them.
  void put_all(MadeFiles files);
  /// Asked once nobody else can write, right before anything is written.
  void check_before_commit(std::function<Result<void>()> check) { check_ = std::move(check); }
  /// Writes what was put. Errors: those of bytes::FileTransaction; ErrorCode::Invalid for contents
  /// that are of another format than their name says.
  Result<void> commit() const;

 private:
  std::vector<std::string> claimed_;
  std::vector<std::pair<std::string, std::string>> files_;
  std::function<Result<void>()> check_;
  bool in_place_ = false;
  EditOf edit_;
  bool make_folders_ = false;
};

/// The ending says which format a layer has; .usd may be text or binary.
Result<void> check_layer_name(const std::string& path, formats::LayerFormat format);

/// What other parts make into files, behind the same guards: an asset as a folder, edits of an
/// asset's files, a package unpacked.
Result<void> write_asset(const structure::Package& package, const std::string& folder,
                         structure::WriteOptions options, const std::string& verb);
Result<void> write_edits(const std::vector<EditedFile>& files, const EditOf& edit);
/// Writes the files as they were before the edit, which is forgotten then.
Result<void> write_undone(const UndoneEdit& edit);
Result<void> unpack(const bytes::ZipArchive& archive, const std::string& folder);

/// To be called before anything else: a closed standard stream stays closed, whatever files are
/// opened; a closed pipe and a file that may not grow are errors, not signals; files that are read
/// are noted.
void begin_output();
/// To be called last: whether standard output took all that was printed. `code`, or that of a
/// failure, with a message; nothing is said to a reader that has closed its end of a pipe.
int finish_output(int code);

}  // namespace tenon::cli
