// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <unordered_map>
#include <utility>
#include <vector>

#include "tenon/base/path.h"
#include "tenon/stage/relationship.h"

namespace tenon::stage {

/// What Relationship::targets() answers, for many relationships of one stage that does not change
/// meanwhile: what those of a prototype target is composed once for all of its instances.
class TargetMemo {
 public:
  std::vector<Path> targets(const Relationship& relationship);

 private:
  struct Key {
    const PrimData* prim = nullptr;
    Token name;
    bool operator==(const Key&) const = default;
  };
  struct KeyHash {
    std::size_t operator()(const Key& key) const noexcept;
  };

  std::unordered_map<Key, std::vector<Path>, KeyHash> composed_;  // where the prototype came from
  // How the prims of one parent, the last that was asked about, see those places.
  Path parent_;
  std::vector<std::pair<Path, Path>> sources_;
};

}  // namespace tenon::stage
