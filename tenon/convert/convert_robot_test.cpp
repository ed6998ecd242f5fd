// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Robots as text, converted, composed and read back as physics: the numbers have to come through
// every schema unharmed.
#include "tenon/convert/convert_robot.h"

#include <cmath>
#include <fstream>
#include <numbers>

#include <gtest/gtest.h>

#include "tenon/convert/joints.h"
#include "tenon/formats/save_layer.h"
#include "tenon/math/inertia.h"
#include "tenon/physics/read_physics.h"
#include "tenon/stage/stage.h"
#include "tenon/urdf/read_urdf.h"

namespace tenon::convert {
namespace {

constexpr double kFloat = 1e-7;  // relative rounding of a float
constexpr const char* kInertial =
    "<inertial><origin xyz='0.1 0.2 0.3'/><mass value='2'/>"
    "<inertia ixx='1' ixy='0.1' ixz='0.2' iyy='2' iyz='0.3' izz='2.5'/></inertial>";

std::string link(const std::string& name, const std::string& inside = kInertial) {
  return "<link name='" + name + "'>" + inside + "</link>\n";
}

std::string joint(const std::string& name, const std::string& type, const std::string& parent,
                  const std::string& child, const std::string& inside) {
  return "<joint name='" + name + "' type='" + type + "'><parent link='" + parent +
         "'/><child link='" + child + "'/>" + inside + "</joint>\n";
}

/// What a robot becomes.
struct Converted {
  std::shared_ptr<const layer::Layer> layer;
  scene::PhysicsScene scene;
  Diagnostics findings;  // of reading and converting
  Diagnostics physics_findings;

