// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/sdf/read_sdf.h"

#include "tenon/sdf/model_files.h"
#include "tenon/sdf/model_tree.h"
#include "tenon/sdf/sdf_draft.h"

namespace tenon::sdf {

namespace {

/// What models say beside links, joints and frames.
void list_models(const ModelTree& tree) {
  for (std::size_t i = 1; i < tree.models.size(); ++i) {
    const SdfModel& model = tree.models[i];
    model.file->list_skipped(model.element,
                             {"link", "joint", "frame", "model", "include", "pose", "static",
                              "self_collide", "plugin", "gripper"},
                             {"allow_auto_disable", "enable_wind"});
    SdfNode named = tree.nodes[model.node];
    named.element = model.element;  // not the <include>
    named.file = model.file;
    list_parts(named);
  }
}

}  // namespace

Result<robot::RobotModel> read_sdf_text(std::string_view text, const std::string& path,
                                        const SdfOptions& options, Diagnostics& diagnostics) {
  ModelFiles files(options, diagnostics);
  TENON_TRY(SdfFile* const file, files.open_main(text, path));
  TENON_TRY(const ChosenModel chosen, choose_model(*file, options.model));
  TENON_TRY(ModelTree tree, gather_model(chosen, files));
  TENON_CHECK(place_nodes(tree));
  SdfDraft draft{.tree = std::move(tree), .files = files};
  draft.model.file = chosen.file->path();
  draft.model.name = draft.tree.models[1].name;
  list_models(draft.tree);
  TENON_CHECK(read_links(draft));
  make_static(draft);
  TENON_CHECK(read_joints(draft));
  make_tree(draft);
  draft.model.parts_folders = files.found_folders();
  return std::move(draft.model);
}

}  // namespace tenon::sdf
