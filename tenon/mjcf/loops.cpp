// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>

#include "tenon/engines/mujoco/model.h"
#include "tenon/mjcf/contact_defaults.h"
#include "tenon/mjcf/mjcf_reader.h"

namespace tenon::mjcf {

using engines::mujoco::read_quaternion;
using engines::mujoco::read_vector;
using robot::JointKind;

/// Connects and welds hold two bodies, or two sites of bodies. False for other equalities.
bool MjcfReader::read_loop(int equality) {
  const auto at = static_cast<std::size_t>(equality);
  const int type = model_.eq_type[at];
  if (type != mjEQ_CONNECT && type != mjEQ_WELD) {
    return false;
  }
  robot::LoopJoint loop;
  loop.name = unique_name(mjOBJ_EQUALITY, equality, type == mjEQ_WELD ? "weld" : "connect");
  loop.kind = type == mjEQ_WELD ? JointKind::Fixed : JointKind::Ball;
  const double* data = model_.eq_data + mjNEQDATA * at;
  const int objects[] = {model_.eq_obj1id[at], model_.eq_obj2id[at]};
  const bool sites = model_.eq_objtype[at] == mjOBJ_SITE;
  for (std::size_t side = 0; side < 2; ++side) {
    const auto object = static_cast<std::size_t>(objects[side]);
    const auto body = sites ? static_cast<std::size_t>(model_.site_bodyid[object]) : object;
    loop.links[side] = link_of_body_[body];
    if (sites) {
      loop.frames[side] = {read_vector(model_.site_pos + 3 * object),
                           read_quaternion(model_.site_quat + 4 * object)};
    } else if (type == mjEQ_CONNECT) {
      loop.frames[side].position = read_vector(data + 3 * side);
    } else {  // the anchor in the second body comes first, and the first one's is turned
      loop.frames[side].position = read_vector(data + 3 * (1 - side));
    }
  }
  if (type == mjEQ_WELD && !sites) {
    loop.frames[0].orientation = read_quaternion(data + 6);
  }
  loop.torque_scale = type == mjEQ_WELD ? data[10] : 1;
  const double* solref = model_.eq_solref + mjNREF * at;
  if (!std::equal(kSolref.begin(), kSolref.end(), solref)) {
    loop.solref.assign(solref, solref + mjNREF);
  }
  const double* solimp = model_.eq_solimp + mjNIMP * at;
  if (!std::equal(kSolimp.begin(), kSolimp.end(), solimp)) {
    loop.solimp.assign(solimp, solimp + mjNIMP);
  }
  robot_.loops.push_back(std::move(loop));
  return true;
}

}  // namespace tenon::mjcf
