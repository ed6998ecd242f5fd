// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/scene/motion/fit_velocities.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace tenon::scene {
namespace {

constexpr double kMass = 1;       // [kg]
constexpr double kMoment = 0.01;  // [kg m^2]

struct Bodies : PhysicsScene {
  Index add(const Vec3d& position, double mass = kMass, double moment = kMoment) {
    Body body;
    body.path = Path::from("/b" + std::to_string(bodies.size()));
    body.pose.position = position;
    body.mass = mass;
    for (std::size_t i = 0; i < 3; ++i) {
      body.inertia[i][i] = moment;
    }
    bodies.push_back(body);
    return static_cast<Index>(bodies.size() - 1);
  }
  // At a point of the world.
  Joint& join(JointKind kind, std::optional<Index> body0, std::optional<Index> body1,
              const Vec3d& at, Axis axis = Axis::X) {
    Joint joint;
    joint.path = Path::from("/j" + std::to_string(joints.size()));
    joint.kind = kind;
    joint.body0 = body0;
    joint.body1 = body1;
    joint.axis = axis;
    joint.frame0 = (body0 ? inverse(bodies[*body0].pose) : Pose{}) * Pose{at};
    joint.frame1 = (body1 ? inverse(bodies[*body1].pose) : Pose{}) * Pose{at};
    joints.push_back(joint);
    return joints.back();
  }
};

std::vector<JointDofs> dofs_of(const PhysicsScene& scene) {
  std::vector<JointDofs> result;
  for (const Joint& joint : scene.joints) {
    result.push_back(joint_dofs(joint));
  }
  return result;
}

FittedVelocities fit(const PhysicsScene& scene, LinkVelocities links = LinkVelocities::OfJoints) {
  return fit_velocities(scene, joint_forest(scene), dofs_of(scene), states_at_start(scene, 0.01),
                        links);
}

struct Momentum {
  Vec3d linear;
  Vec3d angular;
  double energy = 0;
};

Momentum momentum_of(const PhysicsScene& scene, const std::vector<BodyState>& states) {
  Momentum sum;
  for (std::size_t b = 0; b < states.size(); ++b) {
    const Body& body = scene.bodies[b];
    const Vec3d& v = states[b].linear_velocity;
    const Vec3d& w = states[b].angular_velocity;
    const Vec3d spin = w * body.inertia;
    sum.linear += v * body.mass;
    sum.angular +=
        spin + cross(transform_point(states[b].pose, body.center_of_mass), v * body.mass);
    sum.energy += (body.mass * dot(v, v) + dot(w, spin)) / 2;
  }
  return sum;
}

void expect_near(const Vec3d& a, const Vec3d& b, double tolerance, const std::string& what) {
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(a[i], b[i], tolerance) << what << " " << i;
  }
}

// How fast the frame origins of a joint part.
double parting(const PhysicsScene& scene, const Joint& joint,
               const std::vector<BodyState>& states) {
  const auto at = [&](const std::optional<Index>& b, const Pose& frame) {
    if (!b) {
      return Vec3d{};
    }
    const BodyState& state = states[*b];
    const Vec3d arm = transform_point(state.pose, frame.position) -
                      transform_point(state.pose, scene.bodies[*b].center_of_mass);
    return state.linear_velocity + cross(state.angular_velocity, arm);
  };
  return length(at(joint.body1, joint.frame1) - at(joint.body0, joint.frame0));
}

void expect_conserved(const PhysicsScene& scene, const FittedVelocities& fitted,
                      const std::string& what, double tolerance = 1e-10) {
  const Momentum before = momentum_of(scene, states_at_start(scene, 0.01));
  const Momentum after = momentum_of(scene, fitted.bodies);
  expect_near(after.linear, before.linear, tolerance, what + " linear momentum");
  expect_near(after.angular, before.angular, tolerance, what + " angular momentum");
  EXPECT_LE(after.energy, before.energy * (1 + 1e-9)) << what;
}

struct PairCase {
  const char* name;
  JointKind kind;
  Axis axis;
  double lower_speed;  // of the body at rest, along x
  double lower_turn;   // about y
};

