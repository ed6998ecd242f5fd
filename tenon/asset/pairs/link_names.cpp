// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/pairs/link_names.h"

#include <string_view>
#include <utility>
#include <vector>

#include "tenon/base/text/nearest_name.h"

namespace tenon {

Result<LinkNames> LinkNames::of(const scene::PhysicsScene& scene) {
  LinkNames names;
  for (const scene::Body& body : scene.bodies) {
    const auto [at, is_new] = names.bodies_.emplace(body.path.name().str(), body.path);
    if (!is_new) {
      return Error(ErrorCode::Invalid, "two bodies have the name \"" + at->first + "\", " +
                                           named(at->second, RelatedRole::Body) + " and " +
                                           named(body.path, RelatedRole::Body) +
                                           ", and links of SRDF are told apart by their names")
          .with_prim(body.path.str())
          .with_rule("pairs.same-name")
          .with_fix("give one of them another name: tenon rename ASSET " + body.path.str() +
                    " NAME");
    }
  }
  return names;
}

std::optional<Path> LinkNames::find(const std::string& name) const {
  const auto at = bodies_.find(name);
  return at == bodies_.end() ? std::nullopt : std::optional(at->second);
}

bool LinkNames::is_body(Path path) const {
  const auto at = bodies_.find(path.name().str());
  return at != bodies_.end() && at->second == path;
}

std::string LinkNames::advice(const std::string& name) const {
  constexpr std::size_t kMostNames = 10'000;
  constexpr std::size_t kLongest = 500;
  std::vector<std::string_view> names;
  for (const auto& [own, path] : bodies_) {
    if (names.size() < kMostNames && own.size() <= kLongest) {
      names.push_back(own);
    }
  }
  const std::string_view near =
      name.size() > kLongest ? std::string_view() : nearest_name(name, names);
  return near.empty() ? "links are found by the names of the bodies' prims, which tenon tree ASSET "
                        "--show physics lists"
                      : "did you mean \"" + std::string(near) + "\"?";
}

std::string srdf_reason(const BodyPair& pair) {
  if (pair.adjacent) {
    return "Adjacent";
  }
  if (pair.start_depth) {
    return "Default";
  }
  if (pair.often == PairClass::Always) {
    return "Always";
  }
  if (pair.often == PairClass::Often) {
    return "Often";
  }
  if (pair.often == PairClass::Never) {
    return "Never";
  }
  return pair.filtered == PairFiltered::Yes ? "User" : "";
}

}  // namespace tenon
