// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tenon/base/path.h"
#include "tenon/layer/layer.h"

namespace tenon::convert {

/// What an asset says of its physics and its looks, as one number for each property ("radius",
/// "physics:mass") that changes with any of its values: by it a later run tells whether the asset
/// still says what its source did. Files and names of engines other than MuJoCo do not count, nor
/// does where a mesh stands among others that are the same.
using Seal = std::map<std::string, std::uint64_t>;

/// One number of a seal in parts: what one prim says, as a number of its name and one of the value.
struct SealPart {
  Path prim;
  std::uint64_t digest = 0;  ///< the upper half of the name, the lower of name and value
};
/// Of the properties whose edits a model can take over one by one (`has_parts`), by property.
using SealParts = std::map<std::string, std::vector<SealPart>>;

/// A property whose seal is kept in parts too, so that an edit of it is known by its prim.
bool has_parts(std::string_view property);

/// Gathers a seal, prim by prim in any order; of each the prim comes before its properties.
class SealMaker {
 public:
  /// `root` is the robot's prim, whose name does not count.
  explicit SealMaker(Path root) : root_(root) {}

  void add_prim(Path prim, Token type, const std::vector<Token>& apis);
  void add_value(Path prim, Token type, Token property, const layer::Value& value);
  void add_targets(Path prim, Token type, Token relationship, const std::vector<Path>& targets);
  Seal take();
  SealParts take_parts() { return std::move(parts_); }

 private:
  void add(Path prim, Token type, const std::string& key, const std::string& contents);

  Path root_;
  Seal seal_;
  SealParts parts_;
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

/// Of the layer of a converted robot; its parts, too, where they are asked for.
Seal seal_of(const layer::Layer& layer, SealParts* parts = nullptr);

/// "property digest" for each.
std::vector<std::string> seal_words(const Seal& seal);

/// "property digest digest ..." for each, sorted digests.
std::vector<std::string> part_words(const SealParts& parts);

/// The prims whose parts are others `now` than they were, in the order of paths; nothing where it
/// cannot be told: the words have no such property, or a prim lost it.
std::optional<std::vector<Path>> edited_prims(const std::vector<std::string>& words,
                                              const std::string& property, const SealParts& now);

/// Properties that do not say what they did, sorted; where all of the words of an engine are
/// missing `now`, as they are under variants of other engines, they do not count.
std::vector<std::string> changed_since(const std::vector<std::string>& words, const Seal& now);

}  // namespace tenon::convert
