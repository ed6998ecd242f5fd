// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "tenon/engines/mujoco/test_scene.h"

namespace tenon::engines::mujoco {
namespace {

// Wedges that fall onto each other and onto a plane.
TestScene heap_of_wedges(int count) {
  TestScene scene;
  scene::TriangleMesh mesh;
  mesh.points = {{{-0.1, -0.05, 0}}, {{0.1, -0.05, 0}},    {{0.1, 0.05, 0}},
                 {{-0.1, 0.05, 0}},  {{0.1, -0.05, 0.08}}, {{0.1, 0.05, 0.08}}};
  scene.meshes.push_back(mesh);
  scene::Shape wedge;
  wedge.kind = scene::ShapeKind::ConvexHull;
  wedge.mesh = 0;
  for (int i = 0; i < count; ++i) {
    const auto body = scene.add_body("Wedge" + std::to_string(i),
                                     {{0.03 * (i % 3), 0.02 * (i % 2), 0.05 + 0.12 * i}}, 0.4,
                                     {{1e-3, 1e-3, 1e-3}});
    scene.add_collider("Shape" + std::to_string(i), body, wedge);
  }
  scene.add_collider("Ground", {}, ground());
  return scene;
}

TEST(BoxTests, ContactsAreThoseOfEveryPairTried) {
  const TestScene scene = heap_of_wedges(8);
  Diagnostics findings;
  Result<Model> boxes = build_model(scene, {}, findings);
  Result<Model> pairs = build_model(scene, {}, findings);
  ASSERT_TRUE(boxes.has_value() && pairs.has_value());
  const mjModel& m = *boxes->model;
  ASSERT_EQ(m.ngeom, 17);
  pairs->model->opt.disableflags |= mjDSBL_MIDPHASE;
  int most = 0;
  for (int step = 0; step < 1000; ++step) {
    mj_step(boxes->model.get(), boxes->data.get());
    mj_step(pairs->model.get(), pairs->data.get());
    ASSERT_EQ(boxes->data->ncon, pairs->data->ncon) << step;
    ASSERT_TRUE(std::equal(boxes->data->qpos, boxes->data->qpos + m.nq, pairs->data->qpos)) << step;
    most = std::max(most, boxes->data->ncon);
  }
  EXPECT_GT(most, 20);
}

TEST(BoxTests, TextForOthersHasNoMarks) {
  const TestScene scene = heap_of_wedges(2);
  Diagnostics findings;
  const Result<SpecAndModel> text = build_spec(scene, {}, findings, Begin::Start, Purpose::Text);
  ASSERT_TRUE(text.has_value());
  EXPECT_EQ(text->model.model->ngeom, 3);
}

}  // namespace
}  // namespace tenon::engines::mujoco
