// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <set>
#include <string>

#include "tenon/scene/fields/scene_side.h"

/// A collision filter as words that do not depend on how its tables are numbered, so that two can
/// be compared. Internal to tenon/scene.
namespace tenon::scene {

/// "/A and /B" for each pair of colliders that filters keep apart; none where there are too many.
std::optional<std::set<std::string>> disabled_pair_words(const Side& side);
/// The same of pairs of sets; where there are too many, a word for each pair of sets.
std::set<std::string> set_pair_words(const Side& side, const SetPairs& off);
/// "/C in /Group", "/Group apart from /Other".
std::set<std::string> group_words(const Side& side);
/// "/A and /B by /Joint".
std::set<std::string> joint_pair_words(const Side& side);

}  // namespace tenon::scene
