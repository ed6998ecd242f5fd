// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Beside MuJoCo's own numbers, which the compiler has written into each model: tests do not stand
// in its way.
#include "tenon/engines/mujoco/set_up/inverse_weights.h"

#include <cmath>
#include <cstring>
#include <type_traits>
#include <vector>

#include <mujoco/mjxmacro.h>

#include "tenon/engines/mujoco/set_up/set_const_groups.h"
#include "tenon/engines/mujoco/test_scene.h"

namespace tenon::engines::mujoco {
namespace {

using scene::JointKind;

constexpr double kClose = 1e-12;

// Branches of all kinds of joints, one in four on a root that moves, far from the origin.
TestScene forest(int body_count) {
  TestScene scene;
  const JointKind kinds[] = {JointKind::Revolute, JointKind::Prismatic, JointKind::Spherical,
                             JointKind::Fixed, JointKind::Revolute};
  for (int i = 0; i < body_count; ++i) {
    const double x = i;
    const auto body =
        scene.add_body("Body" + std::to_string(i), {{100 + 0.1 * x, 0.02 * (i % 7), 50}},
                       0.3 + 0.1 * (i % 5), {{0.01 + 0.001 * (i % 3), 0.02, 0.015}});
    scene.bodies[body].center_of_mass = {{0.01 * (i % 4), 0.02, -0.01 * (i % 3)}};
    scene.add_collider("Shape" + std::to_string(i), body, sphere(0.02));
    if (i % 40 == 0) {
      continue;  // moves freely
    }
    const auto parent = static_cast<scene::Index>(i % 40 < 20 || i % 3 == 0 ? i - 1 : i - i % 40);
    scene::Joint& joint = scene.add_joint("Joint" + std::to_string(i), kinds[i % 5], parent, body,
                                          i % 2 == 0 ? scene::Axis::X : scene::Axis::Z);
    joint.frame0.position = scene.bodies[body].pose.position - scene.bodies[parent].pose.position;
    joint.armature = i % 6 == 0 ? 0.01 : 0;
    if (joint.kind == JointKind::Revolute && i % 2 == 0) {
      joint.drives.push_back(drive(scene::Dof::RotX, 10, 1));
    }
  }
  scene.add_collider("Ground", {}, ground());
  return scene;
}

double apart(double a, double b) { return std::abs(a - b) / std::max({std::abs(a), 1e-3}); }

/// The largest relative difference of two lists of numbers.
double apart(const std::vector<double>& one, const double* other) {
  double largest = 0;
  for (std::size_t i = 0; i < one.size(); ++i) {
    largest = std::max(largest, apart(one[i], other[i]));
  }
  return largest;
}

template <class T>
void compare(const char* name, const T* own, const T* ours, std::size_t count) {
  if constexpr (std::is_same_v<T, double>) {
    EXPECT_LT(apart({own, own + count}, ours), kClose) << name;
  } else if (count > 0) {
    EXPECT_EQ(std::memcmp(own, ours, count * sizeof(T)), 0) << name;
  }
}

// All arrays that MuJoCo lists.
void compare(const mjModel& own, const mjModel& ours){
#undef MJ_M
#define MJ_M(size) (own.size)
#define X(type, name, rows, columns) \
  compare(#name, own.name, ours.name, static_cast<std::size_t>(own.rows * (columns)));
    MJMODEL_POINTERS
#undef X
}

std::vector<double> taken(double* numbers, mjtSize count) {
  std::vector<double> copy(numbers, numbers + count);
  std::fill(numbers, numbers + count, -1.0);
  return copy;
}

/// As mj_setConst did before its calls were redirected.
void set_by_mujoco(mjModel& model, mjData* data) {
  const auto own =
      reinterpret_cast<decltype(&set_const_groups)>(find_mujoco_function("mj_setConstGroups"));
  own(&model, data, 1 | 2 | 4);
  own(&model, data, 8);
}

TEST(InverseWeights, TheCompilerCallsOurs) {
  Diagnostics findings;
  Result<Model> built = build_model(forest(800), {}, findings);
  ASSERT_TRUE(built.has_value());
  EXPECT_TRUE(sets_up_by_ours());
  mjModel& m = *built->model;
  mjData* data = mj_makeData(&m);
  set_by_mujoco(m, data);
  const std::vector<double> by_mujoco(m.dof_invweight0, m.dof_invweight0 + m.nv);
  mj_setConst(&m, data);
  // To the last bit they are the same by chance alone.
  EXPECT_NE(std::memcmp(by_mujoco.data(), m.dof_invweight0, by_mujoco.size() * sizeof(double)), 0);
  mj_deleteData(data);
}

TEST(InverseWeights, AreThoseOfMujocoOn500Bodies) {
  Diagnostics findings;
  const TestScene scene = forest(500);
  Result<Model> built = build_model(scene, {}, findings);
  ASSERT_TRUE(built.has_value()) << built.error().to_string();
  mjModel& m = *built->model;
  mjData* data = mj_makeData(&m);
  set_by_mujoco(m, data);  // the adapter changes some of these numbers
  ASSERT_GT(m.nv, 400);
  ASSERT_GT(m.nout, 10);
  const std::vector<double> mass = taken(m.dof_M0, m.nv);
  const std::vector<double> bodies = taken(m.body_invweight0, 2 * m.nbody);
  const std::vector<double> dofs = taken(m.dof_invweight0, m.nv);
  const std::vector<double> actuators = taken(m.actuator_acc0, m.nout);
  std::copy(m.qpos0, m.qpos0 + m.nq, data->qpos);
  mj_kinematics(&m, data);
  mj_comPos(&m, data);
  mj_transmission(&m, data);
  ASSERT_TRUE(set_inverse_weights(m, *data));
  EXPECT_LT(apart(mass, m.dof_M0), kClose);
  EXPECT_LT(apart(bodies, m.body_invweight0), kClose);
  EXPECT_LT(apart(dofs, m.dof_invweight0), kClose);
  EXPECT_LT(apart(actuators, m.actuator_acc0), kClose);
  mj_deleteData(data);
}

// Every number of the model, whichever function computed it.
TEST(InverseWeights, InTheCompilersPlaceTheModelIsTheSame) {
  Diagnostics findings;
  const TestScene scene = forest(800);
  Result<Model> built = build_model(scene, {}, findings);
  ASSERT_TRUE(built.has_value()) << built.error().to_string();
  mjModel& own = *built->model;
  mjData* data = mj_makeData(&own);
  set_by_mujoco(own, data);
  mjModel* ours = mj_copyModel(nullptr, &own);
  ASSERT_GT(own.nv, 600);
  taken(ours->body_invweight0, 2 * ours->nbody);
  taken(ours->dof_invweight0, ours->nv);
  taken(ours->dof_M0, ours->nv);
  set_const_groups(ours, data, 1 | 2 | 4);
  set_const_groups(ours, data, 8);
  EXPECT_NE(std::memcmp(own.dof_invweight0, ours->dof_invweight0,
                        static_cast<std::size_t>(own.nv) * sizeof(double)),
            0);  // it was not MuJoCo's own again
  compare(own, *ours);
  mj_deleteModel(ours);
  mj_deleteData(data);
}

TEST(InverseWeights, OfWhatIsNotDealtWithAreMujocosOwn) {
  Diagnostics findings;
  const TestScene scene = forest(60);
  Result<Model> built = build_model(scene, {}, findings);
  ASSERT_TRUE(built.has_value());
  mjModel& m = *built->model;
  ASSERT_GT(m.nactuator, 0);
  m.actuator_armature[0] = 0.1;
  EXPECT_FALSE(set_inverse_weights(m, *built->data));
}

}  // namespace
}  // namespace tenon::engines::mujoco
