// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/view/make_view.h"

#include "tenon/view/drawn_shapes.h"

namespace tenon::view {

std::size_t ViewScene::drawn_triangles() const {
  std::size_t count = 0;
  for (const ViewShape& shape : shapes) {
    count += meshes[shape.mesh].triangle_count();
  }
  return count;
}

ViewScene make_view(const stage::Stage& stage, const scene::PhysicsScene& scene,
                    const ViewOptions& options) {
  ViewScene view;
  add_mechanism(scene, options.limits, view);
  add_drawn_shapes(stage, scene, options, view);
  if (options.colliders) {
    add_colliders(scene, options.limits, view);
  }
  return view;
}

}  // namespace tenon::view