// Two equal bodies, one 1 m above the other and joined at its centre, the upper one at 1 m/s. A
// point joint gives the impulse 1 / (2 / m + r^2 / I) (r = 1); a rigid one makes both one body:
// v_com = 1/2, w = L / I with L = m / 2, I = 2 I_b + m / 2; a slide along x leaves them alone.
TEST(FitVelocities, TwoBodiesWithEachJointByEitherRoot) {
  const double push = 1 / (2 / kMass + 1 / kMoment);
  const double rigid = kMass / 2 / (2 * kMoment + kMass / 2);
  const PairCase cases[] = {
      {"fixed", JointKind::Fixed, Axis::X, 0.5 - rigid / 2, rigid},
      {"spherical", JointKind::Spherical, Axis::X, push / kMass, push / kMoment},
      {"hinge about y", JointKind::Revolute, Axis::Y, push / kMass, push / kMoment},
      {"hinge about x", JointKind::Revolute, Axis::X, 0.5 - rigid / 2, rigid},
      {"slide along x", JointKind::Prismatic, Axis::X, 0, 0},
      {"slide along z", JointKind::Prismatic, Axis::Z, 0.5 - rigid / 2, rigid},
      {"distance", JointKind::Distance, Axis::X, 0, 0},
  };
  for (const PairCase& c : cases) {
    for (const int order : {0, 1, 2, 3}) {
      Bodies scene;
      const bool upper_first = order % 2 == 0;
      const Index first = scene.add({{0, 0, upper_first ? 5.0 : 4.0}});
      const Index second = scene.add({{0, 0, upper_first ? 4.0 : 5.0}});
      const Index upper = upper_first ? first : second;
      const Index lower = upper_first ? second : first;
      scene.bodies[upper].linear_velocity = {{1, 0, 0}};
      scene.join(c.kind, order < 2 ? upper : lower, order < 2 ? lower : upper, {{0, 0, 5}}, c.axis);
      const FittedVelocities fitted = fit(scene);
      const std::string what = std::string(c.name) + " " + std::to_string(order);
      expect_near(fitted.bodies[lower].linear_velocity, {{c.lower_speed, 0, 0}}, 1e-9, what);
      expect_near(fitted.bodies[lower].angular_velocity, {{0, c.lower_turn, 0}}, 1e-9, what);
      expect_conserved(scene, fitted, what);
      EXPECT_EQ(fitted.losses.empty(), c.lower_turn == 0) << what;
    }
  }
}

TEST(FitVelocities, TheEnergyThatAJointTakesIsTold) {
  Bodies scene;
  const Index a = scene.add({{0, 0, 0}});
  const Index b = scene.add({{0, 0, 0}});
  scene.bodies[a].linear_velocity = {{2, 0, 0}};
  scene.join(JointKind::Fixed, a, b, {});
  const FittedVelocities fitted = fit(scene);
  ASSERT_EQ(fitted.losses.size(), 1u);
  EXPECT_NEAR(fitted.losses[0].energy, 2, 1e-12);
  EXPECT_NEAR(fitted.losses[0].lost, 1, 1e-12);  // 2 m v^2 / 2 with half the speed
  EXPECT_NEAR(fitted.losses[0].speed, 2, 1e-12);
  EXPECT_EQ(fitted.losses[0].turn_speed, 0);
  EXPECT_NE(words_of(fitted.losses[0]).find("1 J of 2 J"), std::string::npos);
}

TEST(FitVelocities, ABodyAloneKeepsItsVelocityToTheBit) {
  Bodies scene;
  scene.add({{1, 2, 3}});
  scene.bodies[0].linear_velocity = {{0.1, 1.0 / 3, 0.7}};
  scene.bodies[0].angular_velocity = {{0.3, 0.2, 0.9}};
  const FittedVelocities fitted = fit(scene);
  EXPECT_EQ(fitted.bodies[0].linear_velocity, scene.bodies[0].linear_velocity);
  EXPECT_EQ(fitted.bodies[0].angular_velocity, scene.bodies[0].angular_velocity);
}

