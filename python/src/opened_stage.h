// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include <nanobind/nanobind.h>

#include "tenon/asset/edit_asset.h"
#include "tenon/base/diagnostics.h"
#include "tenon/open_stage.h"
#include "tenon/physics/readings.h"
#include "tenon/stage/stage.h"

namespace tenon::python {

/// A composed asset as Python holds it: the scene, how it was opened, and the edits that are not
/// saved yet. Prims of Python name it and a path, so that they are never older than an edit.
class OpenedStage {
 public:
  /// Errors: those of tenon::open and set_reading.
  static std::shared_ptr<OpenedStage> open(std::string path, OpenOptions options,
                                           const physics::Readings& readings);

  /// The composed scene, with all edits, while one thread looks at it. Again from the same thread
  /// it is the same.
  class Access {
   public:
    explicit Access(OpenedStage& owner);
    const stage::Stage& operator*() const { return *stage_; }
    const stage::Stage* operator->() const { return stage_.get(); }

   private:
    std::unique_lock<std::recursive_mutex> lock_;
    std::shared_ptr<const stage::Stage> stage_;
  };
  Access access() { return Access(*this); }

  // Under an Access, with or without the interpreter.

  /// Edits in memory, all or none. Errors: those of AssetEditor.
  Result<std::vector<EditedPlace>> edit(const std::vector<AssetEdit>& edits,
                                        Diagnostics& diagnostics);
  /// False where there is nothing to take back, or to do again.
  Result<bool> undo();
  Result<bool> redo();
  /// What edits make of the files, and the same written. Errors: those of write_files.
  Result<std::vector<EditedFile>> edited_files() const;
  Result<std::vector<EditedFile>> save();
  /// How the scene with all edits is opened again: edited files are in memory over those on disk.
  /// Errors: those of edited_files.
  Result<OpenOptions> options_as_edited() const;

  const std::string& path() const { return path_; }
  const OpenOptions& options() const { return options_; }
  const physics::Readings& readings() const { return readings_; }
  const Diagnostics& diagnostics() const { return diagnostics_; }

 private:
  Result<AssetEditor*> editor();
  Result<void> look_again();

  std::string path_;
  OpenOptions options_;
  physics::Readings readings_;
  Diagnostics diagnostics_;
  std::recursive_mutex mutex_;
  std::shared_ptr<const stage::Stage> stage_;
  std::optional<AssetEditor> editor_;
};

void bind_stage(nanobind::module_& module);

}  // namespace tenon::python
