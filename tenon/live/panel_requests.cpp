// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The requests of the panels of pairs, drives, gains, poses and findings. Those that write take
// "dryRun", which tells the difference and writes nothing.
#include <array>

#include "tenon/live/session_state.h"
#include "tenon/live/shapes.h"

namespace tenon::live {
namespace {

constexpr std::uint32_t kMostPostures = 10'000;

constexpr Field kDryRun{"dryRun", kFlag, false, "tell the difference, write nothing"};
constexpr Field kPostures{"postures", kInteger, false,
                          "that are drawn, at most 10,000; default 1000", kMostPostures};
constexpr Field kSeed{"seed", kInteger, false, "what they are drawn from; default 0"};
constexpr Field kJoint{"joint", kPath, true, "the joint's prim"};
constexpr Field kDof{"dof", kText, true, "`transX` to `rotZ`: which of its drives"};
constexpr Field kPose{"pose", kPath, true, "the prim of the pose"};
constexpr Field kName{"name", kText, true, "of the pose"};

constexpr std::array kPairsFields{kPostures, kSeed,
                                  Field{"environment", kFlag, false, "static colliders, too"},
                                  Field{"all", kFlag, false, "pairs that never touch, too"}};
constexpr std::array kPairRow{Field{"bodyA", kPath, true, "a body or static collider"},
                              Field{"bodyB", kPath, true, "the other one"}};
constexpr Shape kPair{"BodyPair", kPairRow};
constexpr std::array kFilterFields{
    Field{"filter", FieldType::Rows, false, "pairs to keep apart", 0, &kPair},
    Field{"unfilter", FieldType::Rows, false, "pairs whose filter goes, likewise", 0, &kPair},
    kDryRun};
constexpr std::array kDrivesFields{
    Field{"postures", kInteger, false,
          "that are drawn beside the start, at most 10,000; default 100", kMostPostures},
    kSeed};
constexpr std::array kLimitRow{
    kJoint, kDof, Field{"maxEffort", kNumber, false, "[N m, N]; default: as it is"},
    Field{"speedLimit", kNumber, false, "[rad/s, m/s]; default: as it is"}};
constexpr Shape kLimits{"DriveLimits", kLimitRow};
constexpr std::array kLimitsFields{rows("limits", kLimits, "of drives"), kDryRun};
constexpr std::array<Field, 0> kNothing{};
constexpr std::array kGainFields{
    kJoint,
    kDof,
    Field{"frequency", kNumber, false, "natural [rad/s]; default: as it is"},
    Field{"dampingRatio", kNumber, false, "default: as it is"},
    Field{"stiffness", kNumber, false, "[N m/rad, N/m], in place of these"},
    Field{"damping", kNumber, false, "[N m s/rad, N s/m], likewise"}};
constexpr std::array kSaveFields{kDryRun};
constexpr std::array kTestFields{
    Field{"test", kText, true, "`snap`, `step` or `sine`"},
    Field{"joints", kPaths, false, "of which the drives are tested; default: all"},
    Field{"period", kNumber, false, "of step and sine, 0.05 to 60 [s]"},
    Field{"amplitude", kNumber, false, "likewise, as a part of the range, at most 1"}};
constexpr std::array kGoFields{
    kPose, Field{"hold", kFlag, false, "drives hold it then; also while it plays"}};
constexpr std::array kSavePoseFields{kName, kDryRun};
constexpr std::array kRenamePoseFields{kPose, Field{"name", kText, true, "the new one"}, kDryRun};
constexpr std::array kRemovePoseFields{kPose, kDryRun};
constexpr std::array kImportFields{
    Field{"text", kText, true, "a file as `tenon pose --export` writes it"}, kDryRun};
constexpr std::array kFixFields{
    Field{"rule", kText, false, "of findings of this rule; default: of all"},
    Field{"prim", kText, false, "and of this prim"},
    Field{"property", kText, false, "and of this property"},
    Field{"file", kText, false, "and in this file, as the finding names it"},
    Field{"line", kInteger, false, "and this line", 4'000'000'000},
    Field{"suggested", kFlag, false, "also what is only suggested"},
    kDryRun};

// ---- what is answered

constexpr std::array kFilterRow{Field{"why", kText}, Field{"property", kText, false}};
constexpr Shape kFilter{"PairFilter", kFilterRow, "pairs"};
constexpr std::array kFoundPairFields{
    Field{"bodyA", kPath},
    Field{"bodyB", kPath},
    Field{"adjacent", kFlag},
    Field{"startDepth", kNumber, false, "[m]; null: not at the start"},
    Field{"share", kNumber, false, "of the postures"},
    Field{"class", kText, false, "`always`, `often`, `sometimes` or `never`"},
    Field{"depth", kNumber, false, "[m]"},
    Field{"filtered", kText, true, "`no`, `partly` or `yes`"},
    rows("filters", kFilter),
    Field{"overFiltered", kFlag}};
constexpr Shape kFoundPair{"FoundPair", kFoundPairFields, "pairs"};
constexpr std::array kFoundPairsFields{Field{"postures", kInteger}, Field{"never", kInteger},
                                       Field{"pairCount", kInteger}, rows("pairs", kFoundPair)};
constexpr Shape kFoundPairs{"FoundPairs", kFoundPairsFields, "pairs"};

constexpr std::array kDemandFields{
    kJoint,
    Field{"dof", kText},
    Field{"maxEffort", kNumber, false, "[N m, N]"},
    Field{"speedLimit", kNumber, false, "[rad/s, m/s]"},
    Field{"weight", kNumber, false, "the largest that it has to hold [N m, N]"},
    list("inertia", kEachNumberOrNull, "the least and the most [kg m^2, kg]"),
    Field{"tooWeak", kFlag},
    Field{"followers", kPaths}};
constexpr Shape kDemand{"DriveDemand", kDemandFields, "drives"};
constexpr std::array kDemandsFields{Field{"postures", kInteger}, rows("drives", kDemand)};
constexpr Shape kDemands{"", kDemandsFields, "drives"};

constexpr Field kStiffness{"stiffness", kNumber, true, "[N m/rad, N/m]"};
constexpr Field kDamping{"damping", kNumber, true, "[N m s/rad, N s/m]"};
constexpr Field kNatural{"frequency", kNumber, false, "natural [rad/s]"};
constexpr Field kFrequencyHz{"frequencyHz", kNumber, false};
constexpr Field kRatio{"dampingRatio", kNumber, false};
constexpr Field kRegime{"regime", kText, false};
constexpr std::array kGainsOfDrive{kStiffness, kDamping, kNatural, kFrequencyHz, kRatio, kRegime};
constexpr Shape kGains{"DriveGains", kGainsOfDrive, "tune"};
constexpr std::array kLiveGainsFields{
    kStiffness,
    kDamping,
    kNatural,
    kFrequencyHz,
    kRatio,
    kRegime,
    Field{"stableUpTo", kNumber, false, "[rad/s]: what its steps hold; null: everything"}};
constexpr Shape kLiveGains{"LiveGains", kLiveGainsFields};
constexpr std::array kTunedFields{
    kJoint,
    Field{"axis", kText},
    Field{"type", kText, false, "`force` or `acceleration`; null: there is no drive"},
    kStiffness,
    kDamping,
    kNatural,
    kFrequencyHz,
    kRatio,
    kRegime,
    Field{"whyNot", kText, false, "it cannot be tuned"},
    object("to", kGains, false, "what was set"),
    list("notes", kEachText)};
constexpr Shape kTuned{"TunedDrive", kTunedFields, "tune"};
constexpr std::array kTunedAnswer{rows("drives", kTuned)};
constexpr Shape kTunedDrives{"", kTunedAnswer, "tune"};
constexpr std::array kTestedEngineFields{Field{"engine", kText}, rows("results", kTested)};
constexpr Shape kTestedEngine{"TestedEngine", kTestedEngineFields, "tune --test"};
constexpr std::array kTestedAnswer{rows("engines", kTestedEngine), Field{"interrupted", kFlag}};
constexpr Shape kTestedDrives{"", kTestedAnswer, "tune --test"};

constexpr std::array kPoseJointFields{
    Field{"joint", kText}, Field{"problem", kText, false, "`missing` or `outside` its limits"}};
constexpr Shape kPoseJoint{"PoseJoint", kPoseJointFields, "pose"};
constexpr std::array kNamedPoseFields{Field{"name", kText}, Field{"path", kPath},
                                      Field{"valid", kFlag}, rows("joints", kPoseJoint)};
constexpr Shape kNamedPose{"NamedPose", kNamedPoseFields, "pose"};
constexpr std::array kPosesAnswer{rows("poses", kNamedPose),
                                  Field{"file", kText, true, "what `tenon pose --export` writes"}};
constexpr Shape kPoses{"", kPosesAnswer};
constexpr std::array kWentAnswer{Field{"joints", kInteger, true, "how many moved"}};
constexpr Shape kWent{"", kWentAnswer};

constexpr std::array kPanelRequests{
    Request{{"pairs", kPairsFields, "Which bodies touch, in postures that are drawn", &kFoundPairs},
            ask_pairs},
    Request{{"filterPairs", kFilterFields, "Keeps pairs of bodies apart, or no longer", &kEdited},
            filter_pairs},
    Request{{"drives", kDrivesFields, "What motors can do and have to hold", &kDemands},
            ask_drives},
    Request{{"setLimits", kLimitsFields, "What motors can do, written to the files that own it",
             &kEdited},
            set_limits},
    Request{{"gains", kNothing, "Gains as frequency and damping ratio; `to` has what was set",
             &kTunedDrives},
            ask_gains},
    Request{{"setGains", kGainFields,
             "Sets gains in the model as it runs, until they are saved or forgotten", &kLiveGains},
            set_live_gains},
    Request{{"forgetGains", kNothing, "All gains are those of the files again"}, forget_gains},
    Request{{"saveGains", kSaveFields, "Writes what was set, as one edit", &kEdited}, save_gains},
    Request{{"testDrives", kTestFields,
             "Tests drives one after the other with the gains that were set, beside what is shown",
             &kTestedDrives},
            test_live_drives},
    Request{{"cancel", kNothing,
             "Ends `pairs`, `drives` and `testDrives` that this page has asked for"},
            cancel_work},
    Request{{"poses", kNothing, "The poses that the asset keeps", &kPoses}, ask_poses},
    Request{
        {"goToPose", kGoFields, "Moves joints to a pose by hand; time has to stand still", &kWent},
        go_to_pose},
    Request{{"savePose", kSavePoseFields, "Keeps where the joints are now, over one of this name",
             &kEdited},
            save_pose},
    Request{{"renamePose", kRenamePoseFields, "Gives a pose another name", &kEdited}, rename_pose},
    Request{{"removePose", kRemovePoseFields, "Removes a pose", &kEdited}, remove_pose},
    Request{{"importPoses", kImportFields, "Keeps all poses of a file, at most 32 KiB of text",
             &kEdited},
            import_poses},
    Request{{"fix", kFixFields, "Corrects findings that have a safe fix, as `tenon check --fix`",
             &kEdited},
            apply_fixes},
};

}  // namespace

std::span<const Request> panel_requests() { return kPanelRequests; }

}  // namespace tenon::live
