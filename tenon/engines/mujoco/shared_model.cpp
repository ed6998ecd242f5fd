// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/engines/mujoco/model.h"

namespace tenon::engines::mujoco {

mjModel& own_model(Model& model) {
  if (model.shared) {
    model.model = SharedModel(mj_copyModel(nullptr, model.model.get()), ModelDeleter());
    model.shared = false;
  }
  return *model.model;
}

Model share_model(const ModelMaps& maps, const SharedModel& model) {
  Model result;
  static_cast<ModelMaps&>(result) = maps;
  result.model = model;
  result.shared = true;
  return result;
}

}  // namespace tenon::engines::mujoco