  const scene::Joint& joint(const std::string& name) const {
    for (const scene::Joint& found : scene.joints) {
      if (found.path.name().view() == name) {
        return found;
      }
    }
    ADD_FAILURE() << "no joint " << name;
    return scene.joints.at(0);
  }
  const scene::Body& body(const std::string& name) const {
    for (const scene::Body& found : scene.bodies) {
      if (found.path.name().view() == name) {
        return found;
      }
    }
    ADD_FAILURE() << "no body " << name;
    return scene.bodies.at(0);
  }
  std::string rules() const {
    std::string text;
    for (const Diagnostic& finding : findings) {
      const bool of_each_urdf = finding.rule == "convert.self-collision";
      text += of_each_urdf ? "" : finding.rule + ";";
    }
    return text;
  }
};

Converted convert(const std::string& elements, const ConvertOptions& options = {}) {
  Converted result;
  auto model = urdf::read_urdf_text("<robot name='bot'>" + elements + "</robot>", "bot.urdf", {},
                                    result.findings);
  EXPECT_TRUE(model) << model.error().to_string();
  auto layer = convert_robot(*std::move(model), options, result.findings);
  EXPECT_TRUE(layer) << layer.error().to_string();
  result.layer = std::make_shared<const layer::Layer>(*std::move(layer));
  const auto stage = stage::Stage::open(result.layer, nullptr, {});
  EXPECT_TRUE(stage) << stage.error().to_string();
  result.scene = physics::read_physics(*stage, {}, result.physics_findings);
  EXPECT_FALSE(result.physics_findings.has_errors())
      << result.physics_findings.items()[0].to_string();
  return result;
}

/// base -j-> a -k-> b, k following j.
std::string mimic_robot(const std::string& j_type, const std::string& k_type) {
  return link("base") + link("a") + link("b") +
         joint("j", j_type, "base", "a",
               "<axis xyz='0 0 -1'/><limit lower='-0.5' upper='1.5' effort='7' velocity='3'/>"
               "<dynamics damping='0.25' friction='0.125'/>") +
         joint("k", k_type, "a", "b",
               "<axis xyz='0 1 0'/><limit lower='-2' upper='2' effort='1' velocity='1'/>"
               "<mimic joint='j' multiplier='-1.5' offset='0.25'/>");
}

void expect_settings(const Converted& robot, const std::string& mimic_schema) {
  const scene::Joint& j = robot.joint("j");
  EXPECT_NEAR(j.lower, -0.5, kFloat);
  EXPECT_NEAR(j.upper, 1.5, 2 * kFloat);
  EXPECT_NEAR(j.velocity_limit, 3, 3 * kFloat);
  ASSERT_EQ(j.drives.size(), 1u);
  EXPECT_EQ(j.drives[0].max_force, 7);
  EXPECT_NEAR(j.damping, 0.25, kFloat);
  EXPECT_EQ(j.friction, 0.125);
  const scene::Joint& k = robot.joint("k");
  ASSERT_EQ(k.drives.size(), 1u);  // for its effort
  EXPECT_EQ(k.drives[0].max_force, 1);
  EXPECT_EQ(k.drives[0].stiffness, 0);
  EXPECT_EQ(k.drives[0].damping, 0);
  ASSERT_EQ(k.mimics.size(), 1u);
  const scene::Mimic& mimic = k.mimics.front();
  EXPECT_EQ(mimic.schema, mimic_schema);
  EXPECT_EQ(mimic.dof, k.dof());
  EXPECT_EQ(robot.scene.joints[mimic.leader].path.name(), "j");
  EXPECT_NEAR(mimic.multiplier, -1.5, 2 * kFloat);
  EXPECT_NEAR(mimic.offset, 0.25, kFloat);
}

TEST(ConvertRobot, SaysTheSameInEverySchema) {
  ConvertOptions options;
  for (const auto& [j, k] : {std::pair("revolute", "revolute"),
                             {"revolute", "prismatic"},
                             {"prismatic", "revolute"},
                             {"prismatic", "prismatic"}}) {
    const std::string text = mimic_robot(j, k);
    options.schema = SchemaGeneration::Current;
    expect_settings(convert(text, options), "NewtonMimicAPI");
    options.schema = SchemaGeneration::Both;
    expect_settings(convert(text, options), "PhysxMimicJointAPI");
    options.schema = SchemaGeneration::Legacy;
    expect_settings(convert(text, options), "PhysxMimicJointAPI");
  }
}

TEST(ConvertRobot, GivesJointsWhatTheirNamesMatch) {
  ConvertOptions options;
  options.gains = Gains{100, 10};
  options.gain_rules = {{"j|base", {50, 5}}};
  options.armature = {{"", 0.5}, {"[k]", 0.25}};
  options.friction = {{"j", 0.75}};
  const std::string text = mimic_robot("revolute", "revolute");
  const Converted robot = convert(text, options);
  EXPECT_NEAR(robot.joint("j").drives.at(0).stiffness, 50, 1e-5);
  EXPECT_EQ(robot.joint("j").armature, 0.5);
  EXPECT_EQ(robot.joint("k").armature, 0.25);
  EXPECT_EQ(robot.joint("j").friction, 0.75);
  EXPECT_EQ(robot.joint("k").friction, 0);
}

TEST(ConvertRobot, GivesGainsPerRadianToMuJoCoAndPerDegreeToDrives) {
  ConvertOptions options;
  options.gains = Gains{100, 10};
  options.joint_gains["j"] = Gains{50, 5};
  const Converted robot = convert(mimic_robot("revolute", "revolute"), options);
  const Path j = Path::from("/bot/Physics/j");
  const auto number = [&](const char* name) {
    return static_cast<double>(robot.layer->find(j.property(name))->get_or<float>("default", 0));
  };
  EXPECT_NEAR(number("drive:angular:physics:stiffness"), 50 * std::numbers::pi / 180, 1e-6);
  EXPECT_NEAR(number("drive:angular:physics:damping"), 5 * std::numbers::pi / 180, 1e-6);
  const auto* gain = robot.layer->find(Path::from("/bot/Physics/j_actuator.mjc:gainPrm"))
                         ->get<layer::Array<double>>("default");
  ASSERT_NE(gain, nullptr);
  EXPECT_EQ((*gain)[0], 50);
  // The drive that comes of both.
  EXPECT_NEAR(robot.joint("j").drives.at(0).stiffness, 50, 1e-5);
  EXPECT_NEAR(robot.joint("j").drives.at(0).damping, 5, 1e-6);
  EXPECT_EQ(robot.joint("j").drives.at(0).max_force, 7);
  EXPECT_FALSE(robot.layer->has(Path::from("/bot/Physics/k_actuator")));
  options.joint_gains["nobody"] = {};
  EXPECT_EQ(convert(mimic_robot("revolute", "revolute"), options).rules(),
            "convert.gains;convert.free-root;");
}

TEST(ConvertRobot, KeepsMassesToTheLastBit) {
  const Converted robot =
      convert(link("base") + link("a") + joint("j", "continuous", "base", "a", ""));
  const scene::Body& body = robot.body("a");
  EXPECT_EQ(body.mass, 2);
  EXPECT_EQ(body.center_of_mass, to_double(Vec3f{{0.1f, 0.2f, 0.3f}}));
  EXPECT_EQ(body.inertia, (Mat3d{{{{1, 0.1, 0.2}, {0.1, 2, 0.3}, {0.2, 0.3, 2.5}}}}));
}

TEST(ConvertRobot, SplitsInertiasIntoMomentsAndAxes) {
  const Converted robot = convert(link("base"));
  const Path base = Path::from("/bot/Geometry/base");
  const auto moments =
      robot.layer->find(base.property("physics:diagonalInertia"))->get_or<Vec3f>("default", {});
  const auto axes =
      robot.layer->find(base.property("physics:principalAxes"))->get_or<Quatf>("default", {});
  const Mat3d back =
      rotate_inertia(normalized(to_double(axes)), diagonal_matrix(to_double(moments)));
  const double expected[3][3] = {{1, 0.1, 0.2}, {0.1, 2, 0.3}, {0.2, 0.3, 2.5}};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      EXPECT_NEAR(back[i][j], expected[i][j], 1e-6);
    }
  }
}