// Chains and rings far from the origin, from either end: what joints allow, with all momentum. The
// loss is the difference of the energies only where the fit is the nearest one.
TEST(FitVelocities, AChainOfTwentyAndARingKeepTheirMomentum) {
  for (const bool ring : {false, true}) {
    for (const bool backwards : {false, true}) {
      Bodies scene;
      std::mt19937 random(7);
      std::uniform_real_distribution<double> some(-1, 1);
      constexpr int kCount = 20;
      for (int i = 0; i < kCount; ++i) {
        const double angle = 2 * M_PI * i / kCount;
        scene.add({{100 + std::cos(angle), std::sin(angle), 0.1 * some(random)}}, 1 + i % 3);
        scene.bodies.back().linear_velocity = {{some(random), some(random), some(random)}};
        scene.bodies.back().angular_velocity = {{some(random), some(random), some(random)}};
      }
      for (Index i = 0; i + (ring ? 0u : 1u) < kCount; ++i) {
        const Index next = (i + 1) % kCount;
        const Vec3d at = (scene.bodies[i].pose.position + scene.bodies[next].pose.position) * 0.5;
        scene.join(i % 2 == 0 ? JointKind::Spherical : JointKind::Revolute, backwards ? next : i,
                   backwards ? i : next, at, Axis::Z);
      }
      const FittedVelocities fitted = fit(scene);
      const std::string what = std::string(ring ? "ring" : "chain") + (backwards ? " back" : "");
      expect_conserved(scene, fitted, what, 1e-8);
      for (const Joint& joint : scene.joints) {
        EXPECT_LT(parting(scene, joint, fitted.bodies), 1e-9) << what;
      }
      ASSERT_EQ(fitted.losses.size(), 1u);
      EXPECT_NEAR(momentum_of(scene, states_at_start(scene, 0.01)).energy -
                      momentum_of(scene, fitted.bodies).energy,
                  fitted.losses[0].lost, 1e-9)
          << what;
    }
  }
}

TEST(FitVelocities, AHeavyBodyPullsALightOneAlong) {
  for (const bool heavy_first : {true, false}) {
    Bodies scene;
    const Index heavy = scene.add({{0, 0, 5}}, 1e6, 1e4);
    const Index light = scene.add({{0, 0, 4}});
    scene.bodies[heavy].linear_velocity = {{1, 0, 0}};
    scene.join(JointKind::Spherical, heavy_first ? heavy : light, heavy_first ? light : heavy,
               {{0, 0, 5}});
    const FittedVelocities fitted = fit(scene);
    const double push = 1 / (1 / 1e6 + 1 / kMass + 1 / kMoment);
    EXPECT_NEAR(fitted.bodies[heavy].linear_velocity[0], 1 - push / 1e6, 1e-12);
    EXPECT_NEAR(fitted.bodies[light].linear_velocity[0], push / kMass, 1e-9);
  }
}

// The point of the joint moves at u, r above the centre: v = u / (1 + m r^2 / I).
TEST(FitVelocities, ABobUnderAMovingKinematicBodyIsPulledAtItsEndOnly) {
  Bodies scene;
  const Index holder = scene.add({{0, 0, 5}});
  const Index bob = scene.add({{0, 0, 4}});
  scene.bodies[holder].kinematic = true;
  scene.pose_tracks.push_back({holder, {}, {0, 1}, {Pose{{{0, 0, 5}}}, Pose{{{2, 0, 5}}}}});
  scene.join(JointKind::Spherical, holder, bob, {{0, 0, 5}});
  const FittedVelocities fitted = fit(scene);
  EXPECT_NEAR(fitted.bodies[holder].linear_velocity[0], 2, 1e-12);
  EXPECT_NEAR(fitted.bodies[bob].linear_velocity[0], 2 / (1 + kMass / kMoment), 1e-9);
  EXPECT_LT(parting(scene, scene.joints[0], fitted.bodies), 1e-9);
  EXPECT_TRUE(fitted.losses.empty());  // what the holder does to it is no fault of the asset
}

TEST(FitVelocities, ABodyOnTheWorldKeepsWhatItsHingeLeaves) {
  Bodies scene;
  const Index arm = scene.add({{1, 0, 0}});
  scene.bodies[arm].linear_velocity = {{3, 2, 0}};  // along the arm, and across
  scene.join(JointKind::Revolute, std::nullopt, arm, {}, Axis::Z);
  const FittedVelocities fitted = fit(scene);
  const double turn = 2 * kMass / (kMoment + kMass);  // L / I about the hinge
  expect_near(fitted.bodies[arm].angular_velocity, {{0, 0, turn}}, 1e-12, "turn");
  ASSERT_EQ(fitted.joints[0].size(), 1u);
  EXPECT_NEAR(fitted.joints[0][0], turn, 1e-12);
}

