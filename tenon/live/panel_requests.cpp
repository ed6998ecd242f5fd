// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The requests of the panels of pairs, drives, gains, poses and findings. Those that write take
// "dryRun", which tells the difference and writes nothing.
#include <array>

#include "tenon/live/session_state.h"

namespace tenon::live {
namespace {

constexpr std::uint32_t kMostPostures = 10'000;

constexpr Field kDryRun{"dryRun", FieldType::Flag, false, "tell the difference, write nothing"};
constexpr Field kPostures{"postures", FieldType::Integer, false,
                          "that are drawn, at most 10,000; default 1000", kMostPostures};
constexpr Field kSeed{"seed", FieldType::Integer, false, "what they are drawn from; default 0"};
constexpr Field kJoint{"joint", FieldType::Path, true, "the joint's prim"};
constexpr Field kDof{"dof", FieldType::Text, true, "`transX` to `rotZ`: which of its drives"};
constexpr Field kPose{"pose", FieldType::Path, true, "the prim of the pose"};
constexpr Field kName{"name", FieldType::Text, true, "of the pose"};

constexpr std::array kPairsFields{
    kPostures, kSeed, Field{"environment", FieldType::Flag, false, "static colliders, too"},
    Field{"all", FieldType::Flag, false, "pairs that never touch, too"}};
constexpr std::array kPairRow{Field{"bodyA", FieldType::Path, true, "a body or static collider"},
                              Field{"bodyB", FieldType::Path, true, "the other one"}};
constexpr std::array kFilterFields{
    Field{"filter", FieldType::Rows, false, "pairs to keep apart: rows {`bodyA`, `bodyB`}", 0,
          kPairRow},
    Field{"unfilter", FieldType::Rows, false, "pairs whose filter goes, likewise", 0, kPairRow},
    kDryRun};
constexpr std::array kDrivesFields{
    Field{"postures", FieldType::Integer, false,
          "that are drawn beside the start, at most 10,000; default 100", kMostPostures},
    kSeed};
constexpr std::array kLimitRow{
    kJoint, kDof, Field{"maxEffort", FieldType::Number, false, "[N m, N]; default: as it is"},
    Field{"speedLimit", FieldType::Number, false, "[rad/s, m/s]; default: as it is"}};
constexpr std::array kLimitsFields{
    Field{"limits", FieldType::Rows, true,
          "rows {`joint`, `dof`, `maxEffort`, `speedLimit`} [N m, N; rad/s, m/s]; null: as it is",
          0, kLimitRow},
    kDryRun};
constexpr std::array<Field, 0> kNothing{};
constexpr std::array kGainFields{
    kJoint,
    kDof,
    Field{"frequency", FieldType::Number, false, "natural [rad/s]; default: as it is"},
    Field{"dampingRatio", FieldType::Number, false, "default: as it is"},
    Field{"stiffness", FieldType::Number, false, "[N m/rad, N/m], in place of these"},
    Field{"damping", FieldType::Number, false, "[N m s/rad, N s/m], likewise"}};
constexpr std::array kSaveFields{kDryRun};
constexpr std::array kTestFields{
    Field{"test", FieldType::Text, true, "`snap`, `step` or `sine`"},
    Field{"joints", FieldType::Paths, false, "of which the drives are tested; default: all"},
    Field{"period", FieldType::Number, false, "of step and sine, 0.05 to 60 [s]"},
    Field{"amplitude", FieldType::Number, false, "likewise, as a part of the range, at most 1"}};
constexpr std::array kGoFields{
    kPose, Field{"hold", FieldType::Flag, false, "drives hold it then; also while it plays"}};
constexpr std::array kSavePoseFields{kName, kDryRun};
constexpr std::array kRenamePoseFields{kPose, Field{"name", FieldType::Text, true, "the new one"},
                                       kDryRun};
constexpr std::array kRemovePoseFields{kPose, kDryRun};
constexpr std::array kImportFields{
    Field{"text", FieldType::Text, true, "a file as `tenon pose --export` writes it"}, kDryRun};
constexpr std::array kFixFields{
    Field{"rule", FieldType::Text, false, "of findings of this rule; default: of all"},
    Field{"prim", FieldType::Text, false, "and of this prim"},
    Field{"property", FieldType::Text, false, "and of this property"},
    Field{"file", FieldType::Text, false, "and in this file, as the finding names it"},
    Field{"line", FieldType::Integer, false, "and this line", 4'000'000'000},
    Field{"suggested", FieldType::Flag, false, "also what is only suggested"},
    kDryRun};

constexpr const char* kAsSet = "as `tenon set --json`";

constexpr std::array kPanelRequests{
    Request{{"pairs", kPairsFields, "Which bodies touch, in postures that are drawn",
             "as `tenon pairs --json`"},
            ask_pairs},
    Request{{"filterPairs", kFilterFields, "Keeps pairs of bodies apart, or no longer", kAsSet},
            filter_pairs},
    Request{{"drives", kDrivesFields, "What motors can do and have to hold",
             "as `tenon drives --json`"},
            ask_drives},
    Request{{"setLimits", kLimitsFields, "What motors can do, written to the files that own it",
             kAsSet},
            set_limits},
    Request{{"gains", kNothing, "Gains as frequency and damping ratio; `to` has what was set",
             "as `tenon tune --json`"},
            ask_gains},
    Request{{"setGains", kGainFields,
             "Sets gains in the model as it runs, until they are saved or forgotten",
             "{`stiffness`, `damping`, `frequency`, `frequencyHz`, `dampingRatio`, `regime`, "
             "`stableUpTo` [rad/s]: what its steps hold; null: everything}"},
            set_live_gains},
    Request{{"forgetGains", kNothing, "All gains are those of the files again", "nothing"},
            forget_gains},
    Request{{"saveGains", kSaveFields, "Writes what was set, as one edit", kAsSet}, save_gains},
    Request{{"testDrives", kTestFields,
             "Tests drives one after the other with the gains that were set, beside what is shown",
             "as `tenon tune --test --json`, and `interrupted`"},
            test_live_drives},
    Request{{"cancel", kNothing,
             "Ends `pairs`, `drives` and `testDrives` that this page has asked for", "nothing"},
            cancel_work},
    Request{{"poses", kNothing, "The poses that the asset keeps",
             "as `tenon pose --json`, and `file`: what `tenon pose --export` writes"},
            ask_poses},
    Request{{"goToPose", kGoFields, "Moves joints to a pose by hand; time has to stand still",
             "{`joints`: how many}"},
            go_to_pose},
    Request{{"savePose", kSavePoseFields, "Keeps where the joints are now, over one of this name",
             kAsSet},
            save_pose},
    Request{{"renamePose", kRenamePoseFields, "Gives a pose another name", kAsSet}, rename_pose},
    Request{{"removePose", kRemovePoseFields, "Removes a pose", kAsSet}, remove_pose},
    Request{
        {"importPoses", kImportFields, "Keeps all poses of a file, at most 32 KiB of text", kAsSet},
        import_poses},
    Request{{"fix", kFixFields, "Corrects findings that have a safe fix, as `tenon check --fix`",
             kAsSet},
            apply_fixes},
};

}  // namespace

std::span<const Request> panel_requests() { return kPanelRequests; }

}  // namespace tenon::live
