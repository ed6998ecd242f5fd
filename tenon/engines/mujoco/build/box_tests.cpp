// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/engines/mujoco/build/build.h"

namespace tenon::engines::mujoco {
namespace {

constexpr std::size_t kMostBodies = 2000;  // beyond these one more geom a body slows compiling down
constexpr double kSize = 1e-6;             // [m]

}  // namespace

void add_box_tests(Build& build) {
  if (build.purpose != Purpose::Run || build.bodies.size() > kMostBodies) {
    return;
  }
  for (mjsBody* body : build.bodies) {
    mjsElement* only = mjs_firstChild(body, mjOBJ_GEOM, 0);
    if (only == nullptr || mjs_asGeom(only)->type != mjGEOM_MESH ||
        mjs_nextChild(body, only, 0) != nullptr) {
      continue;
    }
    mjsGeom* mark = mjs_addGeom(body, nullptr);
    mark->type = mjGEOM_SPHERE;
    mark->size[0] = kSize;
    write_vector(mark->pos, read_vector(mjs_asGeom(only)->pos));
    mark->contype = 0;
    mark->conaffinity = 0;
    mark->group = 5;    // not shown
    mark->rgba[3] = 0;  // rays pass it
  }
}

}  // namespace tenon::engines::mujoco
