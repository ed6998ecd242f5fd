// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/export_mjcf.h"

#if TENON_WITH_MUJOCO
#include "tenon/engines/mujoco/write_mjcf.h"
#endif

namespace tenon {

#if TENON_WITH_MUJOCO
Result<std::string> export_mjcf(const physics::PhysicsScene& scene, Diagnostics& diagnostics) {
  return engines::mujoco::write_mjcf(scene, {}, diagnostics);
}
#else
Result<std::string> export_mjcf(const physics::PhysicsScene&, Diagnostics&) {
  return Error(ErrorCode::Missing, "MJCF is written by MuJoCo, which this build is without")
      .with_fix("build with -DTENON_WITH_MUJOCO=ON");
}
#endif

}  // namespace tenon
