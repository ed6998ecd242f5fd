// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <string>

#include "tenon/engines/mujoco/model.h"

namespace tenon {

/// MuJoCo's own reading of a description, after `adjust` has had its specification; null with a
/// printed reason where MuJoCo refuses it.
template <class Adjust>
engines::mujoco::ModelPtr read_with_mujoco(const std::string& path, Adjust adjust) {
  if (const Result<void> opened = engines::mujoco::open_mujoco(); !opened) {
    std::printf("%s\n", opened.error().message().c_str());
    return nullptr;
  }
  char error[1000] = "";
  const auto parse_xml = reinterpret_cast<decltype(&::mj_parseXML)>(
      engines::mujoco::find_mujoco_function("mj_parseXML"));
  mjSpec* spec = parse_xml(path.c_str(), nullptr, error, sizeof(error));
  if (spec == nullptr) {
    std::printf("MuJoCo: %s\n", error);
    return nullptr;
  }
  adjust(*spec);
  engines::mujoco::ModelPtr model(mj_compile(spec, nullptr));
  if (model == nullptr) {
    std::printf("MuJoCo: %s\n", mjs_getError(spec));
  }
  mj_deleteSpec(spec);
  return model;
}

}  // namespace tenon