TEST(ConvertRobot, TurnsEveryAxisIntoAToken) {
  const Vec3d axes[] = {{{1, 0, 0}},
                        {{-1, 0, 0}},
                        {{0, 1, 0}},
                        {{0, -1, 0}},
                        {{0, 0, 1}},
                        {{0, 0, -1}},
                        {{0.6, 0, 0.8}},
                        {{-0.6, -0.8, 0}},
                        {{-1, 1e-9, 0}},
                        // As tools write them that turn axes by matrices.
                        {{-0.9999999999999998, 0, -2.220446049250313e-16}},
                        {{-0.9999999999999998, 0, 1e-9}},
                        {{-0.9999999999999998, 2e-8, 0}},
                        {{-2.220446049250313e-16, -0.9999999999999998, 0}}};
  for (const Vec3d& axis : axes) {
    const AxisTurn turn = axis_turn(axis);
    Vec3d unit;
    unit[static_cast<std::size_t>(turn.token[0] - 'X')] = 1;
    const Vec3d turned = rotate(turn.rotation, unit);
    EXPECT_LT(length(turned - axis), 1e-12) << axis[0] << " " << axis[1] << " " << axis[2];
  }
}

TEST(ConvertRobot, PlacesJointsWhereTheDescriptionDoes) {
  for (const bool flat : {false, true}) {
    ConvertOptions options;
    options.flat = flat;
    const Converted robot = convert(
        link("base") + link("a") + link("b") +
            joint("j", "continuous", "base", "a",
                  "<origin xyz='1 0 0' rpy='0 0 1.5707963267948966'/><axis xyz='0 0 -1'/>") +
            joint("k", "prismatic", "a", "b",
                  "<origin xyz='1 0 0'/><axis xyz='0.6 0 0.8'/><limit lower='-1' "
                  "upper='1' effort='1' velocity='1'/>"),
        options);
    const scene::Body& b = robot.body("b");
    EXPECT_NEAR(b.pose.position[0], 1, 1e-15);
    EXPECT_NEAR(b.pose.position[1], 1, 1e-15);  // a is turned by a quarter about z
    EXPECT_EQ(b.path.str(), flat ? "/bot/b" : "/bot/Geometry/base/a/b");
    for (const scene::Joint& joint : robot.scene.joints) {
      const Pose from0 = robot.scene.bodies[*joint.body0].pose * joint.frame0;
      const Pose from1 = robot.scene.bodies[*joint.body1].pose * joint.frame1;
      EXPECT_LT(length(from0.position - from1.position), 1e-6);
      EXPECT_NEAR(std::fabs(dot(from0.orientation, from1.orientation)), 1, 1e-6);
      // In the child, the joint's axis is that of the description.
      Vec3d unit;
      unit[static_cast<std::size_t>(joint.axis)] = 1;
      const Vec3d axis = rotate(joint.frame1.orientation, unit);
      const Vec3d wanted = joint.path.name() == "j" ? Vec3d{{0, 0, -1}} : Vec3d{{0.6, 0, 0.8}};
      EXPECT_LT(length(axis - wanted), 1e-6);
    }
    ASSERT_EQ(robot.scene.articulations.size(), 1u);
    EXPECT_FALSE(robot.scene.articulations[0].fixed_base);
  }
}

