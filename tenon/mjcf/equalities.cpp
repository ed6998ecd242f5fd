// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/mjcf/equalities.h"

#include <algorithm>

#include "tenon/engines/mujoco/model.h"
#include "tenon/engines/mujoco/soft_defaults.h"

namespace tenon::mjcf {

using engines::mujoco::kSolimp;
using engines::mujoco::kSolref;
using engines::mujoco::read_quaternion;
using engines::mujoco::read_vector;
using robot::JointKind;

namespace {

/// Where a connect or a weld takes hold of a body: at a site, else at an anchor of its own.
Pose frame_of_side(const mjModel& model, std::size_t equality, std::size_t side, int object) {
  if (model.eq_objtype[equality] == mjOBJ_SITE) {
    const auto site = static_cast<std::size_t>(object);
    return {read_vector(model.site_pos + 3 * site), read_quaternion(model.site_quat + 4 * site)};
  }
  const double* data = model.eq_data + mjNEQDATA * equality;
  Pose frame;
  if (model.eq_type[equality] == mjEQ_CONNECT) {
    frame.position = read_vector(data + 3 * side);
    return frame;
  }
  // The anchor in the second body comes first, and the first one's is turned.
  frame.position = read_vector(data + 3 * (1 - side));
  if (side == 0) {
    frame.orientation = read_quaternion(data + 6);
  }
  return frame;
}

/// Connects and welds hold two bodies, or two sites of bodies. None for other equalities.
std::optional<robot::LoopJoint> read_loop(const MjcfSource& source, const BodyTree& tree,
                                          int equality) {
  const mjModel& model = source.model();
  const auto at = static_cast<std::size_t>(equality);
  const int type = model.eq_type[at];
  if (type != mjEQ_CONNECT && type != mjEQ_WELD) {
    return std::nullopt;
  }
  robot::LoopJoint loop;
  loop.name = source.name(mjOBJ_EQUALITY, equality, type == mjEQ_WELD ? "weld" : "connect");
  loop.kind = type == mjEQ_WELD ? JointKind::Fixed : JointKind::Ball;
  const int objects[] = {model.eq_obj1id[at], model.eq_obj2id[at]};
  for (std::size_t side = 0; side < 2; ++side) {
    const int object = objects[side];
    const int body = model.eq_objtype[at] == mjOBJ_SITE ? model.site_bodyid[object] : object;
    loop.links[side] = tree.link_of_body[static_cast<std::size_t>(body)];
    loop.frames[side] = frame_of_side(model, at, side, object);
  }
  loop.torque_scale = type == mjEQ_WELD ? model.eq_data[mjNEQDATA * at + 10] : 1;
  const double* solref = model.eq_solref + mjNREF * at;
  if (!std::equal(kSolref.begin(), kSolref.end(), solref)) {
    loop.solref.assign(solref, solref + mjNREF);
  }
  const double* solimp = model.eq_solimp + mjNIMP * at;
  if (!std::equal(kSolimp.begin(), kSolimp.end(), solimp)) {
    loop.solimp.assign(solimp, solimp + mjNIMP);
  }
  return loop;
}

void read_equality(MjcfSource& source, const BodyTree& tree, int equality, Equalities& found) {
  const mjModel& model = source.model();
  const auto at = static_cast<std::size_t>(equality);
  const std::string name = source.name(mjOBJ_EQUALITY, equality, "equality");
  if (model.eq_active0[at] == 0) {
    source.left_out("the equality \"" + name + "\" is off; it is skipped",
                    source.line_of(mjOBJ_EQUALITY, equality));
    return;
  }
  if (std::optional<robot::LoopJoint> loop = read_loop(source, tree, equality)) {
    found.loops.push_back(std::move(*loop));
    return;
  }
  if (model.eq_type[at] != mjEQ_JOINT || model.eq_obj2id[at] < 0) {
    source.report(Severity::Error, "mjcf.left-out",
                  "the equality \"" + name +
                      "\" is neither a law of two joints nor holds two bodies; it is skipped",
                  source.line_of(mjOBJ_EQUALITY, equality));
    return;
  }
  // q1 - ref1 = a0 + a1 (q2 - ref2) + ...
  const auto follower = static_cast<std::size_t>(model.eq_obj1id[at]);
  const auto leader = static_cast<std::size_t>(model.eq_obj2id[at]);
  const double* data = model.eq_data + mjNEQDATA * at;
  found.mimics[tree.joint_of_joint[follower]] =
      robot::Mimic{tree.joint_of_joint[leader], data[1], data[0], {data[2], data[3], data[4]}, {}};
}

}  // namespace

Equalities read_equalities(MjcfSource& source, const BodyTree& tree) {
  Equalities found;
  found.mimics.resize(tree.joints.size());
  for (int i = 0; i < source.model().neq; ++i) {
    read_equality(source, tree, i, found);
  }
  return found;
}

void attach_mimics(const Equalities& equalities, std::vector<robot::Joint>& joints) {
  for (std::size_t i = 0; i < joints.size(); ++i) {
    joints[i].mimic = equalities.mimics[i];
  }
}

}  // namespace tenon::mjcf
