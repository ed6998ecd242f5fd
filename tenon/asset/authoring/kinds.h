// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

/// What can be added to an asset and removed again, as one table: the commands, their help and
/// their tests use it. Names of types, schemas and properties are those of the schema tables, which
/// a test compares.
namespace tenon {

/// An option of one or more kinds.
struct AuthoringOption {
  std::string_view name;   ///< "mass": --mass
  std::string_view value;  ///< the word for its value: "NUMBER", "X,Y,Z", "PRIM"
  std::string_view unit;   ///< of numbers; empty where there is none
  std::string_view help;
};

/// An option as one kind takes it.
struct KindOption {
  std::string_view name;
  std::string_view property;  ///< that it sets, '*' for the instance of the kind's API schema;
                              ///< empty where the kind makes something else of it
};

struct AuthoringKind {
  std::string_view name;
  std::string_view about;
  std::string_view type = {};               ///< of the prim that it makes; empty: it is put on one
  std::vector<std::string_view> apis = {};  ///< '*' for the instance
  std::vector<KindOption> options = {};     ///< without those of places, which all that stand
                                            ///< somewhere take: takes_pose
  std::string_view on = {};                 ///< type of the prims that it is put on; empty: any
  bool rests = false;  ///< by itself it changes nothing that engines receive, and that is no fault
  std::vector<std::string_view> needs = {};      ///< options that have to be given
  std::vector<std::string_view> also_ends = {};  ///< schemas that other engines have for it

  bool makes_prim() const { return !type.empty(); }
  /// --at, --rotate and --scale.
  bool takes_pose() const;
  bool takes(std::string_view option) const;
  const KindOption* option(std::string_view name) const;
};

const std::vector<AuthoringKind>& authoring_kinds();
/// Null: no kind has that name.
const AuthoringKind* find_kind(std::string_view name);
std::vector<std::string> kind_names();

const std::vector<AuthoringOption>& authoring_options();

}  // namespace tenon