TEST(ConvertRobot, HoldsTheBaseWhereAsked) {
  ConvertOptions options;
  options.fix_base = true;
  const std::string text = link("base") + link("a") + joint("j", "continuous", "base", "a", "");
  const Converted fixed = convert(text, options);
  EXPECT_EQ(fixed.joint("fixed_base").kind, scene::JointKind::Fixed);
  EXPECT_TRUE(fixed.scene.articulations.at(0).fixed_base);
  // A root without mass stands still anyway.
  const Converted ghost = convert(link("world", "") + link("base") + link("a") +
                                  joint("hold", "fixed", "world", "base", "") +
                                  joint("j", "continuous", "base", "a", ""));
  EXPECT_EQ(ghost.scene.bodies.size(), 2u);
  EXPECT_EQ(ghost.joint("hold").kind, scene::JointKind::Fixed);
  EXPECT_TRUE(ghost.scene.articulations.at(0).fixed_base);
}

TEST(ConvertRobot, LetsARobotFloatWhoseRootIsEmptyWhereAsked) {
  const std::string rest = link("trunk") + link("leg");
  const auto joints = [](const std::string& root) {
    return joint("hold", "fixed", root, "trunk", "") +
           joint("hip", "continuous", root, "leg", "<axis xyz='0 0 1'/>");
  };
  ConvertOptions options;
  options.float_base = true;
  const Converted floating = convert("<link name='base'/>" + rest + joints("base"), options);
  EXPECT_EQ(floating.rules(), "convert.massless-root;");
  EXPECT_EQ(floating.scene.bodies.size(), 3u);
  EXPECT_NEAR(floating.body("base").mass, 2e-6, 1e-12);
  ASSERT_EQ(floating.scene.articulations.size(), 1u);
  EXPECT_FALSE(floating.scene.articulations[0].fixed_base);
  const Converted standing = convert("<link name='base'/>" + rest + joints("base"));
  EXPECT_EQ(standing.rules(), "convert.static-root;");
  EXPECT_EQ(standing.scene.bodies.size(), 2u);
  EXPECT_TRUE(standing.scene.articulations.at(0).fixed_base);
}

TEST(ConvertRobot, KeepsTheTotalMassWhereMovingLinksHaveNone) {
  const std::string slide = "<limit lower='-1' upper='1' effort='10' velocity='1'/>";
  const Converted chain = convert(
      "<link name='root'/><link name='x'/><link name='y'/>" + link("palm") + "<link name='tip'/>" +
      joint("jx", "prismatic", "root", "x", slide) + joint("jy", "prismatic", "x", "y", slide) +
      joint("jz", "prismatic", "y", "palm", slide) + joint("jt", "continuous", "palm", "tip", ""));
  double total = 0;
  for (const scene::Body& body : chain.scene.bodies) {
    total += body.mass;
  }
  EXPECT_NEAR(total, 2, 1e-5);
  EXPECT_NEAR(chain.body("x").mass, 2e-6, 1e-12);
  EXPECT_EQ(chain.rules(),
            "convert.static-root;convert.massless;convert.massless;convert.massless;");
  EXPECT_EQ(chain.findings.items()[1].severity, Severity::Warning);
  EXPECT_EQ(chain.findings.items()[3].severity, Severity::Error);  // nothing on it has a mass
}

