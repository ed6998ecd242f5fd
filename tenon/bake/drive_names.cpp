// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/bake/drive_names.h"

#include <algorithm>

namespace tenon::bake {

std::string part_label(std::size_t k, std::size_t count) {
  return count == 1 ? "" : "." + std::to_string(k);
}

std::string drive_label(const scene::Joint& joint, std::size_t k) {
  const scene::Dof dof = joint.drives[k].dof;
  const auto same = std::count_if(joint.drives.begin(), joint.drives.end(),
                                  [&](const scene::Drive& drive) { return drive.dof == dof; });
  if (joint.drives.size() > 1 && same == 1) {
    return "." + std::string(scene::dof_name(dof));
  }
  return part_label(k, joint.drives.size());
}

}  // namespace tenon::bake
