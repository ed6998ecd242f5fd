// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/answers/json.h"
#include "tenon/asset/comparing_engines/compare_engines.h"

/// A comparison of engines for programs and for people.
namespace tenon {

/// {"duration" [s], "framesPerSecond", "engines": [{"name", "engine", "engineVersion", "variant",
/// "timeStep" [s], "steps", "time" [s], "failure", "energy": {"start", "end"} [J], "meanContacts",
/// "deepest" [m], "notMapped": [{"prim", "property", "why"}], "secondsPerStep" (with `timing`)}],
/// "pairs": [{"first", "second", "gaps": [{"metric", "unit", "object", "largest", "time" [s],
/// "mean", "firstValue", "secondValue"}], "distance" [m], "until" [s], "reasons": [{"kind",
/// "engine", "what", "property", "objects", "share"}], "noMatter", "untried", "together"}] (from
/// "distance" on where reasons were looked for), "exceeded": [{"metric", "bound", "unit"}]}. SI.
answers::Json compared_engines_json(const ComparedEngines& compared, bool timing);

/// Every gap as a row: first, second, metric, unit, object, largest, time, mean.
std::string compared_engines_csv(const ComparedEngines& compared);

/// One file for browsers, which asks for no other: tables, reasons and a plot of each metric.
std::string compared_engines_html(const std::string& asset, const ComparedEngines& compared,
                                  bool timing);

/// The same without the frame of a page, to be embedded in another one.
std::string compared_engines_part(const ComparedEngines& compared, bool timing);

}  // namespace tenon
