// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "tenon/engines/mujoco/build/surfaces.h"
#include "tenon/engines/mujoco/test_scene.h"
#include "tenon/scene/filter_sets.h"

namespace tenon::engines::mujoco {
namespace {

scene::Index add_material(TestScene& scene, const std::string& name, double friction,
                          double restitution = 0) {
  scene::Material material;
  material.path = named(name);
  material.static_friction = friction;
  material.dynamic_friction = friction;
  material.restitution = restitution;
  scene.materials.push_back(material);
  return static_cast<scene::Index>(scene.materials.size() - 1);
}

// A flat box on the ground plane.
TestScene box_on_ground(double height = 0.1) {
  TestScene scene;
  const auto body = scene.add_body("Box", {{0, 0, height}}, 2, {{0.03, 0.03, 0.05}});
  scene.add_collider("BoxShape", body, box({{0.2, 0.2, 0.1}}));
  scene.add_collider("Ground", {}, ground());
  return scene;
}

TEST(Contacts, BoxRestsOnThePlane) {
  TestScene scene = box_on_ground(0.3);
  auto sim = simulation(scene);
  run(*sim, 2);
  EXPECT_NEAR(sim->body_state(0).pose.position[2], 0.1, 1e-3);
  EXPECT_LT(length(sim->body_state(0).linear_velocity), 1e-3);
  EXPECT_EQ(sim->contact_count(), 4u);
}

TEST(Contacts, SlidingBoxStopsAfterItsWay) {
  TestScene scene = box_on_ground();
  scene.bodies[0].linear_velocity = {{5, 0, 0}};
  auto sim = simulation(scene);
  run(*sim, 2);
  // E-81, no material: mu = 0.5, way = v^2 / (2 mu g) = 2.548 m.
  EXPECT_NEAR(sim->body_state(0).pose.position[0], 25 / (2 * 0.5 * kG), 0.03);
}

struct InclineCase {
  double degrees;
  bool slides;
};

TEST(Contacts, FrictionHoldsUpToItsAngle) {
  for (const InclineCase& c : {InclineCase{20, false}, InclineCase{35, true}}) {
    TestScene scene = box_on_ground();
    const double slope = c.degrees * M_PI / 180;
    scene.scenes[0].gravity = {{kG * std::sin(slope), 0, -kG * std::cos(slope)}};
    auto sim = simulation(scene);
    run(*sim, 1);
    // E-82: mu = 0.5 holds below atan(0.5) = 26.6 degrees, above a = g (sin - mu cos).
    const double expected = c.slides ? kG * (std::sin(slope) - 0.5 * std::cos(slope)) / 2 : 0.0;
    EXPECT_NEAR(sim->body_state(0).pose.position[0], expected, 0.02 * expected + 1e-3) << c.degrees;
  }
}

// A slider on a spring that steps of MuJoCo's integrator discrete alone take, far from the rest.
void add_stiff_slider(TestScene& scene) {
  const auto body = scene.add_body("Slider", {{50, 0, 5}}, 1);
  scene::Joint& joint =
      scene.add_joint("Rail", scene::JointKind::Prismatic, {}, body, scene::Axis::X);
  joint.frame0.position = {{50, 0, 5}};
  joint.stiffness = 1e7;
  joint.spring_reference = 0.1;
  joint.damping = 100;
}

// Friction of MuJoCo's cones that brakes hard lifts what slides: as hard as contacts by 30 mm here.
TEST(Contacts, WhatSlidesFastStaysDownAndLevel) {
  for (const bool discrete : {false, true}) {
    TestScene scene = box_on_ground(0.05);
    scene.colliders[0].shape = box({{0.2, 0.2, 0.05}});
    scene.scenes[0].gravity = {{kG * std::sqrt(0.5), 0, -kG * std::sqrt(0.5)}};
    if (discrete) {
      add_stiff_slider(scene);
    }
    auto sim = simulation(scene);
    ASSERT_EQ(sim->engine_model().opt.integrator == mjINT_DISCRETE, discrete);
    double highest = 0;
    double turning = 0;
    for (int i = 0; i < 400; ++i) {
      ASSERT_TRUE(sim->step().has_value());
      const BodyState state = sim->body_state(0);
      highest = std::max(highest, state.pose.position[2] - 0.05);
      turning = std::max(turning, length(state.angular_velocity));
    }
    EXPECT_LT(highest, 1e-3);
    EXPECT_LT(turning, 1);
    const double way = kG * std::sqrt(0.5) * (1 - 0.5) * 0.8 * 0.8 / 2;
    EXPECT_NEAR(sim->body_state(0).pose.position[0], way, 0.005 * way);
  }
}

TEST(Contacts, FrictionOfAPairIsTheAverage) {
  TestScene scene = box_on_ground();
  scene.colliders[0].material = add_material(scene, "Ice", 0.0);
  scene.colliders[1].material = add_material(scene, "Rubber", 0.8);
  scene.bodies[0].linear_velocity = {{3, 0, 0}};
  auto sim = simulation(scene);
  run(*sim, 2);
  // S-72: mu = 0.4; way = v^2 / (2 mu g).
  EXPECT_NEAR(sim->body_state(0).pose.position[0], 9 / (2 * 0.4 * kG), 0.03);
}

struct BounceCase {
  double restitution;
  double tolerance;  // of the apex [m]
};

TEST(Contacts, BallReboundsWithItsRestitution) {
  for (const BounceCase& c :
       {BounceCase{0.2, 0.01}, BounceCase{0.5, 0.02}, BounceCase{0.8, 0.03}}) {
    TestScene scene;
    const auto ball = scene.add_body("Ball", {{0, 0, 1.1}}, 1, {{0.004, 0.004, 0.004}});
    scene.add_collider("BallShape", ball, sphere(0.1));
    scene.add_collider("Ground", {}, ground());
    const auto material = add_material(scene, "Rubber", 0.5, c.restitution);
    scene.colliders[0].material = scene.colliders[1].material = material;
    auto sim = simulation(scene);
    run(*sim, 0.46);
    double apex = 0;
    for (int i = 0; i < 500; ++i) {
      ASSERT_TRUE(sim->step().has_value());
      apex = std::max(apex, sim->body_state(ball).pose.position[2] - 0.1);
    }
    // A fall of h = 1 m rebounds to e^2 h.
    EXPECT_NEAR(apex, c.restitution * c.restitution, c.tolerance) << c.restitution;
    EXPECT_TRUE(mentions(sim->not_mapped(), "/Rubber", "physics:restitution"));
  }
}

TEST(Contacts, TwoFrictionsOfOneMaterialAreReported) {
  TestScene scene = box_on_ground();
  const auto material = add_material(scene, "Odd", 0.3);
  scene.materials[material].static_friction = 0.6;
  scene.colliders[0].material = material;
  auto sim = simulation(scene);
  EXPECT_TRUE(mentions(sim->not_mapped(), "/Odd", "physics:staticFriction"));
}

struct ShapeCase {
  const char* name;
  scene::ShapeKind kind;
  scene::Axis axis;
  Vec3d size;     // half extents, or radius and half height
  double height;  // centre above the ground at rest
};

TEST(Contacts, EveryShapeRestsAtItsHeight) {
  using scene::Axis;
  using scene::ShapeKind;
  const ShapeCase cases[] = {
      {"box", ShapeKind::Box, Axis::Z, {{0.2, 0.2, 0.1}}, 0.1},
      {"sphere", ShapeKind::Sphere, Axis::Z, {{0.1, 0, 0}}, 0.1},
      {"ellipsoid", ShapeKind::Ellipsoid, Axis::Z, {{0.2, 0.2, 0.1}}, 0.1},
      {"capsule", ShapeKind::Capsule, Axis::X, {{0.1, 0.2, 0}}, 0.1},
      {"cylinder", ShapeKind::Cylinder, Axis::Z, {{0.2, 0.1, 0}}, 0.1},
      {"cylinder on its side", ShapeKind::Cylinder, Axis::Y, {{0.1, 0.2, 0}}, 0.1},
      {"cone", ShapeKind::Cone, Axis::Z, {{0.2, 0.1, 0}}, 0.1},
  };
  for (const ShapeCase& c : cases) {
    TestScene scene;
    const auto body = scene.add_body("Body", {{0, 0, 0.15}}, 1, {{0.01, 0.01, 0.01}});
    scene::Shape shape;
    shape.kind = c.kind;
    shape.axis = c.axis;
    shape.half_extents = c.size;
    shape.radius = c.size[0];
    shape.half_height = c.size[1];
    scene.add_collider("Shape", body, shape);
    scene.add_collider("Ground", {}, ground());
    auto sim = simulation(scene);
    run(*sim, 1.5);
    EXPECT_NEAR(sim->body_state(body).pose.position[2], c.height, 2e-3) << c.name;
    EXPECT_EQ(mentions(sim->not_mapped(), "/Shape", "radius"), c.kind == ShapeKind::Cone) << c.name;
  }
}

// A 2 m quad in the plane z = 0.
scene::TriangleMesh quad() {
  scene::TriangleMesh mesh;
  mesh.points = {{{-1, -1, 0}}, {{1, -1, 0}}, {{1, 1, 0}}, {{-1, 1, 0}}};
  mesh.triangles = {{{0, 1, 2}}, {{0, 2, 3}}};
  mesh.flat = true;
  return mesh;
}

TEST(Contacts, SphereRestsOnAFlatQuadAtItsRadius) {
  for (const scene::ShapeKind kind : {scene::ShapeKind::ConvexHull, scene::ShapeKind::Mesh}) {
    TestScene scene;
    const auto ball = scene.add_body("Ball", {{0.3, 0.1, 0.5}}, 1, {{0.004, 0.004, 0.004}});
    scene.add_collider("BallShape", ball, sphere(0.1));
    scene.meshes.push_back(quad());
    scene::Shape shape;
    shape.kind = kind;
    scene.add_collider("Quad", {}, shape);
    auto sim = simulation(scene);
    run(*sim, 2);
    EXPECT_NEAR(sim->body_state(ball).pose.position[2], 0.1, 1e-3);  // E-54, S-65
    EXPECT_TRUE(mentions(sim->not_mapped(), "/Quad", "physics:approximation"));
  }
}

TEST(Contacts, BallLiesInAnOpenTrough) {
  TestScene scene;
  const auto ball = scene.add_body("Ball", {{0.2, 0, 0.6}}, 1, {{0.004, 0.004, 0.004}});
  scene.bodies[ball].linear_damping = 2;
  scene.add_collider("BallShape", ball, sphere(0.1));
  scene::TriangleMesh mesh;  // two slopes of 45 degrees that meet in the line x = z = 0
  mesh.points = {{{-1, -1, 1}}, {{0, -1, 0}}, {{1, -1, 1}}, {{-1, 1, 1}}, {{0, 1, 0}}, {{1, 1, 1}}};
  mesh.triangles = {{{0, 1, 4}}, {{0, 4, 3}}, {{1, 2, 5}}, {{1, 5, 4}}};
  scene.meshes.push_back(mesh);
  scene::Shape shape;
  shape.kind = scene::ShapeKind::Mesh;
  scene.add_collider("Trough", {}, shape);
  auto sim = simulation(scene);
  run(*sim, 5);
  // Touching both slopes the centre is r sqrt(2) above the line; a hull would be full.
  EXPECT_NEAR(sim->body_state(ball).pose.position[2], 0.1 * std::sqrt(2), 3e-3);
  EXPECT_NEAR(sim->body_state(ball).pose.position[0], 0, 1e-2);
}

TEST(Contacts, MovingTriangleMeshIsReportedAsHull) {
  TestScene scene;
  const auto body = scene.add_body("Body", {{0, 0, 1}});
  scene::TriangleMesh mesh;
  mesh.points = {{{0, 0, 0}}, {{0.2, 0, 0}}, {{0, 0.2, 0}}, {{0, 0, 0.2}}};
  mesh.triangles = {{{0, 2, 1}}, {{0, 1, 3}}, {{0, 3, 2}}, {{1, 2, 3}}};
  scene.meshes.push_back(mesh);
  scene::Shape shape;
  shape.kind = scene::ShapeKind::Mesh;
  scene.add_collider("Shape", body, shape);
  scene.add_collider("Ground", {}, ground());
  auto sim = simulation(scene);
  run(*sim, 2);
  EXPECT_TRUE(mentions(sim->not_mapped(), "/Shape", "physics:approximation"));
  EXPECT_GT(sim->body_state(body).pose.position[2], -0.01);
}

TEST(Contacts, OverlapAtTheStartIsReportedAndLeftGently) {
  TestScene scene(0);
  const auto a = scene.add_body("A", {{0, 0, 0}});
  const auto b = scene.add_body("B", {{0.19, 0, 0}});
  scene.add_collider("ShapeA", a, sphere(0.1));
  scene.add_collider("ShapeB", b, sphere(0.1));
  Diagnostics findings;
  auto sim = simulation(scene, 0.002, &findings);
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings.items()[0].rule, "collider.overlap-at-start");
  EXPECT_EQ(findings.items()[0].prim, "/ShapeA");
  for (int i = 0; i < 500; ++i) {
    ASSERT_TRUE(sim->step().has_value());
    ASSERT_LT(length(sim->body_state(b).linear_velocity), 0.5);
  }
}

TEST(Contacts, CombineModesOfMaterialsDecideFriction) {
  using scene::CombineMode;
  struct Case {
    CombineMode ground;
    double friction;  // of 0.5 on the box, averaging, and 0.1 on the ground
  };
  for (const Case& c : {Case{CombineMode::Average, 0.3}, Case{CombineMode::Min, 0.1},
                        Case{CombineMode::Multiply, 0.05}, Case{CombineMode::Max, 0.5}}) {
    TestScene scene = box_on_ground();
    scene.colliders[0].material = add_material(scene, "Rough", 0.5);
    scene.colliders[1].material = add_material(scene, "Smooth", 0.1);
    scene.materials[1].friction_combine = c.ground;
    scene.bodies[0].linear_velocity = {{2, 0, 0}};
    auto sim = simulation(scene);
    run(*sim, 0.3);
    // S-72: v = v0 - mu g t; the box rocks a little on its edges.
    EXPECT_NEAR(sim->body_state(0).linear_velocity[0], 2 - c.friction * kG * 0.3, 0.06);
  }
}

TEST(Contacts, CombineModesCountBetweenLikeSurfacesToo) {
  using scene::CombineMode;
  for (const bool alone : {true, false}) {  // with and without a third surface somewhere
    for (const auto& [mode, friction] :
         {std::pair(CombineMode::Average, 0.4), std::pair(CombineMode::Multiply, 0.16)}) {
      TestScene scene = box_on_ground();
      scene.colliders[0].material = scene.colliders[1].material = add_material(scene, "Wood", 0.4);
      scene.materials[0].friction_combine = mode;
      if (!alone) {
        const auto far = scene.add_body("Far", {{50, 0, 1}}, 1);
        scene.colliders[scene.add_collider("FarBox", far, box({{0.1, 0.1, 0.1}}))].material =
            add_material(scene, "Steel", 0.2);
      }
      scene.bodies[0].linear_velocity = {{2, 0, 0}};
      auto sim = simulation(scene);
      run(*sim, 0.3);
      EXPECT_NEAR(sim->body_state(0).linear_velocity[0], 2 - friction * kG * 0.3, 0.06) << alone;
    }
  }
}

TEST(Contacts, EachOfManyMaterialsMayBeItsOwn) {
  TestScene scene = box_on_ground();
  constexpr scene::Index kMany = 3000;
  for (scene::Index i = 0; i < kMany; ++i) {
    const auto number = std::to_string(i);
    const auto made = scene.add_collider("Far" + number, std::nullopt, box({{0.1, 0.1, 0.1}}));
    scene.colliders[made].pose.position = {{10.0 + i, 0, 0}};
    scene.colliders[made].material = add_material(scene, ("M" + number).c_str(), 0.5);
    scene.materials.back().restitution = (i + 1.0) / kMany;
  }
  scene.bodies[0].linear_velocity = {{2, 0, 0}};
  auto sim = simulation(scene);
  run(*sim, 0.01);
  EXPECT_GT(sim->body_state(0).linear_velocity[0], 0);
}

// A flat slab of 4 m by 8 m, its half with y > 0 of another material.
scene::TriangleMesh slab_of_two() {
  scene::TriangleMesh slab;
  slab.points = {{{-2, -4, 0}}, {{2, -4, 0}}, {{-2, 0, 0}}, {{2, 0, 0}}, {{-2, 4, 0}}, {{2, 4, 0}}};
  slab.triangles = {{{0, 1, 3}}, {{0, 3, 2}}, {{2, 3, 5}}, {{2, 5, 4}}};
  slab.flat = true;
  return slab;
}

TEST(Contacts, FacesOfAMeshHaveMaterialsOfTheirOwn) {
  for (const double side : {-2.0, 2.0}) {
    TestScene scene;
    const auto body = scene.add_body("Box", {{0, side, 0.1}}, 2, {{0.03, 0.03, 0.05}});
    scene.add_collider("BoxShape", body, box({{0.2, 0.2, 0.1}}));
    scene.meshes.push_back(slab_of_two());
    scene::Shape mesh;
    mesh.kind = scene::ShapeKind::Mesh;
    scene.add_collider("Slab", {}, mesh);
    scene.colliders[0].material = add_material(scene, "Wood", 0.5);
    scene.colliders[1].material = add_material(scene, "Tar", 1.1);
    scene.colliders[1].face_materials = {{named("Ice"), add_material(scene, "Ice", 0.1), {2, 3}}};
    scene.bodies[0].linear_velocity = {{1.5, 0, 0}};
    auto sim = simulation(scene);
    run(*sim, 0.06);  // until it lies still on the slab
    const double before = sim->body_state(0).linear_velocity[0];
    run(*sim, 0.08);
    // E-79: averages 0.8 on tar and 0.3 on ice.
    const double friction = side < 0 ? 0.8 : 0.3;
    EXPECT_NEAR(before - sim->body_state(0).linear_velocity[0], friction * kG * 0.08, 0.03) << side;
    EXPECT_FALSE(mentions(sim->not_mapped(), "/Ice", "material:binding"));
  }
}

TEST(Contacts, PiecesOfAMeshLeaveItsHollowOpen) {
  TestScene scene;
  const auto body = scene.add_body("Ball", {{0, 0, 1}}, 1, {{0.004, 0.004, 0.004}});
  scene.add_collider("BallShape", body, sphere(0.1));
  scene::Shape cup;
  cup.kind = scene::ShapeKind::ConvexHull;
  scene::TriangleMesh whole;
  for (const double left : {-1.0, 0.3}) {  // two blocks with a gap of 0.6 m, 0.5 m high
    scene::TriangleMesh block;
    for (const double x : {left, left + 0.7}) {
      for (const double y : {-1.0, 1.0}) {
        for (const double z : {0.0, 0.5}) {
          block.points.push_back({{x, y, z}});
        }
      }
    }
    whole.points.insert(whole.points.end(), block.points.begin(), block.points.end());
    cup.pieces.push_back(static_cast<scene::Index>(scene.meshes.size()));
    scene.meshes.push_back(block);
  }
  cup.mesh = static_cast<scene::Index>(scene.meshes.size());
  scene.meshes.push_back(whole);
  scene.add_collider("Cup", {}, cup);
  scene.add_collider("Ground", {}, ground());
  auto sim = simulation(scene);
  run(*sim, 1.5);
  // S-62: the ball falls between the pieces; on the hull it would rest at 0.6.
  EXPECT_NEAR(sim->body_state(0).pose.position[2], 0.1, 2e-3);
}

// Each had a body of MuJoCo's, and of 5000 its search for contacts had no room.
TEST(Contacts, ManyStaticCollidersCollide) {
  TestScene scene;
  constexpr int kAcross = 80;
  for (int i = 0; i < kAcross * kAcross; ++i) {
    const int row = i / kAcross;
    const Vec3d place{{static_cast<double>(i % kAcross), static_cast<double>(row), -0.5}};
    scene.add_collider("floor" + std::to_string(i), std::nullopt, box({{0.5, 0.5, 0.5}}),
                       Pose{place, kIdentityRotation});
  }
  const auto rests = scene.add_body("rests", {{10, 10, 0.1}});
  scene.add_collider("ball", rests, sphere(0.1));
  const auto falls = scene.add_body("falls", {{40, 40, 0.1}});
  const auto ghost = scene.add_collider("ghost", falls, sphere(0.1));
  scene::SetPairs apart;
  for (scene::Index i = 0; i < kAcross * kAcross; ++i) {
    if (length(scene.colliders[i].pose.position - Vec3d{{40, 40, -0.5}}) < 5) {
      apart.emplace_back(i, ghost);
    }
  }
  keep_pairs_apart(scene, apart);
  const auto s = simulation(scene);
  ASSERT_NE(s, nullptr);
  run(*s, 0.25);
  EXPECT_NEAR(s->body_state(rests).pose.position[2], 0.1, 1e-3);
  EXPECT_LT(s->body_state(falls).pose.position[2], -0.1);
}

scene::Shape round_shape(scene::ShapeKind kind) {
  scene::Shape shape;
  shape.kind = kind;
  shape.axis = scene::Axis::Y;
  shape.radius = 0.2;
  shape.half_height = 0.25;
  shape.half_extents = {{0.2, 0.25, 0.2}};
  return shape;
}

// MuJoCo's normal of a contact without depth may point anywhere: the cylinder was kicked by 12 kN.
TEST(Contacts, WhatStartsExactlyOnTheFloorRollsStraight) {
  for (const scene::ShapeKind kind : {scene::ShapeKind::Cylinder, scene::ShapeKind::Ellipsoid}) {
    for (const double half : {5.0, 10.0, 10.25, 20.0}) {
      TestScene scene;
      const auto roll = scene.add_body("Roll", {{-5, 0, 0.2}}, 62.8, {{1.9, 1.26, 1.9}});
      scene.bodies[roll].linear_velocity = {{2, 0, 0}};
      scene.add_collider("RollShape", roll, round_shape(kind));
      scene.add_collider("Floor", {}, box({{half, half, 0.5}}), {{{-1, 0, -0.5}}});
      auto sim = simulation(scene);
      run(*sim, 1.5);
      const BodyState state = sim->body_state(roll);
      // An ellipsoid on its waist leaves the straight way by itself in time.
      const double aside = kind == scene::ShapeKind::Cylinder ? 1e-5 : 1e-3;
      EXPECT_NEAR(state.pose.position[1], 0, aside) << static_cast<int>(kind) << " on " << half;
      EXPECT_NEAR(state.pose.position[2], 0.2, 5e-4) << static_cast<int>(kind) << " on " << half;
      EXPECT_GT(state.pose.position[0], -3.5) << static_cast<int>(kind) << " on " << half;
    }
  }
}

TEST(Contacts, CylindersStartOnAPlaneAsStraight) {
  TestScene scene;
  const auto roll = scene.add_body("Roll", {{-5, 0, 0.2}}, 62.8, {{1.9, 1.26, 1.9}});
  scene.bodies[roll].linear_velocity = {{2, 0, 0}};
  scene.add_collider("RollShape", roll, round_shape(scene::ShapeKind::Cylinder));
  scene.add_collider("Floor", {}, ground());
  auto sim = simulation(scene);
  run(*sim, 2);
  EXPECT_NEAR(sim->body_state(roll).pose.position[1], 0, 1e-6);
}

// With two materials a step is made by its parts, of which MuJoCo's last one knows no such method.
TEST(Contacts, RungeKuttaStepsAreThoseOfMujocoAlsoWithSeveralMaterials) {
  std::vector<BodyState> ends;
  for (const bool several : {false, true}) {
    TestScene scene;
    const auto tumbles = scene.add_body("Tumbles", {{0, 0, 50}}, 1, {{0.01, 0.02, 0.03}});
    scene.bodies[tumbles].angular_velocity = {{0.1, 10, 0.1}};
    const auto rests = scene.add_body("Rests", {{3, 0, 0.1}}, 2, {{0.03, 0.03, 0.05}});
    scene.add_collider("Box", rests, box({{0.2, 0.2, 0.1}}));
    scene.add_collider("Ground", {}, ground());
    if (several) {
      const auto far = scene.add_collider("Far", {}, sphere(0.1), {{{90, 0, 0}}});
      scene.colliders[far].material = add_material(scene, "Rubber", 0.9);
    }
    Diagnostics findings;
    SimulationOptions options;
    options.methods.integrator = Integrator::RungeKutta4;
    auto sim = MujocoSimulation::make(scene, options, findings);
    ASSERT_TRUE(sim.has_value());
    const double energy = (*sim)->energy().total();
    run(**sim, 2);
    EXPECT_NEAR((*sim)->energy().total(), energy, 5e-3);
    ends.push_back((*sim)->body_state(tumbles));
    ends.push_back((*sim)->body_state(rests));
  }
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(length(ends[i].pose.position - ends[i + 2].pose.position), 0, 1e-9);
    EXPECT_NEAR(length(ends[i].angular_velocity - ends[i + 2].angular_velocity), 0, 1e-4);
  }
}

