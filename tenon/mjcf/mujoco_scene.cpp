// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/mjcf/mujoco_scene.h"

#include <algorithm>

#include "tenon/engines/mujoco/build/option_fields.h"

namespace tenon::mjcf {

robot::MujocoScene read_scene(MjcfSource& source) {
  const mjOption& options = source.model().opt;
  robot::MujocoScene scene;
  std::copy_n(options.gravity, 3, scene.gravity.begin());
  scene.time_step = options.timestep;
  std::vector<std::string> unnamed;
  for (const auto& setting : engines::mujoco::settings_of(options, unnamed)) {
    scene.settings.push_back({setting.name, setting.numbers, setting.token});
  }
  for (const std::string& option : unnamed) {
    source.left_out("of the options, " + option + " has no name in MuJoCo's schema");
  }
  return scene;
}

}  // namespace tenon::mjcf
