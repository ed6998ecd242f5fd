// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Objects that notices and answers share, and what tables of fields are written with.
#pragma once

#include <array>
#include <string_view>

#include "tenon/live/messages.h"

namespace tenon::live {

inline constexpr auto kText = FieldType::Text;
inline constexpr auto kPath = FieldType::Path;
inline constexpr auto kNumber = FieldType::Number;
inline constexpr auto kInteger = FieldType::Integer;
inline constexpr auto kFlag = FieldType::Flag;
inline constexpr auto kPoint = FieldType::Point;
inline constexpr auto kNumbers = FieldType::Numbers;
inline constexpr auto kPaths = FieldType::Paths;

constexpr Field object(std::string_view name, const Shape& shape, bool required,
                       std::string_view meaning = {}) {
  return {name, FieldType::Object, required, meaning, 0, &shape};
}
constexpr Field rows(std::string_view name, const Shape& shape, std::string_view meaning = {}) {
  return {name, FieldType::Rows, true, meaning, 0, &shape};
}
constexpr Field list(std::string_view name, const Field& item, std::string_view meaning = {}) {
  return {name, FieldType::List, true, meaning, 0, nullptr, &item};
}
constexpr Field may_miss(Field field) {
  field.may_miss = true;
  return field;
}

// Of lists.
inline constexpr Field kEachText{"", kText};
inline constexpr Field kEachNumbers{"", kNumbers};
inline constexpr Field kEachNumberOrNull{"", kNumber, false};
inline constexpr Field kEachAny{"", FieldType::Any};

inline constexpr std::array kFindingFields{
    Field{"severity", kText, true, "`error`, `warning` or `info`"},
    Field{"rule", kText, false, "`tenon explain RULE` tells of it"},
    Field{"message", kText, true, "what is wrong"},
    Field{"file", kText, false},
    Field{"line", kInteger, false},
    Field{"prim", kText, false},
    Field{"property", kText, false},
    Field{"fix", kText, false, "what to do"},
    may_miss({"autofix", kText, false, "of a check: what the request `fix` writes"}),
    may_miss({"suggestedFix", kText, false, "what it writes only when asked for"}),
};
inline constexpr Shape kFinding{"Finding", kFindingFields, "check"};

// ---- edits

inline constexpr std::array kPlaceFields{
    Field{"before", kText, false},  Field{"after", kText, false},           Field{"file", kText},
    Field{"line", kInteger, false}, Field{"why", kText, true, "this file"},
};
inline constexpr Shape kPlace{"EditedPlace", kPlaceFields, "set"};
inline constexpr std::array kDifferenceFields{
    Field{"change", kText, true, "`added`, `removed` or `changed`"},
    Field{"path", kText},
    Field{"what", kText, false, "null: the whole object"},
    Field{"unit", kText, false},
    Field{"before", FieldType::Any},
    Field{"after", FieldType::Any},
};
inline constexpr Shape kDifference{"Difference", kDifferenceFields, "set"};
inline constexpr std::array kEffectFields{
    Field{"variant", kText, false},
    rows("differences", kDifference),
};
inline constexpr Shape kEffect{"PhysicsEffect", kEffectFields};
inline constexpr std::array kFileFields{
    Field{"file", kText},
    Field{"diff", kText, false, "null: it is no text"},
    Field{"keptLayout", kFlag},
};
inline constexpr Shape kFile{"EditedFile", kFileFields};
inline constexpr std::array kEditedFields{
    Field{"dryRun", kFlag},
    Field{"written", kFlag},
    rows("edits", kPlace, "where it went"),
    rows("physics", kEffect, "what engines receive otherwise"),
    rows("files", kFile, "that change"),
};
inline constexpr Shape kEdited{"Edited", kEditedFields};

// ---- tests of drives

inline constexpr std::array kTestedLimitFields{
    Field{"target", kNumber, true, "[rad, m]"},
    Field{"settlingTime", kNumber, false, "[s]"},
    Field{"maxHoldError", kNumber, false, "[rad, m]"},
};
inline constexpr Shape kTestedLimit{"", kTestedLimitFields, "tune --test"};
inline constexpr std::array kTestedStepFields{
    Field{"overshoot", kNumber, false, "as a part of the step"},
    Field{"riseTime", kNumber, false, "[s]"},
    Field{"settlingTime", kNumber, false, "[s]"},
};
inline constexpr Shape kTestedStep{"", kTestedStepFields, "tune --test"};
inline constexpr std::array kTestedSineFields{
    Field{"positionError", kNumber, false, "[rad, m]"},
    Field{"lag", kNumber, false, "[s]"},
    Field{"gain", kNumber, false},
};
inline constexpr Shape kTestedSine{"", kTestedSineFields, "tune --test"};
inline constexpr std::array kSignalFields{
    Field{"time", kNumbers, true, "[s]"},
    Field{"command", kNumbers, true, "[rad, m]"},
    list("position", kEachNumberOrNull, "[rad, m]"),
    list("velocity", kEachNumberOrNull, "[rad/s, m/s]"),
    list("effort", kEachNumberOrNull, "[N m, N]"),
};
inline constexpr Shape kSignal{"TestSignal", kSignalFields};
inline constexpr std::array kTestedDriveFields{
    Field{"joint", kPath},
    Field{"axis", kText},
    Field{"verdict", kText},
    list("reasons", kEachText),
    Field{"saturation", kNumber, false, "the part of the time at its most effort"},
    may_miss(rows("limits", kTestedLimit, "of `snap`")),
    may_miss(object("step", kTestedStep, true, "of `step`")),
    may_miss(object("sine", kTestedSine, true, "of `sine`")),
    may_miss(object("signal", kSignal, true, "of the notice `tested`")),
};
inline constexpr Shape kTested{"Tested", kTestedDriveFields, "tune --test"};

}  // namespace tenon::live