TEST(ConvertRobot, HoldsRootsThatAreCalledSoUnlessTheyAreToFloat) {
  const std::string arm =
      link("base_link") + link("a") + joint("j", "continuous", "base_link", "a", "");
  const Converted held = convert(arm);
  EXPECT_EQ(held.rules(), "convert.fixed-root;");
  EXPECT_TRUE(held.scene.articulations.at(0).fixed_base);
  ConvertOptions options;
  options.float_base = true;
  const Converted floats = convert(arm, options);
  EXPECT_EQ(floats.rules(), "");
  EXPECT_FALSE(floats.scene.articulations.at(0).fixed_base);
  // Of another name a root is free, which is said unless it was asked for or prevented.
  const std::string other = link("trunk") + link("a") + joint("j", "continuous", "trunk", "a", "");
  EXPECT_EQ(convert(other).rules(), "convert.free-root;");
  EXPECT_EQ(convert(other, options).rules(), "");
  ConvertOptions fixed;
  fixed.fix_base = true;
  EXPECT_EQ(convert(other, fixed).rules(), "");
  const Converted cart = convert(link("base_link") + link("a") +
                                 joint("j", "planar", "base_link", "a", "<axis xyz='0 0 1'/>"));
  EXPECT_EQ(cart.rules(), "");
  // A root that only colliders could weigh floats, too.
  const Converted cube = convert(
      link("cube", "<collision><geometry><box size='1 1 1'/></geometry></collision>"), options);
  EXPECT_EQ(cube.rules(), "convert.no-mass;");
  EXPECT_EQ(cube.scene.bodies.size(), 1u);
}

TEST(ConvertRobot, MakesFramesOfLinksWithoutMass) {
  const std::string text =
      link("base") +
      link("tool", "<collision><geometry><box size='1 1 1'/></geometry></collision>") + link("a") +
      joint("mount", "fixed", "base", "tool", "<origin xyz='0 0 1'/>") +
      joint("j", "continuous", "tool", "a", "<origin xyz='0 0 2'/>");
  const Converted robot = convert(text);
  EXPECT_EQ(robot.rules(), "convert.free-root;convert.frame;");
  ASSERT_EQ(robot.scene.bodies.size(), 2u);
  ASSERT_EQ(robot.scene.colliders.size(), 1u);
  EXPECT_EQ(robot.scene.bodies[*robot.scene.colliders[0].body].path.name(), "base");
  const scene::Joint& j = robot.joint("j");
  EXPECT_EQ(robot.scene.bodies[*j.body0].path.name(), "base");
  EXPECT_EQ(j.frame0.position, (Vec3d{{0, 0, 3}}));
}

TEST(ConvertRobot, MergesFixedLinks) {
  ConvertOptions options;
  options.merge_fixed = true;
  const Converted robot = convert(link("base") + link("part") + link("a") +
                                      joint("mount", "fixed", "base", "part", "") +
                                      joint("j", "continuous", "part", "a", ""),
                                  options);
  EXPECT_EQ(robot.scene.bodies.size(), 2u);
  EXPECT_EQ(robot.body("base").mass, 4);
  EXPECT_EQ(robot.scene.joints.size(), 1u);
}

TEST(ConvertRobot, LocksAllButThePlane) {
  const Converted robot =
      convert(link("base") + link("a") + joint("j", "planar", "base", "a", "<axis xyz='0 0 1'/>"));
  std::string locked;
  for (const scene::Limit& limit : robot.joint("j").limits) {
    locked += limit.locked() ? std::string(scene::dof_name(limit.dof)) + ";" : "";
  }
  EXPECT_EQ(locked, "transZ;rotX;rotY;");
}

TEST(ConvertRobot, KnowsBallsAndFreeBodies) {
  const Converted robot =
      convert(link("base") + link("a") + link("b") + joint("j", "spherical", "base", "a", "") +
              joint("k", "floating", "base", "b", "<origin xyz='0 0 5'/>"));
  EXPECT_EQ(robot.scene.joints.size(), 1u);
  EXPECT_EQ(robot.joint("j").kind, scene::JointKind::Spherical);
  EXPECT_EQ(robot.body("b").pose.position, (Vec3d{{0, 0, 5}}));
  EXPECT_EQ(robot.rules(), "convert.floating;");
}

