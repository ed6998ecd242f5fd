// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/urdf/read_urdf.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include <gtest/gtest.h>
#include <unistd.h>

#include "tenon/robot/kinematic_tree.h"

namespace tenon::urdf {
namespace {

namespace fs = std::filesystem;
using robot::JointKind;

class ReadUrdf : public testing::Test {
 protected:
  /// The model of `elements` below <robot>; nothing and `error_` where there is none.
  std::optional<robot::RobotModel> read(const std::string& elements) {
    findings_ = {};
    auto model =
        read_urdf_text("<robot name=\"r\">\n" + elements + "</robot>\n", "r.urdf", {}, findings_);
    error_ = model ? std::nullopt : std::optional<Error>(model.error());
    return model ? std::optional(*std::move(model)) : std::nullopt;
  }
  /// RULE:LINE of all findings.
  std::string found() const {
    std::string text;
    for (const Diagnostic& finding : findings_) {
      text += finding.rule + ":" + std::to_string(finding.line) + " ";
    }
    return text;
  }
  std::string failed() const {
    return error_ ? error_->diagnostic().rule + ":" + std::to_string(error_->diagnostic().line)
                  : "";
  }

  Diagnostics findings_;
  std::optional<Error> error_;
};

constexpr const char* kTwoLinks = "<link name='a'/><link name='b'/>\n";

std::string joint(const std::string& type, const std::string& inside) {
  return std::string(kTwoLinks) + "<joint name='j' type='" + type +
         "'><parent link='a'/><child link='b'/>" + inside + "</joint>\n";
}

TEST_F(ReadUrdf, TakesInertials) {
  const auto model = read(
      "<link name='a'><inertial><origin xyz='1 2 3' rpy='0 0 1.5'/><mass value='0.14143'/>"
      "<inertia ixx='1' ixy='0.1' ixz='0.2' iyy='2' iyz='0.3' izz='3'/></inertial></link>");
  ASSERT_TRUE(model) << error_->to_string();
  const robot::Inertial& inertial = *model->links[0].inertial;
  EXPECT_EQ(inertial.mass, 0.14143);
  EXPECT_EQ(inertial.center_of_mass, (Vec3d{{1, 2, 3}}));
  EXPECT_EQ(inertial.inertia, (Mat3d{{{{1, 0.1, 0.2}, {0.1, 2, 0.3}, {0.2, 0.3, 3}}}}));
  EXPECT_NEAR(inertial.axes.z, std::sin(0.75), 1e-16);
  EXPECT_EQ(found(), "");
}

TEST_F(ReadUrdf, PlacesAreThoseOfTagsAndAttributesInBytes) {
  // A tab, letters of two bytes and line ends of two bytes come first.
  const std::string text =
      "<robot name=\"r\">\r\n<!-- \xc3\xbc > -->\r\n\t<link name='\xc3\xa4'\r\n   "
      "colour = \"a>b\" name2=''/>\r\n</robot>\r\n";
  Diagnostics findings;
  ASSERT_TRUE(read_urdf_text(text, "r.urdf", {}, findings));
  ASSERT_EQ(findings.size(), 2u);
  const Diagnostic& colour = findings.items()[0];
  EXPECT_EQ(std::tie(colour.line, colour.column, colour.end_line, colour.end_column),
            std::tuple(4, 4, 4, 18));
  const Diagnostic& name = findings.items()[1];
  EXPECT_EQ(std::tie(name.line, name.column, name.end_line, name.end_column),
            std::tuple(4, 19, 4, 27));
  ASSERT_FALSE(read("\t<link nam='a'/>\n"));
  const Diagnostic& fault = error_->diagnostic();
  EXPECT_EQ(std::tie(fault.line, fault.column, fault.end_line, fault.end_column),
            std::tuple(2, 2, 2, 17));
}

TEST_F(ReadUrdf, TheModelKnowsThePlacesOfItsParts) {
  const auto model = read(
      "<link name='a'> <inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1'/></inertial>"
      "</link>\n  <link name='b'/><joint name='j' type='fixed'\n><parent link='a'/>"
      "<child link='b'/></joint>");
  ASSERT_TRUE(model) << error_->to_string();
  const auto places = [](const robot::Place& place) {
    return std::tuple(place.line, place.column, place.end_line, place.end_column);
  };
  EXPECT_EQ(places(model->links[0].place), std::tuple(2, 1, 2, 16));
  EXPECT_EQ(places(model->links[0].inertial->place), std::tuple(2, 17, 2, 27));
  EXPECT_EQ(places(model->links[1].place), std::tuple(3, 3, 3, 19));
  EXPECT_EQ(places(model->joints[0].place), std::tuple(3, 19, 4, 2));
}

TEST_F(ReadUrdf, TurnsByRollPitchYawAboutFixedAxes) {
  const auto model =
      read(joint("fixed", "<origin rpy='1.5707963267948966 0 1.5707963267948966'/>"));
  // Roll takes y to z; yaw leaves z.
  const Vec3d y = rotate(model->joints[0].origin.orientation, {{0, 1, 0}});
  EXPECT_NEAR(y[2], 1, 1e-15);
  const Vec3d x = rotate(model->joints[0].origin.orientation, {{1, 0, 0}});
  EXPECT_NEAR(x[1], 1, 1e-15);
}

TEST_F(ReadUrdf, TakesShapesAndMaterials) {
  const auto model = read(
      "<material name='red'><color rgba='1 0 0 1'/></material>\n"
      "<link name='a'><visual name='v'><origin xyz='0 0 1'/><geometry><box size='2 4 6'/>"
      "</geometry><material name='red'/></visual>\n"
      "<visual><geometry><sphere radius='3'/></geometry><material name='later'/></visual>\n"
      "<collision><geometry><cylinder radius='1' length='4'/></geometry></collision>\n"
      "<collision><geometry><capsule radius='1' length='6'/></geometry></collision></link>\n"
      "<link name='b'><visual><geometry><box size='1 1 1'/></geometry>"
      "<material name='later'><color rgba='0 1 2 1'/></material></visual></link>\n");
  ASSERT_TRUE(model) << error_->to_string();
  const robot::Link& link = model->links[0];
  EXPECT_EQ(link.visuals[0].name, "v");
  EXPECT_EQ(link.visuals[0].geometry.half_extents, (Vec3d{{1, 2, 3}}));
  EXPECT_EQ(model->materials[*link.visuals[0].material].color, (Vec4d{{1, 0, 0, 1}}));
  EXPECT_EQ(model->materials[*link.visuals[1].material].name, "later");
  EXPECT_EQ(model->materials.size(), 2u);
  EXPECT_EQ(link.colliders[0].geometry.half_height, 2);
  EXPECT_EQ(link.colliders[1].geometry.half_height, 3);
  EXPECT_EQ(found(), "urdf.color:7 urdf.color:7 ");
}

TEST_F(ReadUrdf, TakesAllKindsOfJoints) {
  struct Row {
    const char* type;
    JointKind kind;
  };
  for (const Row& row : {Row{"fixed", JointKind::Fixed},
                         {"continuous", JointKind::Continuous},
                         {"floating", JointKind::Floating},
                         {"planar", JointKind::Planar},
                         {"spherical", JointKind::Ball}}) {
    const auto model = read(joint(row.type, ""));
    ASSERT_TRUE(model) << row.type;
    EXPECT_EQ(model->joints[0].kind, row.kind);
    EXPECT_EQ(found(), "");
  }
  EXPECT_FALSE(read(joint("gear", "")));
  EXPECT_EQ(failed(), "urdf.joint-type:3");
}

TEST_F(ReadUrdf, TakesEveryNumberOfAJoint) {
  const auto model = read(
      joint("revolute",
            "<origin xyz='1 2 3'/><axis xyz='0 0 -1'/>"
            "<limit lower='-0.1' upper='1.3' effort='7' velocity='0.5'/>"
            "<dynamics damping='0.25' friction='0.125'/><calibration rising='0.5'/>"
            "<safety_controller soft_lower_limit='-0.05' k_position='10' k_velocity='20'/>") +
      "<link name='c'/><joint name='k' type='prismatic'><parent link='b'/><child link='c'/>"
      "<limit upper='2' effort='0' velocity='0'/><mimic joint='j' multiplier='-2' offset='0.5'/>"
      "</joint>");
  ASSERT_TRUE(model) << error_->to_string();
  const robot::Joint& j = model->joints[0];
  EXPECT_EQ(j.origin.position, (Vec3d{{1, 2, 3}}));
  EXPECT_EQ(j.axis, (Vec3d{{0, 0, -1}}));
  EXPECT_EQ(j.limit->lower, -0.1);
  EXPECT_EQ(j.limit->upper, 1.3);
  EXPECT_EQ(j.effort_limit, 7);
  EXPECT_EQ(j.velocity_limit, 0.5);
  EXPECT_EQ(j.damping, 0.25);
  EXPECT_EQ(j.friction, 0.125);
  EXPECT_EQ(j.calibration->rising, 0.5);
  EXPECT_FALSE(j.calibration->falling);
  EXPECT_EQ(j.safety->soft_lower, -0.05);
  EXPECT_FALSE(j.safety->soft_upper);
  EXPECT_EQ(j.safety->velocity_gain, 20);
  const robot::Joint& k = model->joints[1];
  EXPECT_EQ(k.axis, (Vec3d{{1, 0, 0}}));
  EXPECT_EQ(k.limit->lower, 0);
  EXPECT_EQ(k.effort_limit, robot::kUnlimited);
  EXPECT_EQ(k.mimic->leader, 0u);
  EXPECT_EQ(k.mimic->multiplier, -2);
  EXPECT_EQ(k.mimic->offset, 0.5);
  EXPECT_EQ(found(), "urdf.zero-limit:4 ");
}

TEST_F(ReadUrdf, TakesALimitWithoutBoundsAsNone) {
  const auto model = read(joint("revolute", "<limit effort='1' velocity='2'/>"));
  ASSERT_TRUE(model);
  EXPECT_FALSE(model->joints[0].limit);
  EXPECT_EQ(model->joints[0].effort_limit, 1);
  EXPECT_EQ(found(), "urdf.missing:3 ");
}

// What this program writes for none is read as none.
TEST_F(ReadUrdf, TakesALimitOfABillionAsNone) {
  const auto open = read(
      joint("prismatic", "<limit lower='-1e9' upper='1e9' effort='1000000000' velocity='1e9'/>"));
  ASSERT_TRUE(open);
  EXPECT_FALSE(open->joints[0].limit);
  EXPECT_EQ(open->joints[0].effort_limit, robot::kUnlimited);
  EXPECT_EQ(open->joints[0].velocity_limit, robot::kUnlimited);
  const auto half = read(joint("revolute", "<limit lower='-1' upper='1e9'/>"));
  ASSERT_TRUE(half);
  EXPECT_EQ(half->joints[0].limit->lower, -1);
  EXPECT_EQ(half->joints[0].limit->upper, robot::kUnlimited);
}

TEST_F(ReadUrdf, ListsWhatItLeavesOut) {
  ASSERT_TRUE(
      read("<link name='a' color='red'>\n<visual><geometry><box size='1 1 1'/></geometry>\n"
           "<shadow/></visual></link>\n<gazebo/>\n<transmission name='t'/>\n"
           "<mujoco/>\n<plugin/>\n"));
  EXPECT_EQ(found(),
            "urdf.left-out:8 urdf.left-out:2 urdf.left-out:4 urdf.extension:5 urdf.extension:6 "
            "urdf.extension:7 ");
  ASSERT_TRUE(read(joint("revolute", "")));
  EXPECT_EQ(found(), "urdf.missing:3 ");
}

TEST_F(ReadUrdf, TakesWhatGazeboSaysOfLinks) {
  const auto model = read(
      "<link name='a'><visual><geometry><box size='1 1 1'/></geometry></visual>\n"
      "<collision><geometry><box size='1 1 1'/></geometry></collision></link>\n"
      "<gazebo reference='a'><material> Gazebo/Red </material><mu1>0.7</mu1>"
      "<mu2 value='0.7'/><gravity>false</gravity><kp>2e5</kp><kd>30</kd></gazebo>\n");
  ASSERT_TRUE(model);
  EXPECT_EQ(found(), "");
  const robot::Link& link = model->links[0];
  EXPECT_EQ(link.gravity_scale, 0);
  EXPECT_EQ(link.colliders[0].surface.dynamic_friction, 0.7);
  EXPECT_EQ(link.colliders[0].surface.contact_stiffness, 2e5);
  EXPECT_EQ(link.colliders[0].surface.contact_damping, 30);
  ASSERT_TRUE(link.visuals[0].material);
  EXPECT_EQ(model->materials[*link.visuals[0].material].color, (Vec4d{{1, 0, 0, 1}}));
}

TEST_F(ReadUrdf, TakesSensorsOfGazebo) {
  const auto model =
      read(joint("fixed", "") +
           "<gazebo reference='b'><sensor name='eye' type='depth'><pose>1 2 3 0 0 0</pose><camera>"
           "<horizontal_fov>1</horizontal_fov><image><width>64</width><height>32</height></image>"
           "</camera></sensor><sensor name='imu' type='imu'><update_rate>50</update_rate></sensor>"
           "</gazebo><gazebo reference='j'><sensor name='ft' type='force_torque'/></gazebo>\n");
  ASSERT_TRUE(model);
  EXPECT_EQ(found(), "");
  const robot::Link& link = model->links[1];
  ASSERT_EQ(link.cameras.size(), 1u);
  const robot::Camera& camera = link.cameras[0];
  EXPECT_EQ(camera.pose.position, (Vec3d{{1, 2, 3}}));
  // Looks along x, up is z.
  EXPECT_NEAR(rotate(camera.pose.orientation, {{0, 0, -1}})[0], 1, 1e-15);
  EXPECT_NEAR(rotate(camera.pose.orientation, {{0, 1, 0}})[2], 1, 1e-15);
  EXPECT_NEAR(camera.aperture[0] / 2 / camera.focal_length, std::tan(0.5), 1e-12);
  EXPECT_EQ(camera.aperture[0], 2 * camera.aperture[1]);
  ASSERT_EQ(link.sites.size(), 2u);
  EXPECT_EQ(link.sites[0].sensors[0].period, 0.02);
  EXPECT_EQ(link.sites[1].sensors[0].kind, robot::SiteSensorKind::ForceTorque);
}

TEST_F(ReadUrdf, TakesSensorsThatNameTheirLinkOrJoint) {
  const auto model = read(
      joint("fixed", "") +
      "<gazebo reference='j'><sensor name='ft' type='force_torque'/></gazebo>"
      "<sensor name='acc' type='accelerometer'><parent link='b'/><origin xyz='1 2 3'/></sensor>"
      "<sensor name='ft' type='force_torque'><parent joint='j'/></sensor>\n"
      "<sensor name='turn' type='gyroscope'><parent link='a'/><noise/></sensor>\n"
      "<sensor name='eye' type='camera'><parent link='a'/></sensor>\n"
      "<sensor name='lost' type='imu'><parent link='c'/></sensor>\n");
  ASSERT_TRUE(model);
  EXPECT_EQ(found(), "urdf.extension:5 urdf.extension:6 urdf.extension:7 ");
  EXPECT_NE(findings_.items()[0].message.find("\"turn\" (gyroscope) without its noise"),
            std::string::npos);
  const robot::Link& hand = model->links[1];
  ASSERT_EQ(hand.sites.size(), 2u);  // Gazebo defines the force and torque, too
  EXPECT_EQ(hand.sites[0].sensors[0].kind, robot::SiteSensorKind::ForceTorque);
  EXPECT_EQ(hand.sites[1].sensors[0].kind, robot::SiteSensorKind::Imu);
  EXPECT_EQ(hand.sites[1].pose.position, (Vec3d{{1, 2, 3}}));
  EXPECT_EQ(model->links[0].sites.at(0).sensors[0].kind, robot::SiteSensorKind::Imu);
}

TEST_F(ReadUrdf, TakesLaserScannersOfGazebo) {
  const std::string scan =
      "<scan><horizontal><samples>3</samples><min_angle>-1</min_angle><max_angle>1</max_angle>"
      "</horizontal><vertical><samples>2</samples><min_angle>0</min_angle><max_angle>0.5"
      "</max_angle></vertical></scan><range><min>0.1</min><max>30</max></range>";
  const auto model =
      read("<link name='a'/><gazebo reference='a'><sensor name='s' type='gpu_lidar'><lidar>" +
           scan + "</lidar></sensor></gazebo>\n");
  ASSERT_TRUE(model);
  EXPECT_EQ(found(), "");
  const robot::SiteSensor& rays = model->links[0].sites.at(0).sensors.at(0);
  EXPECT_EQ(rays.kind, robot::SiteSensorKind::Rays);
  EXPECT_EQ(rays.min_range, 0.1);
  EXPECT_EQ(rays.max_range, 30);
  ASSERT_EQ(rays.directions.size(), 6u);
  EXPECT_EQ(rays.directions[1], (Vec3d{{1, 0, 0}}));  // straight ahead, the lower row
  EXPECT_NEAR(rays.directions[5][0], std::cos(0.5) * std::cos(1), 1e-15);
  EXPECT_NEAR(rays.directions[5][1], std::cos(0.5) * std::sin(1), 1e-15);
  EXPECT_NEAR(rays.directions[5][2], std::sin(0.5), 1e-15);
  // Where it makes no sense, or asks for too much, it is named.
  for (const char* samples : {"0", "1e9", "many"}) {
    const std::string bad = "<scan><horizontal><samples>" + std::string(samples) +
                            "</samples><min_angle>0</min_angle><max_angle>1</max_angle>"
                            "</horizontal></scan>";
    const auto without = read(
        "<link name='a'/><gazebo reference='a'><sensor name='s' type='ray'>"
        "<ray>" +
        bad + "</ray></sensor></gazebo>\n");
    ASSERT_TRUE(without);
    EXPECT_TRUE(without->links[0].sites.empty()) << samples;
    EXPECT_EQ(found(), "urdf.extension:2 ") << samples;
  }
}

TEST_F(ReadUrdf, NamesSettingsOfGazeboThatItLeavesOut) {
  ASSERT_TRUE(
      read("<link name='a'/>\n<gazebo reference='a'><mu1>much</mu1><mu2>1</mu2><kp>1</kp>"
           "<sensor name='s' type='ray'/><sensor name='t' type='camera'/>"
           "<sensor name='u' type='imu'><pose>1 2</pose></sensor></gazebo>\n"
           "<gazebo reference='b'/>\n<gazebo/>\n"));
  EXPECT_EQ(found(), "urdf.extension:3 urdf.extension:4 urdf.extension:5 ");
  const std::string said = findings_.begin()->message;
  for (const char* part : {"mu1, mu2, kp", "\"s\" (ray)", "\"t\" (camera)", "\"u\" (imu)"}) {
    EXPECT_NE(said.find(part), std::string::npos) << said;
  }
}

TEST_F(ReadUrdf, LeavesOutAMimicOfNoJointAndATextureOfNoFile) {
  const auto model = read(joint("fixed", "<mimic joint='x'/>") +
                          "<material name='m'><color rgba='1 0 0 1'/><texture/></material>");
  ASSERT_TRUE(model) << error_->to_string();
  EXPECT_FALSE(model->joints[0].mimic);
  EXPECT_EQ(found(), "urdf.missing:4 urdf.joint-missing:3 ");
}

TEST_F(ReadUrdf, SaysWhatIsWrongAndWhere) {
  struct Row {
    std::string text;
    std::string failure;
  };
  const Row rows[] = {
      {"<link name='a'>", "urdf.xml:2"},
      {"<link/>", "urdf.missing:2"},
      {"<link name='a'>\n<inertial>\n<mass value='one'/></inertial></link>", "urdf.number:4"},
      {"<link name='a'><visual><geometry><box size='1 1'/></geometry></visual></link>",
       "urdf.number:2"},
      {joint("fixed", "<origin xyz='1 2 3 4'/>"), "urdf.number:3"},
      {"<joint name='j' type='fixed'><parent link='a'/></joint>", "urdf.link-missing:2"},
      {"<xacro:macro name='m'/>", "urdf.xacro:2"},
      {joint("fixed", "<origin xyz='${length} 0 0'/>"), "urdf.xacro:3"},
  };
  for (const Row& row : rows) {
    EXPECT_FALSE(read(row.text)) << row.text;
    EXPECT_EQ(failed(), row.failure) << row.text;
  }
  EXPECT_EQ(read_urdf_text("<mujoco/>", "m.xml", {}, findings_).error().diagnostic().rule,
            "urdf.root");
  EXPECT_EQ(read_urdf_text("", "m.xml", {}, findings_).error().diagnostic().rule, "urdf.xml");
  EXPECT_EQ(read_urdf("/nowhere/x.urdf", {}, findings_).error().code(), ErrorCode::NotFound);
}

TEST_F(ReadUrdf, ABadColourCostsTheColour) {
  const auto model = read(
      "<material name='m'><color rgba='1 0 0 0 1'/></material>\n"
      "<link name='a'><visual><geometry><box size='1 1 1'/></geometry>"
      "<material name='m'/></visual></link>");
  ASSERT_TRUE(model) << error_->to_string();
  EXPECT_EQ(found(), "urdf.color:2 ");
  EXPECT_FALSE(model->links[0].visuals[0].material);
  EXPECT_FALSE(read("<material name='m'><color rgba='${red}'/></material>"));
  EXPECT_EQ(failed(), "urdf.xacro:2");
}

TEST_F(ReadUrdf, CommasBetweenNumbersAreToldAndInJointsRefused) {
  const auto model = read(
      "<link name='a'><visual><origin xyz='1, 2, 3' rpy='0 0, 0'/>"
      "<geometry><box size='1,2,3'/></geometry></visual></link>");
  ASSERT_TRUE(model) << error_->to_string();
  EXPECT_EQ(found(), "urdf.comma:2 urdf.comma:2 urdf.comma:2 ");
  EXPECT_EQ(model->links[0].visuals[0].pose.position, (Vec3d{{1, 2, 3}}));
  EXPECT_EQ(model->links[0].visuals[0].geometry.half_extents, (Vec3d{{0.5, 1, 1.5}}));
  EXPECT_FALSE(read("<link name='a'><visual><origin xyz='0,5 1'/></visual></link>"));
  EXPECT_EQ(failed(), "urdf.number:2");
  EXPECT_FALSE(read(joint("fixed", "<origin xyz='0, 0 1'/>")));
  EXPECT_EQ(failed(), "urdf.number:3");
}

TEST_F(ReadUrdf, LeavesOutShapesAndInertialsThatSayNothingAndKeepsTheLink) {
  const auto model = read(
      "<link name='a'>\n<inertial><inertia ixx='1' iyy='1' izz='1'/></inertial>\n"
      "<visual><geometry/></visual>\n<visual/>\n"
      "<collision><geometry><plane normal='0 0 1'/></geometry></collision>\n"
      "<collision><geometry><box size='1 1 1'/></geometry></collision></link>\n"
      "<link name='b'><inertial><mass value='2'/></inertial></link>");
  ASSERT_TRUE(model) << error_->to_string();
  EXPECT_EQ(found(), "urdf.missing:3 urdf.shape:4 urdf.missing:5 urdf.left-out:6 urdf.shape:6 ");
  EXPECT_FALSE(model->links[0].inertial);
  EXPECT_TRUE(model->links[0].visuals.empty());
  EXPECT_EQ(model->links[0].colliders.size(), 1u);
  EXPECT_EQ(model->links[1].inertial->mass, 2);
  EXPECT_EQ(model->links[1].inertial->inertia, Mat3d{});
}

TEST_F(ReadUrdf, RefusesXmlThatIsNotWellFormed) {
  const std::string robot = "<robot name='a'><link name='l'/></robot>";
  const std::string broken[] = {
      robot + " text",
      robot + robot,
      "\n<?xml version='1.0'?>" + robot,
      "<robot name='a' name='b'/>",
      "<robot name='a'><!-- a -- b --></robot>",
      "<robot name='a'><link name='l&foo;'/></robot>",
      "<robot name='a'><link name='l<'/></robot>",
      "<robot name='a'>a & b</robot>",
      "<robot name='a'>]]></robot>",
  };
  for (const std::string& text : broken) {
    const auto model = read_urdf_text(text, "r.urdf", {}, findings_);
    ASSERT_FALSE(model) << text;
    EXPECT_EQ(model.error().diagnostic().rule, "urdf.xml") << text;
  }
  const std::string sound[] = {
      "\xEF\xBB\xBF<?xml version='1.0'?>\n<!-- a --><robot name='a&amp;b'/>\n<!-- b -->\n",
      "<!DOCTYPE robot [<!ENTITY e 'x'>]><robot name='a'>&e;<![CDATA[a & b <]]></robot>",
      "<robot name='a'><link name='x>y' /><link name = 'z'></link>&#65;</robot >",
  };
  for (const std::string& text : sound) {
    EXPECT_TRUE(read_urdf_text(text, "r.urdf", {}, findings_)) << text;
  }
}

TEST_F(ReadUrdf, FindsMeshesNearbyByTheEndOfTheirNames) {
  const fs::path root = fs::temp_directory_path() / ("tenon_urdf_near_" + std::to_string(getpid()));
  fs::create_directories(root / "robot/urdf");
  fs::create_directories(root / "robot/meshes/visual");
  std::ofstream(root / "robot/meshes/visual/a.stl") << "x";
  std::ofstream(root / "robot/urdf/a.stl") << "x";
  std::ofstream(root / "robot/urdf/r.urdf")
      << "<robot name='r'><link name='a'>\n<visual><geometry>"
         "<mesh filename='package://hand_description/meshes/visual/a.stl'/></geometry></visual>\n"
         "<visual><geometry><mesh filename='/home/me/ws/meshes/a.stl'/></geometry></visual>\n"
         "<visual><geometry><mesh filename='package://given/a.stl'/></geometry></visual>\n"
         "</link></robot>";
  const bytes::ReadPolicy reading({(root / "robot").string()});
  const UrdfOptions options{{{"given", (root / "robot").string()}}, {}, reading};
  const auto model = read_urdf((root / "robot/urdf/r.urdf").string(), options, findings_);
  ASSERT_TRUE(model) << model.error().to_string();
  EXPECT_EQ(model->meshes[0].path, (root / "robot/meshes/visual/a.stl").string());
  EXPECT_EQ(model->meshes[1].path, (root / "robot/urdf/a.stl").string());
  EXPECT_EQ(found(), "urdf.mesh-nearby:2 urdf.mesh-nearby:3 urdf.mesh-missing:4 ");
  fs::remove_all(root);
}

TEST_F(ReadUrdf, FindsMeshesOfPackages) {
  const fs::path root = fs::temp_directory_path() / ("tenon_urdf_" + std::to_string(getpid()));
  fs::create_directories(root / "pkg_folder/urdf");
  fs::create_directories(root / "pkg_folder/meshes");
  fs::create_directories(root / "other");
  std::ofstream(root / "pkg_folder/package.xml") << "<package><name>hand</name></package>";
  std::ofstream(root / "pkg_folder/meshes/a.stl") << "x";
  std::ofstream(root / "other/b.stl") << "x";
  const auto shape = [](const std::string& file) {
    return "<visual><geometry><mesh filename='" + file + "' scale='1 2 -3'/></geometry></visual>\n";
  };
  std::ofstream(root / "pkg_folder/urdf/r.urdf")
      << "<robot name='r'><link name='a'>\n"
      << shape("package://hand/meshes/a.stl") << shape("../meshes/a.stl")
      << shape("file://" + (root / "other/b.stl").string()) << shape("package://elsewhere/b.stl")
      << shape("package://none/b.stl") << "</link></robot>";
  const std::string file = (root / "pkg_folder/urdf/r.urdf").string();
  const std::string other = (root / "other").string();
  const bytes::ReadPolicy reading({(root / "pkg_folder/urdf").string(), other});
  const auto model = read_urdf(file, {{{"elsewhere", other}}, {}, reading}, findings_);
  ASSERT_TRUE(model) << model.error().to_string();
  ASSERT_EQ(model->links[0].visuals.size(), 4u);
  EXPECT_EQ(model->links[0].visuals[0].geometry.scale, (Vec3d{{1, 2, -3}}));
  EXPECT_EQ(model->meshes[0].path, model->meshes[1].path);
  EXPECT_TRUE(model->meshes[3].path.ends_with("other/b.stl"));
  EXPECT_EQ(found(), "urdf.mesh-missing:6 ");
  EXPECT_NE(findings_.items()[0].fix.find("--package none=DIR"), std::string::npos);
  EXPECT_EQ(model->parts_folders, std::vector<std::string>{(root / "pkg_folder").string()});
  fs::remove_all(root);
}

TEST_F(ReadUrdf, LeavesOutMeshesThatLieOutside) {
  const fs::path root = fs::temp_directory_path() / ("tenon_urdf_out_" + std::to_string(getpid()));
  fs::create_directories(root / "robot/own");
  fs::create_directories(root / "secret/meshes");
  fs::create_directories(root / "meshes");
  for (const char* name : {"secret/a.stl", "meshes/b.stl"}) {
    std::ofstream(root / name) << "x";
  }
  fs::create_symlink(root / "secret/a.stl", root / "robot/link.stl");
  std::string shapes;
  for (const std::string& name :
       {std::string("../secret/a.stl"), (root / "secret/a.stl").string(),
        "file://" + (root / "secret/a.stl").string(), std::string("package://secret/a.stl"),
        std::string("package://robot/../secret/a.stl"), std::string("link.stl"),
        std::string("../meshes/b.stl")}) {
    shapes += "<visual><geometry><mesh filename='" + name + "'/></geometry></visual>\n";
  }
  std::ofstream(root / "robot/r.urdf")
      << "<robot name='r'><link name='a'>" << shapes << "</link></robot>";
  const bytes::ReadPolicy reading({(root / "robot").string()});
  const auto model = read_urdf((root / "robot/r.urdf").string(), {{}, {}, reading}, findings_);
  ASSERT_TRUE(model) << model.error().to_string();
  EXPECT_EQ(model->links[0].visuals.size(), 1u);  // what is next to it by convention
  ASSERT_EQ(findings_.size(), 6u);
  for (const Diagnostic& finding : findings_) {
    EXPECT_EQ(finding.rule, bytes::kOutsideRule);
    EXPECT_EQ(finding.severity, Severity::Error);
    EXPECT_NE(finding.fix.find("--allow-read"), std::string::npos);
  }
  fs::remove_all(root);
}

TEST_F(ReadUrdf, StandsDeepAndWideInput) {
  std::string deep;
  for (int i = 0; i < 1'000'000; ++i) {
    deep += "<a>";
  }
  EXPECT_FALSE(read(deep));
  std::string chain = "<link name='l0'/>";
  for (int i = 1; i < 20'000; ++i) {
    const std::string n = std::to_string(i);
    chain += "<link name='l" + n + "'/><joint name='j" + n + "' type='continuous'><parent link='l" +
             std::to_string(i - 1) + "'/><child link='l" + n + "'/></joint><unknown/>";
  }
  const auto model = read(chain);
  ASSERT_TRUE(model);
  EXPECT_TRUE(robot::kinematic_tree(*model));
  EXPECT_EQ(findings_.size(), 10'000u);
}

}  // namespace
}  // namespace tenon::urdf
