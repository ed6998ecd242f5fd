// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tenon/base/path.h"
#include "tenon/stage/stage.h"

namespace tenon::stage {

/// What depends on the name of a prim because it is composed of it: over arcs of prims above it, so
/// that it has the same name, or over an arc that names its path.
struct Dependents {
  /// A layer, by identifier, and a path in it without variant selections.
  using Site = std::pair<std::string, Path>;

  /// Where opinions on such prims stand or would stand.
  std::set<Site> sites;
  /// The prims as the stage names them, below instances too, whether they are there or not, and of
  /// `sites` those of each.
  std::map<Path, std::set<Site>> prims;
  /// References and payloads from other layer stacks that lead to the prim or below it.
  struct Arc {
    std::vector<std::string> layers;  ///< of the stack that has it, by identifier
    Path from;                        ///< prim with the arc, without variant selections
    std::string file;                 ///< root layer of the stack that it leads to
    Path to;
    Path prim;  ///< which `to` is or is below, in that stack
  };
  std::vector<Arc> arcs;
};

/// What of a prim they depend on.
enum class DependentOn : std::uint8_t {
  Name,        ///< of the prim
  Properties,  ///< their names, also where an arc leads to the prim itself; no `arcs`
};

/// The dependents of a prim with specs at `sites`: its path in each layer, by identifier, without
/// variant selections. These are not among them. What is relocated has a name of its own.
Dependents dependents_of(const Stage& stage, const std::map<std::string, Path>& sites,
                         DependentOn what = DependentOn::Name);

}  // namespace tenon::stage