// Both hinges of two equal wheels, a rigid mimic of -2: I (w - w0) along (1, -2) only.
TEST(FitVelocities, ARigidMimicIsAGearOfVelocities) {
  Bodies scene;
  const Index leader = scene.add({});
  const Index follower = scene.add({{1, 0, 0}});
  scene.bodies[leader].angular_velocity = {{0, 0, 5}};
  scene.join(JointKind::Revolute, std::nullopt, leader, {}, Axis::Z);
  scene.join(JointKind::Revolute, std::nullopt, follower, {{1, 0, 0}}, Axis::Z);
  Mimic mimic;
  mimic.dof = Dof::RotZ;
  mimic.leader = 0;
  mimic.leader_dof = Dof::RotZ;
  mimic.multiplier = -2;
  scene.joints[1].mimics.push_back(mimic);
  FittedVelocities fitted = fit(scene);
  EXPECT_NEAR(fitted.joints[0][0], 1, 1e-12);
  EXPECT_NEAR(fitted.joints[1][0], -2, 1e-12);
  scene.joints[1].mimics[0].natural_frequency = 3;  // a spring gives no impulse
  fitted = fit(scene);
  EXPECT_NEAR(fitted.joints[0][0], 5, 1e-12);
  EXPECT_EQ(fitted.joints[1][0], 0);
}

// A joint that has a velocity of its own keeps it; the floating pair turns so that L stays.
TEST(FitVelocities, AJointsOwnVelocityCountsAndTheRestReacts) {
  Bodies scene;
  const Index base = scene.add({}, 1, 0.3);
  const Index wheel = scene.add({}, 1, 0.1);
  scene.join(JointKind::Revolute, base, wheel, {}, Axis::Z).initial_velocity = 4;
  const FittedVelocities fitted = fit(scene);
  EXPECT_NEAR(fitted.joints[0][0], 4, 1e-12);
  expect_near(fitted.bodies[base].angular_velocity, {{0, 0, -1}}, 1e-12, "base");
  expect_near(fitted.bodies[wheel].angular_velocity, {{0, 0, 3}}, 1e-12, "wheel");
}

TEST(FitVelocities, LinksOfArticulationsMoveAsTheirJointsSay) {
  Bodies scene;
  const Index base = scene.add({});
  const Index link = scene.add({{1, 0, 0}});
  scene.bodies[base].linear_velocity = {{0, 1, 0}};
  scene.bodies[link].linear_velocity = {{9, 9, 9}};
  scene.join(JointKind::Revolute, base, link, {}, Axis::Z).initial_velocity = 2;
  scene.joints[0].articulation = 0;
  scene.articulations.push_back({{}, {}, false, {base, link}, {0}, {}, true});
  const FittedVelocities fitted = fit(scene);
  expect_near(fitted.bodies[base].linear_velocity, {{0, 1, 0}}, 1e-12, "base");
  expect_near(fitted.bodies[link].linear_velocity, {{0, 3, 0}}, 1e-12, "link");
  EXPECT_TRUE(fitted.losses.empty());
  EXPECT_EQ(fitted.unused, std::vector<Index>{link});
  expect_conserved(scene, fit(scene, LinkVelocities::Own), "as they are");
  EXPECT_TRUE(fit(scene, LinkVelocities::Own).unused.empty());
  scene.bodies[link].linear_velocity = {{0, 3, 0}};
  scene.bodies[link].angular_velocity = {{0, 0, 2}};
  EXPECT_TRUE(fit(scene).unused.empty());
}

TEST(FitVelocities, ABodyBetweenTwoThatDrawApartStaysFinite) {
  Bodies scene;
  const Index left = scene.add({{-1, 0, 0}});
  const Index middle = scene.add({});
  const Index right = scene.add({{1, 0, 0}});
  for (const Index b : {left, right}) {
    scene.bodies[b].kinematic = true;
    const Vec3d at = scene.bodies[b].pose.position;
    scene.pose_tracks.push_back({b, {}, {0, 1}, {Pose{at}, Pose{at * 2}}});
  }
  scene.join(JointKind::Fixed, left, middle, {});
  scene.join(JointKind::Fixed, middle, right, {});
  const FittedVelocities fitted = fit(scene);
  EXPECT_TRUE(is_finite(fitted.bodies[middle].linear_velocity));
  EXPECT_LT(length(fitted.bodies[middle].linear_velocity), 1.1);
}

}  // namespace
}  // namespace tenon::scene
