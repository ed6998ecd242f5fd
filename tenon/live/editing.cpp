// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Edits go the way of `tenon set`: into the file that owns what they change, proved before they are
// written. Afterwards the asset is opened again for everyone. An edit whose asset would not open
// is not written, because it is composed first.
#include <utility>

#include "tenon/asset/answers/edited_json.h"
#include "tenon/asset/edit_asset.h"
#include "tenon/bytes/read_record.h"
#include "tenon/live/session_state.h"

namespace tenon::live {
namespace {

using EditState = Session::State;

Result<void> check_writable(const EditState& state) {
  if (!state.options.write) {
    return Error(ErrorCode::Unsupported, "this viewer only shows; it changes no file")
        .with_rule("live.read-only")
        .with_fix("start tenon view without --read-only");
  }
  return {};
}

Result<AssetEdit> edit_of(AssetEdit::Kind kind, const Asked& asked) {
  const auto object = Path::parse(asked.text("object"));
  if (!object || !object->is_property() || !object->is_absolute()) {
    return Error(ErrorCode::Invalid, "`" + asked.text("object") + "` is not a property path")
        .with_rule("live.bad-field")
        .with_fix("write it as /hand/palm.physics:mass");
  }
  AssetEdit edit;
  edit.kind = kind;
  edit.object = *object;
  edit.value = asked.text("value");
  return edit;
}

/// Why an edit is without effect, else whatever kept it from being written.
Error fault_of_edit(const Diagnostics& found) {
  for (const Diagnostic& finding : found) {
    if (finding.rule == "edit.no-effect") {
      return {ErrorCode::Invalid, finding};
    }
  }
  return Error(ErrorCode::Invalid, "the edit changes nothing that engines receive")
      .with_rule("edit.no-effect");
}

Result<Json> reopened(EditState& state, const char* why, Outbox& out) {
  TENON_CHECK(state.reopen(state.options.asset, why, out));
  return Json::object();
}

Result<Json> make_edit(EditState& state, const AssetEdit& edit, const std::string& engine,
                       Outbox& out) {
  read_anew();
  EditOptions options = edit_options(state);
  options.engine = engine;
  return make_edits(state, {edit}, options, MayRest::No, false, out);
}

}  // namespace

void read_anew() {
  if (bytes::ReadRecord* record = bytes::ReadRecord::current()) {
    record->clear();
    record->keep_digests();
  }
}

EditOptions edit_options(const Session::State& state) {
  EditOptions options;
  options.open = state.options.asset.open;
  const stage::Prim root = state.asset.stage->default_prim();
  for (const OpenOptions::Selection& selection : options.open.selections) {
    if (root && selection.set == "Physics" && selection.prim == root.path().str()) {
      options.open.physics_variant = selection.variant;
    }
  }
  return options;
}

Result<Json> make_edits(Session::State& state, const std::vector<AssetEdit>& edits,
                        const EditOptions& options, MayRest may_rest, bool dry_run, Outbox& out) {
  if (edits.empty()) {
    return Error(ErrorCode::Invalid, "there is nothing to write: the files say this already")
        .with_rule("live.nothing-to-write");
  }
  Diagnostics found;
  TENON_TRY(const EditedAsset made, edit_asset(state.options.asset.path, edits, options, found));
  if (!made.without_effect.empty() && may_rest == MayRest::No) {
    return fault_of_edit(found);
  }
  return write_made(state, edits, made, dry_run, out);
}

Result<Json> write_made(Session::State& state, const std::vector<AssetEdit>& edits,
                        const EditedAsset& made, bool dry_run, Outbox& out) {
  if (!dry_run) {
    TENON_CHECK(check_writable(state));
    TENON_CHECK(
        state.history.make(made.files, state.options.asset.open.files, state.options.write));
    TENON_CHECK(state.reopen(state.options.asset, "edit", out));
  }
  return edited_json(edits, made, dry_run);
}

Result<Json> set_property(Session::State& state, ClientNumber, const Asked& asked, Outbox& out) {
  TENON_CHECK(check_writable(state));
  TENON_TRY(const AssetEdit edit, edit_of(AssetEdit::Kind::SetProperty, asked));
  return make_edit(state, edit, asked.text("engine"), out);
}

Result<Json> clear_property(Session::State& state, ClientNumber, const Asked& asked, Outbox& out) {
  TENON_CHECK(check_writable(state));
  TENON_TRY(const AssetEdit edit, edit_of(AssetEdit::Kind::ClearProperty, asked));
  return make_edit(state, edit, asked.text("engine"), out);
}

Result<Json> undo_edit(Session::State& state, ClientNumber, const Asked&, Outbox& out) {
  TENON_CHECK(check_writable(state));
  read_anew();
  TENON_CHECK(state.history.undo(state.options.asset.open.files, state.options.write));
  return reopened(state, "undo", out);
}

Result<Json> redo_edit(Session::State& state, ClientNumber, const Asked&, Outbox& out) {
  TENON_CHECK(check_writable(state));
  read_anew();
  TENON_CHECK(state.history.redo(state.options.asset.open.files, state.options.write));
  return reopened(state, "redo", out);
}

}  // namespace tenon::live