TEST(ConvertRobot, ShapesKeepTheirSizes) {
  const auto shape = [](const std::string& geometry) {
    return "<collision><origin xyz='0 0 1'/><geometry>" + geometry + "</geometry></collision>";
  };
  const Converted robot = convert(link("base", kInertial + shape("<box size='1 2 3'/>") +
                                                   shape("<sphere radius='0.1'/>") +
                                                   shape("<cylinder radius='0.1' length='0.5'/>") +
                                                   shape("<capsule radius='0.1' length='0.5'/>")));
  ASSERT_EQ(robot.scene.colliders.size(), 4u);
  for (const scene::Collider& collider : robot.scene.colliders) {
    EXPECT_EQ(collider.pose.position, (Vec3d{{0, 0, 1}}));
    switch (collider.shape.kind) {
      case scene::ShapeKind::Box:
        EXPECT_EQ(collider.shape.half_extents, (Vec3d{{0.5, 1, 1.5}}));
        break;
      case scene::ShapeKind::Sphere:
        EXPECT_EQ(collider.shape.radius, 0.1);
        break;
      default:
        EXPECT_EQ(collider.shape.radius, 0.1);
        EXPECT_EQ(collider.shape.half_height, 0.25);
    }
  }
}

TEST(ConvertRobot, NamesEverythingLegally) {
  const Converted robot = convert(link("1 base") + link("1_base") + link("Physics") +
                                  joint("a-b", "continuous", "1 base", "1_base", "") +
                                  joint("a.b", "continuous", "1 base", "Physics", ""));
  std::string names;
  for (const scene::Body& body : robot.scene.bodies) {
    names += body.path.str() + ";";
  }
  EXPECT_EQ(names,
            "/bot/Geometry/_1_base;/bot/Geometry/_1_base/Physics_1;"
            "/bot/Geometry/_1_base/_1_base_1;");
  EXPECT_EQ(robot.layer->find(Path::from("/bot/Geometry/_1_base"))
                ->get_or<std::string>("displayName", ""),
            "1 base");
  EXPECT_TRUE(robot.layer->has(Path::from("/bot/Physics/a_b_1")));
}

TEST(ConvertRobot, FollowsTheLeaderOfAChain) {
  const Converted robot =
      convert(link("l0") + link("l1") + link("l2") + link("l3") +
              joint("c", "continuous", "l2", "l3", "<mimic joint='b' multiplier='3' offset='1'/>") +
              joint("b", "continuous", "l1", "l2", "<mimic joint='a' multiplier='2' offset='5'/>") +
              joint("a", "continuous", "l0", "l1", ""));
  const scene::Mimic& mimic = robot.joint("c").mimics.at(0);
  EXPECT_EQ(robot.scene.joints[mimic.leader].path.name(), "a");
  EXPECT_NEAR(mimic.multiplier, 6, 1e-6);
  EXPECT_NEAR(mimic.offset, 16, 1e-5);
}

TEST(ConvertRobot, RefusesChainsThatCannotBeNested) {
  std::string text = link("l0");
  for (int i = 1; i < 1500; ++i) {
    const std::string n = std::to_string(i);
    text += link("l" + n) + joint("j" + n, "continuous", "l" + std::to_string(i - 1), "l" + n, "");
  }
  Diagnostics findings;
  auto model = urdf::read_urdf_text("<robot name='r'>" + text + "</robot>", "", {}, findings);
  ASSERT_TRUE(model);
  const auto nested = convert_robot(*model, {}, findings);
  ASSERT_FALSE(nested);
  EXPECT_EQ(nested.error().code(), ErrorCode::Limit);
  ConvertOptions flat;
  flat.flat = true;
  EXPECT_TRUE(convert_robot(*model, flat, findings));
}

TEST(ConvertRobot, WritesTheSameBytesEachTime) {
  const std::string text = mimic_robot("revolute", "prismatic");
  const auto first = formats::encode_layer(*convert(text).layer, formats::LayerFormat::Text);
  const auto second = formats::encode_layer(*convert(text).layer, formats::LayerFormat::Text);
  ASSERT_TRUE(first && second);
  EXPECT_EQ(*first, *second);
}

}  // namespace
}  // namespace tenon::convert
