// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/formats/text/words.h"

#include <algorithm>
#include <array>

namespace tenon::formats::text {
namespace {

constexpr auto kReserved = std::to_array<std::string_view>({
    "AnimationBlock",
    "None",
    "add",
    "append",
    "bezier",
    "class",
    "config",
    "connect",
    "curve",
    "custom",
    "customData",
    "def",
    "default",
    "delete",
    "dictionary",
    "displayUnit",
    "doc",
    "held",
    "hermite",
    "inherits",
    "kind",
    "linear",
    "loop",
    "nameChildren",
    "none",
    "offset",
    "oscillate",
    "over",
    "payload",
    "permission",
    "post",
    "pre",
    "prefixSubstitutions",
    "prepend",
    "properties",
    "references",
    "rel",
    "relocates",
    "reorder",
    "repeat",
    "reset",
    "rootPrims",
    "scale",
    "sloped",
    "specializes",
    "spline",
    "subLayers",
    "suffixSubstitutions",
    "symmetryArguments",
    "symmetryFunction",
    "timeSamples",
    "uniform",
    "variantSet",
    "variantSets",
    "variants",
    "varying",
});
static_assert(std::is_sorted(kReserved.begin(), kReserved.end()));

constexpr auto kUnits = std::to_array<std::string_view>({
    "cm",
    "deg",
    "dm",
    "ft",
    "in",
    "km",
    "m",
    "mi",
    "mm",
    "rad",
    "yd",
});

}  // namespace

bool is_reserved_word(std::string_view word) {
  return std::binary_search(kReserved.begin(), kReserved.end(), word);
}

bool is_unit_name(std::string_view word) {
  return std::find(kUnits.begin(), kUnits.end(), word) != kUnits.end();
}

}  // namespace tenon::formats::text
