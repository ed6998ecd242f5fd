// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The requests of the panel "Identify", which are stages of `tenon identify`.
#include <array>

#include "tenon/live/session_state.h"
#include "tenon/live/shapes.h"

namespace tenon::live {
namespace {

constexpr std::uint32_t kMostStarts = 256;

constexpr std::array kWordRow{Field{"text", kText}};
constexpr Shape kWord{"Word", kWordRow};
constexpr Field words(const char* name, const char* meaning) {
  return {name, FieldType::Rows, false, meaning, 0, &kWord};
}
constexpr std::array kIdentifyFields{
    Field{"stage", kText, true, "`check`, `solve` or `selfTest`"},
    words("logs", "those to fit, of `identifyLogs`; default: all"),
    words("heldOut", "logs that are not fitted, to prove the result on"),
    words("parameters", "as `--identify` takes them; default: what logs usually tell"),
    words("priors", "as `--prior` takes them"),
    words("names", "what logs call a joint: NAME=JOINT"),
    words("signs", "joints that logs count the other way: JOINT=-1"),
    Field{"units", kText, false, "of logs that are not in SI: `deg`, `mm`"},
    Field{"allowGaps", kFlag, false, "take logs in which samples are missing"},
    Field{"hold", kFlag, false, "what the logs do not tell keeps the asset's number"},
    Field{"training", kNumber, false, "of each log the part that is fitted; default 0.7"},
    Field{"timeStep", kNumber, false, "[s]; default: the asset's"},
    Field{"window", kNumber, false, "[s]; default: as the verb has it"},
    Field{"starts", kInteger, false, "fits from as many starts; default 1", kMostStarts}};
constexpr std::array kWriteFields{
    Field{"force", kFlag, false, "also what predicts held-out motion no better"},
    Field{"dryRun", kFlag, false, "tell the difference, write nothing"}};

constexpr std::array kLogsFields{list("logs", kEachText, "files"),
                                 Field{"commands", kText, false, "the table that they lack"},
                                 Field{"layer", kText, true, "the file that is written"},
                                 Field{"whyNot", kText, false, "nothing can be identified"}};
constexpr Shape kLogs{"", kLogsFields};
constexpr std::array kParameterFields{
    Field{"name", kText},
    Field{"family", kText},
    Field{"unit", kText},
    Field{"nominal", kNumber, false, "of the asset"},
    may_miss({"value", kNumber, false, "identified"}),
    may_miss({"low", kNumber, false, "of 95 %"}),
    may_miss({"high", kNumber, false, "likewise"}),
    may_miss({"expectedError", kNumber, false, "of the best fit"}),
    may_miss({"told", kFlag, true, "whether the logs tell it"}),
    may_miss({"truth", kNumber, false, "of a self-test"}),
    may_miss({"found", kNumber, false, "likewise"}),
    may_miss({"error", kNumber, false, "standard error; of a self-test the part that it is off"}),
    may_miss({"passed", kFlag, true, "of a self-test"})};
constexpr Shape kParameter{"IdentifiedParameter", kParameterFields, "identify"};
constexpr std::array kCheckFields{rows("parameters", kParameter),
                                  list("refused", kEachText, "why the logs do not tell them"),
                                  Field{"quality", FieldType::Any}};
constexpr Shape kCheck{"IdentifyCheck", kCheckFields, "identify --check"};
constexpr std::array kLeftFields{Field{"channel", kText}, Field{"joint", kText},
                                 Field{"before", kNumber, false}, Field{"after", kNumber, false}};
constexpr Shape kLeft{"LeftOver", kLeftFields, "identify"};
constexpr std::array kReplayFields{Field{"engine", kText}, Field{"before", kNumber, false},
                                   Field{"after", kNumber, false}, Field{"why", kText}};
constexpr Shape kReplay{"EngineReplay", kReplayFields, "identify"};
constexpr std::array kIdentifiedFields{
    Field{"ok", kFlag},
    may_miss(object("check", kCheck, true)),
    may_miss(rows("parameters", kParameter)),
    may_miss(rows("heldOut", kLeft, "root mean squares of residuals")),
    may_miss(rows("engines", kReplay)),
    may_miss(rows("scores", kParameter, "of a self-test")),
    may_miss(list("problems", kEachText, "why the layer would not be written"))};
constexpr Shape kIdentified{"Identified", kIdentifiedFields, "identify"};

constexpr std::array<Field, 0> kNoIdentifyFields{};
constexpr std::array kIdentifyRequests{
    Request{{"identifyLogs", kNoIdentifyFields, "The logs that can be identified from", &kLogs},
            tell_identify_logs},
    Request{{"identify", kIdentifyFields, "A stage of `tenon identify`; beside other long requests",
             &kIdentified},
            identify},
    Request{{"writeIdentified", kWriteFields,
             "Writes what the last `solve` found as a layer over the asset", &kEdited},
            write_identified},
};

}  // namespace

std::span<const Request> identify_requests() { return kIdentifyRequests; }

}  // namespace tenon::live
