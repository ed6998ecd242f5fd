// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/mjcf/read_mjcf.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <numbers>

#include <gtest/gtest.h>
#include <unistd.h>

#include "tenon/math/inertia.h"
#include "tenon/robot/kinematic_tree.h"

namespace tenon::mjcf {
namespace {

using robot::JointKind;

class ReadMjcf : public testing::Test {
 protected:
  ReadMjcf()
      : path_((std::filesystem::temp_directory_path() /
               ("tenon_mjcf_" + std::to_string(getpid()) + ".xml"))
                  .string()) {}
  ~ReadMjcf() override { std::filesystem::remove(path_); }

  Result<robot::RobotModel> read(const std::string& inside) {
    findings_ = {};
    std::ofstream(path_) << "<mujoco model='m'>" << inside << "</mujoco>";
    return read_mjcf(path_, findings_);
  }
  std::string found() const {
    std::string text;
    for (const Diagnostic& finding : findings_) {
      text += finding.rule + ";";
    }
    return text;
  }

  std::string path_;
  Diagnostics findings_;
};

TEST_F(ReadMjcf, ResolvesDefaultsAnglesAndInertias) {
  const auto model = read(
      "<compiler angle='degree'/><default><default class='d'><joint damping='0.5' armature='0.1'/>"
      "</default></default><worldbody><body name='a' pos='0 0 1' euler='0 0 90'>"
      "<joint name='j' class='d' axis='0 0 2' range='-90 45' pos='0.1 0 0'/>"
      "<geom type='box' size='0.1 0.2 0.3' density='1000'/></body></worldbody>");
  ASSERT_TRUE(model) << model.error().to_string();
  ASSERT_TRUE(robot::kinematic_tree(*model));
  ASSERT_EQ(model->joints.size(), 1u);
  const robot::Joint& j = model->joints[0];
  EXPECT_EQ(j.kind, JointKind::Revolute);
  EXPECT_NEAR(j.limit->lower, -std::numbers::pi / 2, 1e-12);
  EXPECT_NEAR(j.limit->upper, std::numbers::pi / 4, 1e-12);
  EXPECT_EQ(j.damping, 0.5);
  EXPECT_EQ(j.armature, 0.1);
  // Limits of other assets are harder than MuJoCo's default.
  EXPECT_EQ(j.mujoco.solref_limit, (std::vector<double>{0.02, 1}));
  EXPECT_EQ(j.mujoco.solimp_limit, (std::vector<double>{0.9, 0.95, 0.001, 0.5, 2}));
  EXPECT_TRUE(j.mujoco.solref_friction.empty());
  EXPECT_EQ(j.frame.position, (Vec3d{{0.1, 0, 0}}));
  EXPECT_EQ(j.origin.position, (Vec3d{{0, 0, 1}}));
  const robot::Inertial& inertial = *model->links[1].inertial;
  EXPECT_NEAR(inertial.mass, 48, 1e-9);  // 0.2 x 0.4 x 0.6 m, 1000 kg/m^3
  EXPECT_NEAR(inertial.inertia_in_link()[2][2], 48.0 / 12 * (0.04 + 0.16), 1e-9);
  EXPECT_EQ(found(), "");
}

TEST_F(ReadMjcf, CountsFromTheReference) {
  const auto model = read(
      "<compiler angle='radian'/><worldbody><body><joint name='a' axis='0 0 1' ref='0.5' "
      "range='0 1' stiffness='3' springref='0.75'/><geom size='0.1'/><body><joint name='b' axis='0 "
      "0 1'/>"
      "<geom size='0.1'/></body></body></worldbody>"
      "<equality><joint joint1='b' joint2='a' polycoef='0.25 -2 0 0 0'/></equality>");
  ASSERT_TRUE(model) << model.error().to_string();
  EXPECT_DOUBLE_EQ(model->joints[0].limit->lower, -0.5);
  EXPECT_DOUBLE_EQ(model->joints[0].limit->upper, 0.5);
  EXPECT_DOUBLE_EQ(model->joints[0].spring_reference, 0.25);
  EXPECT_EQ(model->joints[1].mimic->leader, 0u);
  EXPECT_EQ(model->joints[1].mimic->multiplier, -2);
  EXPECT_EQ(model->joints[1].mimic->offset, 0.25);
  EXPECT_EQ(found(), "mjcf.reference;");
}

TEST_F(ReadMjcf, PutsLinksBetweenJointsOfOneBody) {
  const auto model = read(
      "<worldbody><body name='torso'><freejoint/><geom size='0.1'/><body name='leg'>"
      "<joint name='x' axis='1 0 0'/><joint name='y' axis='0 1 0'/><geom size='0.1'/></body></body>"
      "</worldbody>");
  ASSERT_TRUE(model) << model.error().to_string();
  ASSERT_TRUE(robot::kinematic_tree(*model));
  ASSERT_EQ(model->links.size(), 4u);
  EXPECT_EQ(model->joints[0].kind, JointKind::Floating);
  EXPECT_EQ(model->links[model->joints[1].child].name, "leg_x");
  EXPECT_EQ(model->links[model->joints[2].child].name, "leg");
  EXPECT_LT(model->links[3].inertial->mass, 1e-5 * model->links[2].inertial->mass);
  EXPECT_EQ(found(), "mjcf.several-joints;");
}

// MuJoCo never lets a body touch what carries it.
TEST_F(ReadMjcf, ExcludesWhatCarriesABodyWhereNoJointSaysSo) {
  const std::string bodies =
      "<worldbody><geom size='0.1'/><body name='hip'><freejoint/><geom size='0.1'/>"
      "<body name='pad'><geom size='0.1'/></body>"
      "<body name='leg'><joint name='x'/><joint name='y' axis='0 1 0'/><geom size='0.1'/></body>"
      "<body name='tail'><joint name='t'/><geom size='0.1'/></body></body></worldbody>";
  const auto model = read(bodies);
  ASSERT_TRUE(model) << model.error().to_string();
  std::vector<std::string> pairs;
  for (const auto& [a, b] : model->excluded_pairs) {
    pairs.push_back(model->links[a].name + "-" + model->links[b].name);
  }
  EXPECT_EQ(pairs, (std::vector<std::string>{"hip-leg", "pad-leg", "pad-tail"}));
  const auto all = read(bodies + "<option><flag filterparent='disable'/></option>");
  ASSERT_TRUE(all) << all.error().to_string();
  EXPECT_TRUE(all->excluded_pairs.empty());
}

TEST_F(ReadMjcf, TakesActuatorsThatAreSpringsAndListsTheRest) {
  const auto model = read(
      "<worldbody><body name='a'><joint name='j' axis='0 0 1'/><geom size='0.1' rgba='1 0 0 1' "
      "friction='0.3 0.01 0.001'/><site name='tip' pos='0 0 1'/><body name='b'><joint name='k'/>"
      "<geom size='0.1' contype='0' conaffinity='0'/></body></body></worldbody>"
      "<contact><exclude body1='a' body2='b'/></contact>"
      "<actuator><position joint='j' kp='20' kv='2' gear='2' forcerange='-3 3'/>"
      "<motor name='m' joint='k'/></actuator><keyframe><key/></keyframe>");
  ASSERT_TRUE(model) << model.error().to_string();
  const robot::Joint& j = model->joints[0];
  EXPECT_EQ(j.drive->stiffness, 80);  // kp gear^2
  EXPECT_EQ(j.drive->damping, 8);
  EXPECT_EQ(j.effort_limit, 6);
  EXPECT_EQ(found(), "");
  ASSERT_EQ(model->mujoco.actuators.size(), 1u);
  EXPECT_EQ(model->mujoco.actuators[0].name, "m");
  EXPECT_EQ(model->mujoco.actuators[0].target, 1u);
  EXPECT_EQ(model->mujoco.keyframes.size(), 1u);
  EXPECT_EQ(model->links[1].sites.at(0).name, "tip");
  EXPECT_EQ(*model->links[1].colliders.at(0).surface.torsional_friction, 0.01);
  EXPECT_EQ(model->links[2].visuals.size(), 1u);
  EXPECT_TRUE(model->links[2].colliders.empty());
  ASSERT_EQ(model->excluded_pairs.size(), 1u);
}

TEST_F(ReadMjcf, TellsApartWhatMayTouch) {
  const auto model = read(
      "<worldbody><geom name='floor' type='plane' size='5 5 0.1' contype='1' conaffinity='0'/>"
      "<body name='a' pos='0 0 1'><freejoint/><geom size='0.1' contype='0' conaffinity='1'/>"
      "<body name='b' pos='0.5 0 0'><joint name='j' axis='0 1 0'/>"
      "<geom size='0.1' contype='2' conaffinity='3'/></body>"
      "<body name='c' pos='-0.5 0 0'><joint name='k' axis='0 1 0'/>"
      "<geom name='c' size='0.1' contype='0' conaffinity='0'/>"
      "<geom size='0.2' contype='0' conaffinity='0'/></body></body></worldbody>\n"
      "<contact><pair geom1='c' geom2='floor'/></contact>");
  ASSERT_TRUE(model) << model.error().to_string();
  const auto class_of = [&](std::size_t link) {
    return model->links[link].colliders.at(0).contact_class;
  };
  const auto touch = [&](std::size_t a, std::size_t b) {
    const std::vector<robot::Index>& off = model->contact_classes[*class_of(a)].untouched;
    return std::find(off.begin(), off.end(), *class_of(b)) == off.end();
  };
  const bool expected[4][4] = {{false, true, true, true},
                               {true, false, false, false},
                               {true, false, true, false},
                               {true, false, false, false}};  // floor, a, b, c
  for (std::size_t a = 0; a < 4; ++a) {
    for (std::size_t b = 0; b < 4; ++b) {
      EXPECT_EQ(touch(a, b), expected[a][b]) << a << " and " << b;
    }
  }
  EXPECT_EQ(model->links[3].colliders.size(), 1u);
  EXPECT_EQ(model->links[3].visuals.size(), 2u);
  EXPECT_EQ(found(), "mjcf.left-out;");  // the pair's own friction
}

TEST_F(ReadMjcf, TakesLoopsTendonsAndKeyframesAndNamesLinesOfTheRest) {
  const auto model = read(
      "<worldbody><body name='a' pos='0 0 1'><joint name='j' axis='0 1 0' ref='30'/><geom "
      "size='0.1'/><site name='s' pos='0 0 0.5'/></body><body name='b'><joint name='k' axis='1 0 "
      "0'/><geom name='g' size='0.1'/><site name='t' pos='0.3 0 0'/></body></worldbody>\n"
      "<tendon><fixed name='f' range='0 3' limited='true'><joint joint='j' coef='2'/></fixed>"
      "<spatial margin='0.1'><site site='s'/><geom geom='g' sidesite='t'/><site site='t'/><pulley "
      "divisor='3'/>"
      "<site site='s'/><site site='t'/></spatial>\n"
      "<spatial name='p'><pulley divisor='2'/><site site='s'/><site site='t'/></spatial></tendon>"
      "<equality><connect body1='a' body2='b' anchor='0 0 0.25'/><weld body1='b' "
      "relpose='0 0 2 1 0 0 0'/></equality>"
      "<actuator><velocity joint='k' kv='3' gear='2' ctrlrange='-1 1'/><position tendon='f'/>"
      "</actuator>\n<sensor><jointpos joint='j'/><clock/></sensor><keyframe><key qpos='0.5 1' "
      "ctrl='0.5 2'/></keyframe>");
  ASSERT_TRUE(model) << model.error().to_string();
  ASSERT_EQ(model->loops.size(), 2u);
  EXPECT_EQ(model->loops[0].kind, JointKind::Ball);
  EXPECT_EQ(model->loops[0].frames[0].position, (Vec3d{{0, 0, 0.25}}));
  EXPECT_EQ(model->loops[0].frames[1].position, (Vec3d{{0, 0, 1.25}}));
  EXPECT_EQ(model->loops[1].kind, JointKind::Fixed);
  EXPECT_EQ(model->loops[1].links[1], 0u);  // the world
  ASSERT_EQ(model->mujoco.tendons.size(), 2u);
  EXPECT_EQ(model->mujoco.tendons[0].coefficients, std::vector<double>{2});
  // Coordinates count from where the model stands: 2 x 30 degrees less.
  EXPECT_NEAR((*model->mujoco.tendons[0].range)[1], 3 - std::numbers::pi / 3, 1e-12);
  const robot::MujocoTendon& rope = model->mujoco.tendons[1];
  ASSERT_EQ(rope.wraps.size(), 6u);
  EXPECT_EQ(rope.wraps[1].name, "g_collider");
  EXPECT_EQ(rope.wraps[1].side_site, "t");
  EXPECT_EQ(rope.wraps[3].divisor, 3);
  EXPECT_EQ(rope.settings.at(0).name, "margin");
  ASSERT_EQ(model->mujoco.actuators.size(), 1u);
  EXPECT_EQ(model->mujoco.actuators[0].kind, robot::MujocoActuator::Target::Tendon);
  EXPECT_EQ(model->joints[1].drive->damping, 12);               // kv gear^2
  EXPECT_EQ((*model->joints[1].drive->control_range)[1], 0.5);  // in the joint's own velocity
  ASSERT_EQ(model->mujoco.keyframes.size(), 1u);
  EXPECT_NEAR(model->mujoco.keyframes[0].positions[0], 0.5 - std::numbers::pi / 6, 1e-12);
  EXPECT_EQ(model->mujoco.keyframes[0].controls, (std::vector<double>{0.25, 2}));
  EXPECT_TRUE(model->joints[0].measured);
  EXPECT_FALSE(model->joints[1].measured);
  EXPECT_EQ(found(), "mjcf.reference;mjcf.left-out;mjcf.sensor;");
  EXPECT_EQ(findings_.items()[1].line, 3u);  // the tendon that begins with a pulley
  EXPECT_EQ(findings_.items()[2].line, 4u);  // the sensor of time
}

TEST_F(ReadMjcf, TakesSensorsOfSitesAndJointsAndNamesLinesOfTheRest) {
  const auto model = read(
      "<worldbody><body name='a' pos='0 0 1'><joint name='j' axis='0 1 0'/><geom size='0.1'/>"
      "<site name='s' size='0.05'/><site name='box' type='box' size='1 1 1'/></body>"
      "<body name='f'><freejoint/><geom size='0.1'/><site name='free'/></body></worldbody>\n"
      "<actuator><position name='p' joint='j' kp='3'/></actuator>\n<sensor>\n"
      "<accelerometer name='acc' site='s' cutoff='3'/>\n<gyro site='s' noise='1'/>\n"
      "<force site='s'/><torque site='s'/>\n<touch name='tip' site='s'/>\n<touch site='box'/>\n"
      "<force site='free'/>\n<actuatorfrc actuator='p'/>\n<clock/></sensor>");
  ASSERT_TRUE(model) << model.error().to_string();
  const std::vector<robot::SiteSensor>& sensors = model->links[1].sites.at(0).sensors;
  ASSERT_EQ(sensors.size(), 3u);
  EXPECT_EQ(sensors[0].kind, robot::SiteSensorKind::Imu);
  EXPECT_EQ(sensors[0].name, "acc");
  EXPECT_EQ(sensors[1].kind, robot::SiteSensorKind::ForceTorque);
  EXPECT_EQ(sensors[2].kind, robot::SiteSensorKind::Contact);
  EXPECT_EQ(sensors[2].radius, 0.05);
  EXPECT_TRUE(model->links[1].sites.at(1).sensors.empty());
  EXPECT_TRUE(model->joints[0].measured);
  EXPECT_EQ(found(), "mjcf.sensor;mjcf.sensor;mjcf.sensor;mjcf.touch;");
  EXPECT_EQ(findings_.items()[0].line, 8u);  // what there is no form for: box, free, clock
  EXPECT_NE(findings_.items()[0].message.find("3 sensors are kept"), std::string::npos);
  EXPECT_EQ(findings_.items()[1].line, 4u);  // the cutoff
  EXPECT_EQ(findings_.items()[2].line, 5u);  // the noise
}

/// A picture of one green pixel.
std::string green_png() {
  const unsigned char bytes[] = {
      0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48,
      0x44, 0x52, 0x00, 0x00, 0x00, 0x01, 0x00, 0x00, 0x00, 0x01, 0x08, 0x02, 0x00, 0x00,
      0x00, 0x90, 0x77, 0x53, 0xde, 0x00, 0x00, 0x00, 0x0c, 0x49, 0x44, 0x41, 0x54, 0x78,
      0xda, 0x63, 0x60, 0xf8, 0xcf, 0x00, 0x00, 0x02, 0x02, 0x01, 0x00, 0x45, 0xf4, 0x52,
      0xd4, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};
  return {reinterpret_cast<const char*>(bytes), sizeof(bytes)};
}

TEST_F(ReadMjcf, TakesImagesOfMaterialsAndNamesLinesOfTheRest) {
  const std::string image = path_ + ".png";
  std::ofstream(image, std::ios::binary) << green_png();
  const std::string folder = std::filesystem::temp_directory_path().string();
  const std::string name = std::filesystem::path(image).filename().string();
  const auto model =
      read("<compiler texturedir='" + folder +
           "' strippath='true'/><asset>"
           "<mesh name='sheet' vertex='0 0 0 1 0 0 0 1 0 0 0 1' face='0 2 1 0 3 2 0 1 3 1 2 3' "
           "texcoord='0 1 1 1 0 0.25 0 0'/>"
           "<texture name='t' type='2d' file='lost/" +
           name +
           "' vflip='true'/>"
           "<texture name='c' type='cube' file='" +
           name +
           "'/>"
           "<texture name='b' type='2d' builtin='flat' rgb1='1 0 0' width='4' height='4'/>"
           "<material name='flat' texture='t' texrepeat='2 3.5' rgba='1 0.5 1 1' emission='0.5'/>\n"
           "<material name='wrapped' texture='c'/>\n<material name='painted' texture='b'/>\n"
           "<material name='layered' roughness='0.25' metallic='1' shininess='0.9'>"
           "<layer role='roughness' texture='t'/></material></asset>"
           "<worldbody><geom type='mesh' mesh='sheet' material='flat'/>\n<geom size='1' "
           "material='flat'/></worldbody>");
  std::filesystem::remove(image);
  ASSERT_TRUE(model) << model.error().to_string();
  const robot::Material& flat = model->materials[0];
  EXPECT_EQ(flat.texture, std::filesystem::absolute(image).string());
  EXPECT_TRUE(flat.tinted);
  EXPECT_EQ(flat.texture_scale, (Vec2d{{2, -3.5}}));
  EXPECT_EQ(flat.texture_offset, (Vec2d{{0, 0.5}}));
  EXPECT_EQ(flat.emission, 0.5);
  EXPECT_EQ(*model->materials[1].color, (Vec4d{{0, 1, 0, 1}}));  // of the picture
  EXPECT_EQ(*model->materials[2].color, (Vec4d{{1, 0, 0, 1}}));
  ASSERT_EQ(model->materials[3].images.size(), 1u);
  EXPECT_EQ(model->materials[3].images[0].use, robot::ImageUse::Roughness);
  EXPECT_EQ(model->materials[3].roughness, 0.25);
  ASSERT_EQ(model->meshes[0].texture_coordinates.size(), 12u);
  const std::vector<robot::Visual>& seen = model->links[0].visuals;
  EXPECT_EQ(seen.at(0).material, 0u);
  EXPECT_EQ(model->materials.at(*seen.at(1).material).name, "flat_plain");
  EXPECT_EQ(*model->materials.at(*seen.at(1).material).color, (Vec4d{{0, 0.5, 0, 1}}));
  std::vector<std::uint32_t> lines;
  for (const Diagnostic& finding : findings_) {
    EXPECT_EQ(finding.rule, "mjcf.left-out");
    lines.push_back(finding.line);
  }
  EXPECT_EQ(lines, (std::vector<std::uint32_t>{2, 3, 5, 4}));
}

TEST_F(ReadMjcf, TakesTheWorldThatTheModelBrings) {
  const auto model = read(
      "<option gravity='1 2 3' timestep='0.01' integrator='implicit' iterations='9'>"
      "<flag contact='disable'/></option><worldbody/>");
  ASSERT_TRUE(model) << model.error().to_string();
  const robot::MujocoScene& scene = *model->mujoco.scene;
  EXPECT_EQ(scene.gravity, (std::array<double, 3>{1, 2, 3}));
  EXPECT_EQ(scene.time_step, 0.01);
  ASSERT_EQ(scene.settings.size(), 3u);
  EXPECT_EQ(scene.settings[0].name, "flag:contact");
  EXPECT_EQ(scene.settings[0].numbers, std::vector<double>{0});
  EXPECT_EQ(scene.settings[1].token, "implicit");
  EXPECT_EQ(scene.settings[2].numbers, std::vector<double>{9});
  EXPECT_EQ(found(), "");
}

TEST_F(ReadMjcf, KeepsWhatMJCFAloneHas) {
  const auto model = read(
      "<option timestep='0.001'/><custom><numeric name='n' data='1 2'/></custom>"
      "<worldbody><light pos='0 0 3'/><camera name='c' fovy='20.123456789012345'/>"
      "<body name='a'><joint name='j' ref='0.1'/><joint name='k' type='slide'/>"
      "<geom name='g' size='0.1' group='4'/><site name='s' size='0.001 0.002 0.003'/></body>"
      "</worldbody><actuator><position name='p' joint='j' kp='5'/></actuator>"
      "<sensor><rangefinder site='s'/></sensor>");
  ASSERT_TRUE(model) << model.error().to_string();
  const std::string& text = model->mujoco.source.text;
  for (const char* part :
       {"timestep=\"0.001\"", "<numeric name=\"n\"", "<light ", "fovy=\"20.123456789012344\"",
        "name=\"k\" type=\"slide\"", "group=\"4\"", "size=\"0.001 0.002 0.003\"",
        "<position name=\"p\" joint=\"j\" kp=\"5\"/>", "<rangefinder "}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << " in\n" << text;
  }
  EXPECT_TRUE(model->mujoco.source.files.empty());
}

TEST_F(ReadMjcf, FindsFilesBehindComments) {
  const std::filesystem::path file = std::filesystem::path(path_).replace_extension(".obj");
  std::ofstream(file) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  const auto model =
      read("<!-- \"a\" > b --><asset><mesh name='m' file='" + file.filename().string() +
           "'/></asset><worldbody><!-- c --><geom type='mesh' mesh='m'/></worldbody>");
  std::filesystem::remove(file);
  ASSERT_TRUE(model) << model.error().to_string();
  const std::string& text = model->mujoco.source.text;
  EXPECT_NE(text.find("file=\"?0\""), std::string::npos) << text;
  EXPECT_EQ(model->mujoco.source.files.size(), 1u);
}

TEST_F(ReadMjcf, KeepsTheModelThatMuJoCoMakes) {
  const auto model = read(
      "<compiler fusestatic='true'/><worldbody><body name='a'><freejoint/><geom size='0.1'/>"
      "<body name='b' pos='0 0 1'><geom name='g' size='0.1'/></body></body></worldbody>");
  ASSERT_TRUE(model) << model.error().to_string();
  EXPECT_EQ(model->links.size(), 3u);
  EXPECT_EQ(model->mujoco.source.text.find("<body name=\"b\""), std::string::npos);
}

TEST_F(ReadMjcf, AFileThatIsNotThereIsNamedWithItsPlace) {
  const auto bad = read(
      "<compiler meshdir='../shapes'/><asset><mesh name='t' file='t.obj'/></asset>"
      "<worldbody><geom type='mesh' mesh='t'/></worldbody>");
  ASSERT_FALSE(bad);
  const Diagnostic& told = bad.error().diagnostic();
  EXPECT_EQ(told.rule, "mjcf.missing-file");
  EXPECT_TRUE(told.message.ends_with("/shapes/t.obj")) << told.message;
  EXPECT_EQ(told.message.find(".."), std::string::npos) << told.message;
}

TEST_F(ReadMjcf, SaysWhatMuJoCoRefuses) {
  const auto bad = read("<worldbody>\n<geom type='blob'/></worldbody>");
  ASSERT_FALSE(bad);
  EXPECT_EQ(bad.error().diagnostic().rule, "mjcf.parse");
  EXPECT_EQ(bad.error().diagnostic().line, 2u);
  EXPECT_FALSE(read("<worldbody><body><joint/></body></worldbody>"));  // moves without mass
  EXPECT_EQ(read_mjcf("/nowhere/m.xml", findings_).error().code(), ErrorCode::NotFound);
}

}  // namespace
}  // namespace tenon::mjcf