// Nor has the integrator discrete a metric to solve in where constraints are made by its parts.
TEST(Contacts, DiscreteStepsAreThoseOfMujocoAlsoWithSeveralMaterials) {
  std::vector<double> ends;
  for (const bool several : {false, true}) {
    TestScene scene = box_on_ground();
    add_stiff_slider(scene);
    if (several) {
      const auto far = scene.add_collider("Far", {}, sphere(0.1), {{{90, 0, 0}}});
      scene.colliders[far].material = add_material(scene, "Rubber", 0.9);
    }
    auto sim = simulation(scene);
    ASSERT_EQ(sim->engine_model().opt.integrator, mjINT_DISCRETE);
    double farthest = 0;
    for (int i = 0; i < 100; ++i) {
      ASSERT_TRUE(sim->step().has_value());
      farthest = std::max(farthest, std::abs(sim->joint_state(0).position[0]));
    }
    EXPECT_LT(farthest, 0.21);  // the spring starts 0.1 m from where it rests
    ends.push_back(sim->joint_state(0).position[0]);
  }
  EXPECT_NEAR(ends[0], ends[1], 1e-9);
}

// 64 robots have the meshes of one.
TEST(Contacts, EqualMeshesAreMadeOnce) {
  TestScene scene;
  scene::TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.points.push_back({{(i & 1) * 0.2 - 0.1, (i & 2) * 0.1 - 0.1, (i & 4) * 0.05 - 0.1}});
  }
  scene.meshes.push_back(mesh);
  scene::Shape hull;
  hull.kind = scene::ShapeKind::ConvexHull;
  for (int i = 0; i < 64; ++i) {
    const std::string name = std::to_string(i);
    const auto body = scene.add_body("B" + name, {{i * 1.0, 0, 0.1}});
    scene.add_collider("C" + name, body, hull);
  }
  scene.add_collider("Floor", {}, ground());
  auto sim = simulation(scene);
  EXPECT_EQ(sim->engine_model().nmesh, 1);
  EXPECT_EQ(sim->engine_model().ngeom, 129);
  run(*sim, 0.2);
  EXPECT_NEAR(sim->body_state(63).pose.position[2], 0.1, 1e-3);
  scene.colliders[5].max_hull_vertices = 4;
  EXPECT_EQ(simulation(scene)->engine_model().nmesh, 2);
}

// MuJoCo makes hulls with Qhull, which took minutes here.
TEST(Contacts, HullsOfVeryManyCornersAreSimplified) {
  TestScene scene;
  const auto body = scene.add_body("drum", {{0, 0, 0.5}});
  scene::TriangleMesh mesh;
  for (std::size_t i = 0; i < 50'000; ++i) {
    const double angle = 2 * M_PI * static_cast<double>(i) / 50'000;
    mesh.points.push_back({{std::cos(angle), std::sin(angle), i % 2 == 0 ? -0.5 : 0.5}});
  }
  scene::Shape hull;
  hull.kind = scene::ShapeKind::ConvexHull;
  scene.meshes.push_back(std::move(mesh));
  scene.add_collider("hull", body, hull);
  scene.add_collider("ground", std::nullopt, ground());
  const auto s = simulation(scene);
  ASSERT_NE(s, nullptr);
  EXPECT_TRUE(mentions(s->not_mapped(), "/hull", "physics:approximation"));
  run(*s, 0.1);
  EXPECT_NEAR(s->body_state(body).pose.position[2], 0.5, 1e-2);
}

}  // namespace
}  // namespace tenon::engines::mujoco
