// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/answers/explained_stage.h"

#include <string>

#include "tenon/asset/explain_asset.h"
#include "tenon/asset/physics_options.h"
#include "tenon/physics/read_physics.h"

namespace tenon {

answers::Explained explained_stage(const stage::Stage& stage, const physics::Readings& readings,
                                   Diagnostics& diagnostics) {
  answers::Explained explained{stage, {}, {}};
  explained.scene =
      physics::read_physics(stage, read_options(readings), diagnostics, &explained.provenance);
  return explained;
}

Result<std::string> explain(const stage::Stage& stage, const std::string& object,
                            const std::string& other, const physics::Readings& readings,
                            Diagnostics& diagnostics) {
  TENON_CHECK(answers::check_object(stage, object));
  const answers::Explained explained = explained_stage(stage, readings, diagnostics);
  TENON_TRY(const answers::Json answer, answers::explain_object(explained, object, other));
  return answers::printed(answer);
}

}  // namespace tenon
