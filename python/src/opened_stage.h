// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
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
    /// Of the edits that still wait, none is in the scene.
    struct WithoutWaiting {};
    Access(OpenedStage& owner, WithoutWaiting tag);
    const stage::Stage& operator*() const { return *stage_; }
    const stage::Stage* operator->() const { return stage_.get(); }

   private:
    std::unique_lock<std::recursive_mutex> lock_;
    std::shared_ptr<const stage::Stage> stage_;
  };
  /// Makes the edits that wait first. Raises what they fail with; the caller has the interpreter.
  Access access() { return Access(*this); }
  Access access_without_waiting() { return Access(*this, Access::WithoutWaiting()); }

  // Under an Access, with or without the interpreter.

  /// Edits in memory, all or none; between begin_edits() and end_edits() they wait until somebody
  /// looks at the scene, and no place is known yet. Errors: those of AssetEditor.
  Result<std::vector<EditedPlace>> edit(std::vector<AssetEdit> edits, Diagnostics& diagnostics);
  /// From here on edits are one step of the history, all or none. Blocks may be inside of others,
  /// and are parts of them then.
  void begin_edits();
  /// Where the edits of the outermost block went; none for others. Errors: those of edit(); none of
  /// the block's edits stays then.
  Result<std::vector<EditedPlace>> end_edits(Diagnostics& diagnostics);
  /// The same where the block failed: nothing of all blocks around it stays.
  Result<void> drop_edits();
  bool in_edits() const { return open_blocks_ > 0; }
  /// What has been asked for since begin_edits() and not been made yet.
  const std::vector<AssetEdit>& waiting() const { return waiting_; }
  Result<void> make_waiting(Diagnostics& diagnostics);
  /// Relationships whose targets somebody looks at when the blocks are over.
  void look_later(Path relationship) { to_look_at_.push_back(relationship); }
  std::vector<Path> to_look_at() { return std::exchange(to_look_at_, {}); }
  /// From here on, until come_out(), edits go into this variant.
  void go_inside(VariantPlace place) { inside_.push_back(std::move(place)); }
  void come_out() { inside_.pop_back(); }
  /// The scene under all selections of "Physics", as it is now. Errors: those of AssetEditor.
  Result<std::vector<std::shared_ptr<const stage::Stage>>> views();
  /// Says something about an edit in diagnostics(), after what opening said.
  void tell(const Diagnostic& finding) { diagnostics_.add(finding); }

  /// False where there is nothing to take back, or to do again.
  Result<bool> undo();
  Result<bool> redo();
  /// What edits make of the files, and the same written; `undoable`: what they were is kept for
  /// undo_edit. Errors: those of write_files.
  Result<std::vector<EditedFile>> edited_files() const;
  Result<std::vector<EditedFile>> save(bool undoable);
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
  Result<void> edit_now(const std::vector<AssetEdit>& edits, Diagnostics& diagnostics);
  void close_step(std::size_t steps);

  std::string path_;
  OpenOptions options_;
  physics::Readings readings_;
  Diagnostics diagnostics_;
  std::recursive_mutex mutex_;
  std::shared_ptr<const stage::Stage> stage_;
  std::optional<AssetEditor> editor_;
  std::size_t open_blocks_ = 0;
  bool dropped_ = false;                    // a block inside of the open ones failed
  std::vector<VariantPlace> inside_;        // the last one counts
  std::vector<AssetEdit> waiting_;          // of the open blocks
  std::vector<Path> to_look_at_;            // the same
  std::vector<EditedPlace> places_;         // of the edits that were made last, or of the blocks
  std::size_t steps_ = 0;                   // of the editor's history, the same
  std::vector<std::size_t> done_, undone_;  // steps of the editor for each of ours
};

void bind_stage(nanobind::module_& module);

}  // namespace tenon::python
