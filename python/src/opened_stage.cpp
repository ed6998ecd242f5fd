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

namespace tenon::python {

OpenedStage::Access::Access(OpenedStage& owner) : lock_(owner.mutex_, std::try_to_lock) {
  if (!lock_) {
    const nb::gil_scoped_release release;
    lock_.lock();
  }
  stage_ = owner.stage_;
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
  }
  return &*editor_;
}

Result<void> OpenedStage::look_again() {
  TENON_TRY(const auto views, editor_->views());
  if (!views.empty()) {
    stage_ = views.front().stage;
  }
  return {};
}

Result<std::vector<EditedPlace>> OpenedStage::edit(const std::vector<AssetEdit>& edits,
                                                   Diagnostics& diagnostics) {
  TENON_TRY(AssetEditor * asset, editor());
  TENON_TRY(auto places, asset->edit(edits, diagnostics));
  TENON_CHECK(look_again());
  return places;
}

Result<bool> OpenedStage::undo() {
  if (!editor_ || !editor_->undo()) {
    return false;
  }
  TENON_CHECK(look_again());
  return true;
}

Result<bool> OpenedStage::redo() {
  if (!editor_ || !editor_->redo()) {
    return false;
  }
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

Result<std::vector<EditedFile>> OpenedStage::save() {
  TENON_TRY(std::vector<EditedFile> files, edited_files());
  if (!files.empty()) {
    TENON_CHECK(write_files(files));
  }
  editor_.reset();
  return files;
}

}  // namespace tenon::python
