// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Answers of a worker that somebody else runs: bytes of good ones, changed at random. What can be
// decoded and passes the checks converts, or is an error; nothing else happens.
#include <random>

#include <gtest/gtest.h>

#include "tenon/base/wire.h"
#include "tenon/convert/convert_robot.h"
#include "tenon/guard/messages.h"
#include "tenon/mesh/check_scene.h"
#include "tenon/robot/check_model.h"

namespace tenon::convert {
namespace {

/// Two links, and of everything that refers to something one.
robot::RobotModel whole_model() {
  robot::RobotModel model;
  model.name = "robot";
  model.file = "robot.xml";
  model.links.resize(2);
  model.links[0].name = "base";
  model.links[1].name = "arm";
  model.links[1].inertial.emplace().mass = 1;
  model.links[1].inertial->inertia = Mat3d::identity();
  robot::MeshFile& mesh = model.meshes.emplace_back();
  mesh.written = "mesh";
  mesh.points = {{{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}}, {{0, 0, 1}}};
  mesh.triangles = {{{0, 2, 1}}, {{0, 1, 3}}, {{0, 3, 2}}, {{1, 2, 3}}};
  mesh.texture_coordinates.resize(12);
  model.materials.emplace_back().name = "red";
  model.materials[0].color = Vec4d{{1, 0, 0, 1}};
  model.contact_classes.resize(2);
  model.contact_classes[0].untouched = {1};
  model.contact_classes[1].untouched = {0};
  robot::Visual& visual = model.links[1].visuals.emplace_back();
  visual.geometry.kind = robot::GeometryKind::Mesh;
  visual.material = 0;
  robot::Collider& collider = model.links[1].colliders.emplace_back();
  collider.geometry.kind = robot::GeometryKind::Sphere;
  collider.geometry.radius = 1;
  collider.contact_class = 1;
  collider.mujoco.solref = {0.02, 1};
  collider.mujoco.solimp = {0.9, 0.95, 0.001, 0.5, 2};
  robot::Joint& joint = model.joints.emplace_back();
  joint.name = "elbow";
  joint.kind = robot::JointKind::Revolute;
  joint.child = 1;
  joint.limit = robot::Limit{-1, 1};
  joint.drive = robot::Drive{10, 1, 0};
  model.excluded_pairs = {{{0, 1}}};
  robot::LoopJoint& loop = model.loops.emplace_back();
  loop.links = {0, 1};
  robot::MujocoActuator& motor = model.mujoco.actuators.emplace_back();
  motor.name = "motor";
  motor.gain.resize(10);
  motor.bias.resize(10);
  motor.dynamics.resize(10);
  robot::MujocoTendon& tendon = model.mujoco.tendons.emplace_back();
  tendon.name = "string";
  tendon.joints = {0};
  tendon.coefficients = {1};
  robot::MujocoKeyframe& key = model.mujoco.keyframes.emplace_back();
  key.positions = {0};
  key.controls = {0};
  model.mujoco.scene.emplace();
  return model;
}

/// Answers of a type, each with one to four bytes changed; every third change is a small number,
/// which is where indices and kinds lie.
template <class T, class Use>
void change_answers(const T& value, int rounds, const Use& use) {
  guard::Answer<T> answer;
  answer.value = value;
  const std::string good = wire::encoded(answer);
  std::mt19937 random(7);
  int decoded = 0;
  for (int round = 0; round < rounds; ++round) {
    std::string bytes = good;
    for (unsigned i = 0; i <= random() % 4; ++i) {
      const auto number = random();
      bytes[random() % bytes.size()] =
          static_cast<char>(number % 3 == 0 ? number / 3 % 4 : number / 3 % 256);
    }
    std::optional<guard::Answer<T>> changed = wire::decoded<guard::Answer<T>>(bytes);
    if (changed && changed->value) {
      ++decoded;
      use(*std::move(changed->value));
    }
  }
  EXPECT_GT(decoded, rounds / 4);  // most bytes are numbers
}

TEST(HostileAnswer, OfARobotConvertsOrIsAnError) {
  const robot::RobotModel model = whole_model();
  ASSERT_TRUE(robot::check_model(model));
  int converted = 0;
  int refused = 0;
  change_answers(model, 3000, [&](robot::RobotModel changed) {
    for (robot::MeshFile& mesh : changed.meshes) {
      mesh.path.clear();  // files of this machine are no input
    }
    if (!robot::check_model(changed)) {
      ++refused;
      return;
    }
    Diagnostics findings;
    converted += convert_robot(std::move(changed), {}, findings) ? 1 : 0;
  });
  EXPECT_GT(converted, 1000);
  EXPECT_GT(refused, 50);
}

TEST(HostileAnswer, OfAMeshIsSoundOrAnError) {
  mesh::MeshScene scene;
  scene.appearances.resize(1);
  mesh::PolygonMesh& mesh = scene.meshes.emplace_back();
  mesh.points = {{{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}}};
  mesh.face_counts = {3, 3};
  mesh.face_points = {0, 1, 2, 2, 1, 0};
  mesh.normals.resize(6);
  mesh.texture_coordinates.resize(6);
  mesh.appearance = 0;
  ASSERT_TRUE(mesh::check_scene(scene, "m.dae"));
  int refused = 0;
  change_answers(scene, 3000, [&](const mesh::MeshScene& changed) {
    if (!mesh::check_scene(changed, "m.dae")) {
      ++refused;
      return;
    }
    for (const mesh::PolygonMesh& part : changed.meshes) {
      std::size_t corners = 0;
      for (const std::int32_t count : part.face_counts) {
        corners += static_cast<std::size_t>(count);
      }
      ASSERT_EQ(corners, part.face_points.size());
      for (const std::int32_t point : part.face_points) {
        ASSERT_LT(static_cast<std::size_t>(point), part.points.size());
      }
    }
  });
  EXPECT_GT(refused, 50);
}

}  // namespace
}  // namespace tenon::convert
