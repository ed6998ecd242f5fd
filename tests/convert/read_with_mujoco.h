// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <string>

#include "tenon/engines/mujoco/model.h"

/// MuJoCo's own reading of a description, after `adjust` has had its specification; null with a
/// printed reason where MuJoCo refuses it.
template <class Adjust>
tenon::engines::mujoco::ModelPtr read_with_mujoco(const std::string& path, Adjust adjust) {
  char error[1000] = "";
  mjSpec* spec = mj_parseXML(path.c_str(), nullptr, error, sizeof(error));
  if (spec == nullptr) {
    std::printf("MuJoCo: %s\n", error);
    return nullptr;
  }
  adjust(*spec);
  tenon::engines::mujoco::ModelPtr model(mj_compile(spec, nullptr));
  if (model == nullptr) {
    std::printf("MuJoCo: %s\n", mjs_getError(spec));
  }
  mj_deleteSpec(spec);
  return model;
}
