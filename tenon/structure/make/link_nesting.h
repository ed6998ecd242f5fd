// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>

#include "tenon/base/diagnostics.h"
#include "tenon/base/path.h"
#include "tenon/layer/layer.h"
#include "tenon/scene/physics_scene.h"
#include "tenon/stage/stage.h"
#include "tenon/structure/make/make_package.h"
#include "tenon/structure/proof/proof.h"

namespace tenon::structure {

/// Puts the links of a robot, its rigid bodies, side by side or below the links that carry them by
/// joints. Other descendants of a link go with it; places in the world stay.
class LinkMoves {
 public:
  /// Decided on all views of an asset laid over each other, and on the physics that this is read
  /// as, so that all of them move alike: links go below their parents in its joint forest. No link
  /// moves where one of them could not stay what it is (Warning "structure.links-kept" says why):
  /// it is animated, has a start velocity, or would lose or win what prims above hand down.
  LinkMoves(const layer::Layer& united, const scene::PhysicsScene& scene, LinkNesting wanted,
            Diagnostics& diagnostics);

  bool empty() const { return places_.empty(); }
  /// Old place and new place of each link that moves.
  const std::map<Path, Path>& all() const { return places_; }
  /// Where a prim or property comes.
  Path moved(Path path) const;
  /// The content that `stage` composes to, with its links in their new places.
  layer::Layer apply(const layer::Layer& content, const stage::Stage& stage) const;
  /// The first prim that stands elsewhere in the world afterwards, or simulates otherwise.
  std::optional<Disagreement> compare(const layer::Layer& content, const stage::Stage& before,
                                      const stage::Stage& after) const;

 private:
  std::map<Path, Path> places_;
  std::map<Path, Path> parents_;  // old place of a link that moves -> old path of its new parent
};

}  // namespace tenon::structure
