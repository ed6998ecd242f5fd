// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A caller that uses a stage holds its lock, so that threads of Python which let each other run
// during long computations never meet in it. Nobody waits for the lock while holding the
// interpreter: the owner of the lock may need the interpreter to go on. Edits are made by an editor
// that opens the asset when the first one comes, and that is given up when files are written: a
// later edit reads the files again.
#include "opened_stage.h"

#include <utility>

#include "failure.h"
#include "guarded_write.h"

#include "tenon/asset/physics_options.h"
#include "tenon/asset/undoing/undo_edit.h"

namespace tenon::python {

OpenedStage::Access::Access(OpenedStage& owner, WithoutWaiting /*tag*/)
    : lock_(owner.mutex_, std::try_to_lock) {
  if (!lock_) {
    const nb::gil_scoped_release release;
    lock_.lock();
  }
  stage_ = owner.stage_;
}

OpenedStage::Access::Access(OpenedStage& owner) : Access(owner, WithoutWaiting()) {
  if (!owner.waiting_.empty()) {
    Diagnostics found;
    or_raise(unlocked([&] { return owner.make_waiting(found); }), found);
    stage_ = owner.stage_;
  }
}

std::shared_ptr<OpenedStage> OpenedStage::open(std::string path, OpenOptions options,
                                               const physics::Readings& readings) {
  auto opened = std::make_shared<OpenedStage>();
  opened->path_ = std::move(path);
  opened->options_ = with_readings(std::move(options), readings);
  opened->readings_ = readings;
  Result<stage::Stage> stage =
      unlocked([&] { return tenon::open(opened->path_, opened->options_, opened->diagnostics_); });
  opened->stage_ =
      std::make_shared<const stage::Stage>(or_raise(std::move(stage), opened->diagnostics_));
  return opened;
}

/// The editor, opened where there is none.
Result<AssetEditor*> OpenedStage::editor() {
  if (!editor_) {
    Diagnostics again;  // what there is to say opening said
    EditOptions options;
    options.open = options_;
    TENON_TRY(AssetEditor made, AssetEditor::open(path_, options, again));
    editor_ = std::move(made);
    TENON_CHECK(look_again());
  }
  return &*editor_;
}

Result<void> OpenedStage::look_again() {
  TENON_TRY(const auto views, editor_->working_views());
  if (!views.empty()) {
    stage_ = views.front().stage;
  }
  return {};
}

/// Adds to places_ and steps_. The editor keeps no step of edits that change nothing.
Result<void> OpenedStage::edit_now(const std::vector<AssetEdit>& edits, Diagnostics& diagnostics) {
  TENON_TRY(AssetEditor * asset, editor());
  const std::size_t before = asset->step_count();
  auto places = asset->edit(edits, diagnostics);
  TENON_CHECK(look_again());  // also where the edits were taken back
  if (!places) {
    return places.error();
  }
  steps_ += asset->step_count() - before;
  places_.insert(places_.end(), places->begin(), places->end());
  return {};
}

/// A step of ours is as many of the editor.
void OpenedStage::close_step(std::size_t steps) {
  if (steps > 0) {
    done_.push_back(steps);
    undone_.clear();
  }
  steps_ = 0;
}

Result<std::vector<EditedPlace>> OpenedStage::edit(std::vector<AssetEdit> edits,
                                                   Diagnostics& diagnostics) {
  for (AssetEdit& edit : edits) {
    edit.inside = inside_.empty() ? edit.inside : inside_.back();
  }
  if (open_blocks_ > 0) {
    waiting_.insert(waiting_.end(), edits.begin(), edits.end());
    return std::vector<EditedPlace>();
  }
  places_.clear();
  TENON_CHECK(edit_now(edits, diagnostics));
  close_step(steps_);
  return std::exchange(places_, {});
}

Result<void> OpenedStage::make_waiting(Diagnostics& diagnostics) {
  const std::vector<AssetEdit> waiting = std::exchange(waiting_, {});
  return waiting.empty() ? Result<void>() : edit_now(waiting, diagnostics);
}

void OpenedStage::begin_edits() {
  if (open_blocks_++ == 0) {
    places_.clear();
    steps_ = 0;
    dropped_ = false;
    to_look_at_.clear();
  }
}

Result<std::vector<EditedPlace>> OpenedStage::end_edits(Diagnostics& diagnostics) {
  if (open_blocks_ > 1) {
    --open_blocks_;
    return std::vector<EditedPlace>();
  }
  Result<void> made = dropped_
                          ? Error(ErrorCode::Invalid, "a block of edits inside of this one failed")
                          : make_waiting(diagnostics);
  if (!made) {
    TENON_CHECK(drop_edits());
    return made.error();
  }
  open_blocks_ = 0;
  close_step(steps_);
  return std::exchange(places_, {});
}

Result<void> OpenedStage::drop_edits() {
  open_blocks_ -= open_blocks_ > 0 ? 1 : 0;
  waiting_.clear();
  places_.clear();
  dropped_ = open_blocks_ > 0;
  bool gone = false;
  for (; steps_ > 0; --steps_) {
    gone = editor_ && editor_->undo();
  }
  return gone ? look_again() : Result<void>();
}

Result<std::vector<std::shared_ptr<const stage::Stage>>> OpenedStage::views() {
  TENON_TRY(AssetEditor * asset, editor());
  TENON_TRY(const auto views, asset->working_views());
  std::vector<std::shared_ptr<const stage::Stage>> stages;
  for (const AssetEditor::View& view : views) {
    stages.push_back(view.stage);
  }
  return stages;
}

Result<bool> OpenedStage::undo() {
  if (!editor_ || done_.empty()) {
    return false;
  }
  for (std::size_t i = 0; i < done_.back(); ++i) {
    editor_->undo();
  }
  undone_.push_back(done_.back());
  done_.pop_back();
  TENON_CHECK(look_again());
  return true;
}

Result<bool> OpenedStage::redo() {
  if (!editor_ || undone_.empty()) {
    return false;
  }
  for (std::size_t i = 0; i < undone_.back(); ++i) {
    editor_->redo();
  }
  done_.push_back(undone_.back());
  undone_.pop_back();
  TENON_CHECK(look_again());
  return true;
}

Result<std::vector<EditedFile>> OpenedStage::edited_files() const {
  return editor_ ? editor_->files() : std::vector<EditedFile>();
}

Result<OpenOptions> OpenedStage::options_as_edited() const {
  TENON_TRY(std::vector<EditedFile> files, edited_files());
  OpenOptions options = options_;
  bytes::FileMap contents;
  for (EditedFile& file : files) {
    contents[file.path] = bytes::FileBytes::own(std::move(file.after));
  }
  options.files = options.files.with(std::move(contents));
  return options;
}

Result<std::vector<EditedFile>> OpenedStage::save(bool undoable) {
  TENON_TRY(std::vector<EditedFile> files, edited_files());
  if (!files.empty()) {
    std::vector<bytes::ReplacedFile> replaced;
    TENON_CHECK(write_files(files, undoable ? &replaced : nullptr));
    keep_for_undo("Stage.save()", path_, std::move(replaced), bytes::Files());
  }
  editor_.reset();
  done_.clear();
  undone_.clear();
  return files;
}

}  // namespace tenon::python
