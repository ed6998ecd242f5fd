// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace tenon::stage {

/// What becomes of an opinion about a value or a field.
enum class OpinionRole : unsigned char {
  Wins,      ///< gives the value, or says that there is none (a block)
  Combined,  ///< has a part in it beside the one that wins
  Loses,
  Declares,  ///< a spec without an opinion on it
};

/// Why an opinion has its role.
enum class OpinionReason : unsigned char {
  None,
  EditsArray,        ///< Combined: an edit of the array that weaker opinions give
  MovedTowards,      ///< Combined: part of the value at the next sample, which is interpolated to
  PutIn,             ///< Combined: the value of `%_` in a stronger path expression
  HidesWeaker,       ///< Combined: a block below edits, which lets the schema's fallback through
  BlocksAnimation,   ///< Combined: hides weaker samples and splines, not weaker defaults
  EditsList,         ///< Combined: an edit of the list that weaker opinions give
  MergesKeys,        ///< Combined: a dictionary or selections, joined key by key with weaker ones
  ReplacesList,      ///< Wins: a whole list, where edits could stand
  Weaker,            ///< Loses: `decided_by` is stronger
  ListReplaced,      ///< Loses: `decided_by` replaces the whole list
  Blocked,           ///< Loses: `decided_by` is a stronger block
  AnimationBlocked,  ///< Loses: `decided_by` is a stronger animation block
  DefaultTime,       ///< Loses: samples, splines and clips say nothing about the default time
  OtherType,         ///< Loses: an edit of an array of another type than `decided_by` edits
  Empty,             ///< Loses: samples without a sample, a spline without a knot
};

}  // namespace tenon::stage
