// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "cli/command_line.h"
#include "cli/file_access.h"
#include "tenon/bytes/files.h"
#include "tenon/open_stage.h"

namespace tenon::cli {

struct Envelopes;  // cli/report.h

/// Options that every verb understands.
struct Globals {
  bool json = false;
  bool quiet = false;
  bool verbose = false;
  bool version = false;
  bool no_settings = false;
  std::string color = "auto";
  Envelopes* collected = nullptr;  ///< where the JSON of one asset of several goes
};

/// The verb that the command line chose; run after parsing.
struct Chosen {
  std::function<int()> run;
};

/// All of standard input, read once however often it is asked for. Throws std::runtime_error where
/// it cannot be read or is too large.
std::shared_ptr<const bytes::FileBytes> standard_input();
/// The disk, with standard input in the place of a file named "-".
bytes::Files disk_and_standard_input();

/// Help of --physics where prims below the default prim are meant, too.
inline constexpr const char* kPhysicsHelp =
    "Select this variant of the variant set \"Physics\" of the default prim and of all prims below "
    "that have it, or with PRIM=VARIANT of one prim (several with commas between); no file is "
    "touched";
/// `text` is what --physics says.
void select_physics(const std::string& text, OpenOptions& options);

/// The asset and how it is to be composed: shared by the verbs that open a stage.
struct AssetArguments {
  std::string asset;
  std::string physics;                 ///< --physics V, --physics PRIM=V
  std::vector<std::string> overrides;  ///< --set PATH.attr=value
  std::vector<std::string> mask;
  bool unloaded = false;
  std::vector<std::string> load;   ///< --load none, all or prim paths
  std::vector<std::string> muted;  ///< --mute-layer LAYER
  FileAccess files;                ///< --search-path, --sandbox, --allow-read

  /// Adds the positional and the options to `verb`, which reads a file.
  void add_to(const Command& verb);
  /// The same for a verb that also reads a layer from standard input, named "-".
  void add_with_standard_input_to(const Command& verb);
  /// The same for verbs that answer for several assets in turn (each_asset in cli/report.h).
  void add_several_to(const Command& verb, std::vector<std::string>& assets);
  /// The options alone.
  void add_options_to(const Command& verb);
  OpenOptions open_options() const;
  /// Something is chosen that only a composed scene has.
  bool selects() const;
  /// Refuses options that select parts of a composed scene, where a verb is about whole files:
  /// Invalid (usage.conflict), which names the option. `why` ends the message.
  Result<void> check_whole(const char* why) const;
};

/// Lets `verb` run `run` when it is chosen.
inline void choose(const Command& verb, Chosen& chosen, std::function<int()> run) {
  verb.when_chosen([&chosen, run = std::move(run)] { chosen.run = run; });
}

using AddVerb = void(const Command& parent, const Globals& globals, Chosen& chosen);
AddVerb add_add;
AddVerb add_bake;
AddVerb add_bench;
AddVerb add_benchmark;
AddVerb add_cat;
AddVerb add_check;
AddVerb add_colliders;
AddVerb add_compare;
AddVerb add_completion;
AddVerb add_convert;
AddVerb add_diff;
AddVerb add_doctor;
AddVerb add_drives;
AddVerb add_dump;
AddVerb add_dump_index;
AddVerb add_excite;
AddVerb add_explain;
AddVerb add_help;
AddVerb add_identify;
AddVerb add_inertia;
AddVerb add_info;
AddVerb add_manual;
AddVerb add_new;
AddVerb add_pairs;
AddVerb add_physics;
AddVerb add_pose_verb;
AddVerb add_record;
AddVerb add_remove;
AddVerb add_rename;
AddVerb add_report;
AddVerb add_set;
AddVerb add_sim;
AddVerb add_strip;
AddVerb add_structure;
AddVerb add_tree;
AddVerb add_tune;
AddVerb add_undo;
AddVerb add_variant;
AddVerb add_sweep;
AddVerb add_test_runner;
AddVerb add_version;
AddVerb add_view;
AddVerb add_where;
AddVerb add_zip;

/// The verb dump-index under the name `name`, with variant fallbacks for where none are given.
void add_index_dump(const Command& parent, const std::string& name, const std::string& fallbacks,
                    const Globals& globals, Chosen& chosen);

}  // namespace tenon::cli
