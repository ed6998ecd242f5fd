// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/output.h"
#include "cli/report.h"
#include "cli/verb.h"
#include "tenon/asset/undoing/undo_edit.h"
#include "tenon/base/text/shown_path.h"
#include "tenon/diff/unified_diff.h"

namespace tenon::cli {
namespace {

struct UndoArguments {
  std::string asset;
  bool dry_run = false;
};

void print_files(const Report& report, const UndoneEdit& edit, bool dry_run) {
  for (const EditedFile& file : edit.files) {
    const std::string name = shown_path(file.path);
    if (dry_run && file.text) {
      print_data(diff::unified_diff(name, file.before, file.after));
    } else {
      report.note((file.removed ? (dry_run ? "would remove " : "removed ")
                                : (dry_run ? "would restore " : "restored ")) +
                  name);
    }
  }
  report.note((dry_run ? "would undo tenon " : "undone: tenon ") + edit.verb + " " +
              shown_path(edit.asset));
}

Result<UndoneEdit> undo(const UndoArguments& options) {
  TENON_TRY(UndoneEdit edit, undo_edit(options.asset, bytes::Files()));
  if (!options.dry_run) {
    TENON_CHECK(write_undone(edit));
  }
  return edit;
}

int run_undo(const Globals& globals, const UndoArguments& options) {
  Report report(globals, "undo", options.asset);
  const auto edit = undo(options);
  if (!edit) {
    return report.fail(edit.error());
  }
  if (!report.json()) {
    print_files(report, *edit, options.dry_run);
  }
  return report.finish(kOk, undone_json(*edit, options.dry_run));
}

}  // namespace

void add_undo(const Command& parent, const Globals& globals, Chosen& chosen) {
  const Command verb = parent.add_subcommand("undo", "Undo the last edit of an asset");
  auto options = std::make_shared<UndoArguments>();
  verb.add_option("asset", options->asset, "The asset that was edited, or a file of it")
      .required()
      .file_only();
  verb.add_flag("--dry-run", options->dry_run, "Print the difference, write nothing");
  verb.footer(
      "Takes back what set, add, remove, rename, view, tenon check --fix, tenon convert --update,\n"
      "tenon structure --update or a verb that edits in place wrote, all files of the edit or "
      "none.\n"
      "Called again it undoes the edit before that. Where a file has changed since, nothing is\n"
      "written (undo.changed). What edits replaced is kept for that in\n"
      "$XDG_STATE_HOME/tenon/undo, else ~/.local/state/tenon/undo.\n\n"
      "Examples:\n  tenon undo hand.usda --dry-run\n  tenon undo hand.usda");
  choose(verb, chosen, [&globals, options] { return run_undo(globals, *options); });
}

}  // namespace tenon::cli
