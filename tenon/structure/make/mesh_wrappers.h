// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <set>
#include <string>

#include "tenon/base/result.h"
#include "tenon/layer/layer.h"
#include "tenon/structure/layer_tree.h"

namespace tenon::structure {

/// In the structure each mesh stands alone below an Xform, its wrapper, which can be an instance.
/// A wrapper has this mesh and its materials below it, and no part in the simulation.
/// Which meshes of a content have none yet, and where they come.
class MeshMoves {
 public:
  /// Decided on all views of an asset laid over each other, so that all of them move alike.
  /// Errors: Invalid "structure.differs" where a mesh collides together with meshes below it
  /// (collider.submeshes), which are no longer there in the structure.
  static Result<MeshMoves> of(const layer::Layer& united);

  bool empty() const { return moves_.empty(); }
  /// Old place and new place of each mesh that moves.
  std::map<Path, Path> all() const;
  /// Where a prim or property of the content comes.
  Path moved(Path path) const;
  /// Where a target comes: of a mesh that is a body its wrapper is meant.
  Path moved_target(Path target) const;
  /// The content with its meshes in wrappers. These take the transforms, and of bodies all that is
  /// not about shape.
  layer::Layer apply(const layer::Layer& content) const;

 private:
  struct Move {
    Path wrapper;
    Path mesh;
    bool body = false;
    std::set<Path> subsets;  // of the mesh, which move along
  };

  void add(const layer::Layer& united, Path mesh, const std::string& name);
  void move_mesh(const layer::Layer& content, Path from, const Move& move, layer::Layer& to) const;

  std::map<Path, Move> moves_;
};

/// The scope or prim holds materials and nothing else.
bool holds_materials(const layer::Layer& content, Path prim);

/// The geometry of a mesh and its subsets alone, at `to`.
void copy_geometry(const layer::Layer& content, Path mesh, layer::Layer& target, Path to);

}  // namespace tenon::structure
