// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "tenon/base/path.h"
#include "tenon/layer/layer.h"

namespace tenon::convert {

/// What an asset says of its physics and its looks, as one number for each property ("radius",
/// "physics:mass") that changes with any of its values: by it a later run tells whether the asset
/// still says what its source did. Files and names of engines other than MuJoCo do not count, nor
/// does where a mesh stands among others that are the same.
using Seal = std::map<std::string, std::uint64_t>;

/// Gathers a seal, prim by prim in any order; of each the prim comes before its properties.
class SealMaker {
 public:
  /// `root` is the robot's prim, whose name does not count.
  explicit SealMaker(Path root) : root_(root) {}

  void add_prim(Path prim, Token type, const std::vector<Token>& apis);
  void add_value(Path prim, Token type, Token property, const layer::Value& value);
  void add_targets(Path prim, Token type, Token relationship, const std::vector<Path>& targets);
  Seal take();

 private:
  void add(Path prim, Token type, const std::string& key, const std::string& contents);

  Path root_;
  Seal seal_;
  std::map<std::string, std::set<std::uint64_t>> looks_;  // of materials, each once
  std::map<Path, std::uint64_t> look_sums_;  ///< of all that is said of looks at and below a path
  std::set<Path> bodies_;
  /// Which material counts by what it says, as its name and place may change.
  struct Binding {
    Path prim;
    Token type;
    Token relationship;
    Path target;
  };
  std::vector<Binding> bindings_;
};

/// Of the layer of a converted robot.
Seal seal_of(const layer::Layer& layer);

/// "property digest" for each.
std::vector<std::string> seal_words(const Seal& seal);

/// Properties that do not say what they did, sorted; where all of the words of an engine are
/// missing `now`, as they are under variants of other engines, they do not count.
std::vector<std::string> changed_since(const std::vector<std::string>& words, const Seal& now);

}  // namespace tenon::convert
