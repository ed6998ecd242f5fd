// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tenon/scene/fields/scene_side.h"

/// A collision filter as words that do not depend on how its tables are numbered, so that two can
/// be compared. Internal to tenon/scene.
namespace tenon::scene {

/// "/A and /B" for each pair, by path.
std::set<std::string> pair_words(const Side& side,
                                 const std::vector<std::pair<Index, Index>>& pairs);
/// "/C in /Group", "/Group apart from /Other".
std::set<std::string> group_words(const Side& side);
/// "/A and /B by /Joint".
std::set<std::string> joint_pair_words(const Side& side);

}  // namespace tenon::scene
