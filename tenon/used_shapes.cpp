// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/used_shapes.h"

#include "tenon/base/diagnostics.h"
#if TENON_WITH_JOLT
#include "tenon/engines/jolt/used_shapes.h"
#endif
#if TENON_WITH_MUJOCO
#include "tenon/engines/mujoco/overlap/penetrations.h"
#endif
#if TENON_WITH_PHYSX
#include "tenon/engines/physx/used_shapes.h"
#endif

namespace tenon {

Result<std::vector<engines::UsedShape>> used_shapes(const std::string& engine,
                                                    const scene::PhysicsScene& scene) {
#if TENON_WITH_MUJOCO
  if (engine == "mujoco") {
    Diagnostics findings;  // a shape that MuJoCo refuses is none in the answer
    TENON_TRY(engines::mujoco::Penetrations search,
              engines::mujoco::Penetrations::make(scene, engines::mujoco::StaticColliders::Included,
                                                  findings));
    return search.used_shapes(scene);
  }
#endif
#if TENON_WITH_PHYSX
  if (engine == "physx") {
    return engines::physx::used_shapes(scene);
  }
#endif
#if TENON_WITH_JOLT
  if (engine == "jolt") {
    return engines::jolt::used_shapes(scene);
  }
#endif
  static_cast<void>(scene);
  return Error(ErrorCode::Missing, "this build has no engine \"" + engine + "\"")
      .with_rule("engine.missing")
      .with_fix("choose an engine that it has");
}

}  // namespace tenon
