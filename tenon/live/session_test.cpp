// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/live/session.h"

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "tenon/bytes/read_record.h"
#include "tenon/live/test_told.h"
#include "tenon/make_simulation.h"

namespace tenon::live {
namespace {

namespace fs = std::filesystem;

constexpr const char* kBase = R"(#usda 1.0
(
    defaultPrim = "Arm"
    metersPerUnit = 1
    upAxis = "Z"
)
def Xform "Arm" (
    prepend variantSets = "Load"
    variants = {
        string Load = "light"
    }
)
{
    def Cube "base" (prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"])
    {
        double size = 0.1
        bool physics:kinematicEnabled = 1
    }
    def Cube "link" (prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"])
    {
        double size = 0.1
        float physics:mass = 0.5
        double3 xformOp:translate = (0.2, 0, 0)
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }
    def PhysicsRevoluteJoint "hinge" (prepend apiSchemas = ["PhysicsDriveAPI:angular"])
    {
        rel physics:body0 = </Arm/base>
        rel physics:body1 = </Arm/link>
        uniform token physics:axis = "Y"
        point3f physics:localPos1 = (-0.2, 0, 0)
        float physics:lowerLimit = -90
        float physics:upperLimit = 90
        float drive:angular:physics:stiffness = 0.3
        float drive:angular:physics:damping = 0.05
    }
    variantSet "Load" = {
        "heavy" {
            over "base"
            {
                float physics:mass = 2
            }
        }
        "light" {
        }
    }
}
)";
constexpr const char* kRoot = R"(#usda 1.0
(
    defaultPrim = "Arm"
    metersPerUnit = 1
    upAxis = "Z"
    subLayers = [@./base.usda@]
)
)";

std::string text_of(const fs::path& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

class SessionTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!engine_info("mujoco").available) {
      GTEST_SKIP() << "without MuJoCo";
    }
    folder_ =
        fs::path(::testing::TempDir()) /
        (std::string("live_") + ::testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    write("base.usda", kBase);
    write("root.usda", kRoot);
    record_.install();
    open();
  }
  void write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
  }
  void open(bool read_only = false) {
    SessionOptions options;
    options.asset.path = (folder_ / "root.usda").string();
    options.asset.picture = [this](const stage::Stage&,
                                   const scene::PhysicsScene&) -> Result<std::string> {
      return "picture " + std::to_string(++pictures_);
    };
    options.version = "1";
    options.watch = true;
    if (!read_only) {
      options.write = [](const std::vector<EditedFile>& files) { return write_files(files); };
    }
    auto session = Session::open(std::move(options));
    ASSERT_TRUE(session) << session.error().to_string();
    session_.emplace(*std::move(session));
    Outbox out;
    session_->greet(1, out);
    take(out);
  }
  void take(Outbox& out) {
    for (const Outbox::Message& message : out.messages) {
      const Json json = Json::parse(message.text);
      expect_as_told(json);
      told_[json["is"].get<std::string>()] = json;
    }
    if (out.frame) {
      frame_.resize(out.frame->size() / sizeof(float));
      std::memcpy(frame_.data(), out.frame->data(), out.frame->size());
    }
    picture_ = out.picture == nullptr ? picture_ : *out.picture;
  }
  /// The result, or the rule of the error.
  Json ask(const Json& request) {
    Outbox out;
    session_->hear(1, request.dump(), out);
    for (const LateAnswer& late : std::exchange(out.late, {})) {
      session_->answer_late(late, late.make(), out);
    }
    told_.erase("error");
    take(out);
    if (!told_.contains("error")) {
      return told_["answer"]["result"];
    }
    const Json& error = told_["error"]["error"];
    return error["rule"].is_null() ? error["message"] : error["rule"];
  }
  void advance(double seconds) {
    for (double passed = 0; passed < seconds; passed += 0.02) {
      Outbox out;
      session_->advance(0.02, out);
      take(out);
    }
  }
  double angle() const { return session_->asset().world->joint_state(0).position[0]; }

  bytes::ReadRecord record_;
  fs::path folder_;
  std::optional<Session> session_;
  std::map<std::string, Json> told_;
  std::vector<float> frame_;
  std::string picture_;
  int pictures_ = 0;
};

TEST_F(SessionTest, GreetsWithWhatThereIs) {
  EXPECT_EQ(told_["hello"]["protocol"], kProtocol);
  EXPECT_EQ(told_["hello"]["readOnly"], false);
  const Json& scene = told_["scene"];
  EXPECT_EQ(scene["bodies"], Json::array({"/Arm/base", "/Arm/link"}));
  EXPECT_EQ(scene["joints"][0]["path"], "/Arm/hinge");
  EXPECT_NEAR(scene["joints"][0]["dofs"][0]["upper"].get<double>(), std::acos(0.0), 1e-6);
  EXPECT_EQ(scene["variants"][0]["options"], Json::array({"heavy", "light"}));
  EXPECT_EQ(scene["engine"], "mujoco");
  EXPECT_EQ(told_["state"]["playing"], false);
  ASSERT_EQ(frame_.size(), 1u + 2u * 7u);
  EXPECT_FLOAT_EQ(frame_[8], 0.2f);  // x of the link
  EXPECT_FLOAT_EQ(frame_[14], 1);    // w
}

TEST_F(SessionTest, LetsTimeGoOnWhileItPlays) {
  advance(0.1);
  EXPECT_EQ(session_->asset().world->time(), 0);
  ask({{"do", "play"}});
  EXPECT_TRUE(session_->is_playing());
  advance(0.5);
  EXPECT_NEAR(session_->asset().world->time(), 0.5, 0.03);
  EXPECT_NEAR(frame_[0], 0.5, 0.03);
  ask({{"do", "speed"}, {"factor", 0.1}});
  advance(0.5);
  EXPECT_NEAR(session_->asset().world->time(), 0.55, 0.03);
  ask({{"do", "pause"}});
  const double time = session_->asset().world->time();
  ask({{"do", "step"}, {"count", 10}});
  EXPECT_NEAR(session_->asset().world->time(), time + 10 * session_->asset().world->time_step(),
              1e-9);
  ask({{"do", "reset"}});
  EXPECT_EQ(session_->asset().world->time(), 0);
  EXPECT_EQ(told_["scene"]["why"], "reset");
}

TEST_F(SessionTest, DrivesReachTheirTargets) {
  ask({{"do", "setDrive"}, {"joint", "/Arm/hinge"}, {"position", -0.5}});
  ask({{"do", "step"}, {"count", 1000}});
  ask({{"do", "step"}, {"count", 1000}});
  const double sag = angle() + 0.5;  // gravity against a spring that is not stiff
  EXPECT_LT(std::abs(sag), 0.2);
  EXPECT_EQ(ask({{"do", "setDrive"}, {"joint", "/Arm/hinge"}, {"drive", 3}}), "live.refused");
  EXPECT_EQ(ask({{"do", "setDrive"}, {"joint", "/Arm/none"}}), "live.not-found");
}

TEST_F(SessionTest, TellsWhatIsWrongWithARunUnlessSomebodyActs) {
  std::string text = kBase;
  text.insert(text.find("        float drive:angular:physics:damping"),
              "        float drive:angular:physics:maxForce = 0.1\n");
  text.replace(text.find("upperLimit = 90"), 15, "upperLimit = 60");
  write("base.usda", text);
  open();
  ask({{"do", "play"}});
  advance(0.5);
  EXPECT_FALSE(told_.contains("problem")) << "it moves still";
  advance(9);
  ASSERT_TRUE(told_.contains("problem"));
  EXPECT_EQ(told_["problem"]["problem"]["rule"], "sim.drive-sags");
  EXPECT_EQ(told_["problem"]["problem"]["prim"], "/Arm/hinge");
  told_.erase("problem");
  advance(3);
  EXPECT_FALSE(told_.contains("problem")) << "once is enough";
  ask({{"do", "reset"}});
  ask({{"do", "setDrive"}, {"joint", "/Arm/hinge"}, {"position", 0}});
  ask({{"do", "play"}});
  advance(9);
  EXPECT_FALSE(told_.contains("problem"));
}

TEST_F(SessionTest, KeepsTheLastPosesAndNamesTheBodyWhenAStepFails) {
  std::string text = kBase;
  text.insert(text.find("        float physics:mass = 0.5"),
              "        vector3f physics:velocity = (0, 0, 1e12)\n");
  write("base.usda", text);
  open();
  const std::vector<float> before = frame_;
  EXPECT_TRUE(told_["state"]["stopped"].is_null());
  EXPECT_EQ(ask({{"do", "step"}, {"count", 20}}), "mujoco.unstable");
  EXPECT_EQ(told_["problem"]["problem"]["rule"], "mujoco.unstable");
  EXPECT_EQ(told_["state"]["stopped"]["prim"], "/Arm/link");
  EXPECT_EQ(frame_, before);
  EXPECT_EQ(ask({{"do", "play"}}), "live.stopped");
  EXPECT_EQ(ask({{"do", "step"}}), "live.stopped");
  EXPECT_EQ(ask({{"do", "setJoint"}, {"joint", "/Arm/hinge"}, {"position", {0}}}), "live.stopped");
  Outbox out;
  frame_.clear();
  session_->greet(2, out);  // who comes later sees the same
  take(out);
  EXPECT_EQ(frame_, before);
  EXPECT_EQ(told_["state"]["stopped"]["prim"], "/Arm/link");
  EXPECT_EQ(ask({{"do", "reset"}}), Json::object());
  EXPECT_TRUE(told_["state"]["stopped"].is_null());
  EXPECT_EQ(frame_, before);
}

TEST_F(SessionTest, MovesJointsByHand) {
  ask({{"do", "setJoint"}, {"joint", "/Arm/hinge"}, {"position", {0.3}}});
  EXPECT_NEAR(angle(), 0.3, 1e-9);
  EXPECT_NEAR(frame_[8], 0.2 * std::cos(0.3), 1e-6);
  EXPECT_NEAR(std::abs(frame_[10]), 0.2 * std::sin(0.3), 1e-6);
  EXPECT_EQ(ask({{"do", "setJoint"}, {"joint", "/Arm/hinge"}, {"position", {1, 2}}}),
            "live.refused");
  ask({{"do", "play"}});
  EXPECT_EQ(ask({{"do", "setJoint"}, {"joint", "/Arm/hinge"}, {"position", {0}}}), "live.refused");
}

TEST_F(SessionTest, MovesWhatFollowsAJoint) {
  std::string text = kBase;
  text.insert(text.find("    variantSet \"Load\""),
              R"(    def Cube "tip" (prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"])
    {
        double size = 0.1
        float physics:mass = 0.1
        double3 xformOp:translate = (0.4, 0, 0)
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }
    def PhysicsRevoluteJoint "wrist" (prepend apiSchemas = ["NewtonMimicAPI"])
    {
        rel physics:body0 = </Arm/link>
        rel physics:body1 = </Arm/tip>
        uniform token physics:axis = "Y"
        point3f physics:localPos1 = (-0.2, 0, 0)
        rel newton:mimicJoint = </Arm/hinge>
        float newton:mimicCoef0 = 0.1
        float newton:mimicCoef1 = -2
    }
)");
  write("base.usda", text);
  open();
  ASSERT_EQ(told_["scene"]["joints"][1]["follows"], true);
  ask({{"do", "setJoint"}, {"joint", "/Arm/hinge"}, {"position", {0.3}}});
  EXPECT_NEAR(angle(), 0.3, 1e-9);
  const double offset = session_->asset().scene().joints[1].mimics[0].offset;
  EXPECT_NEAR(session_->asset().world->joint_state(1).position[0], offset - 0.6, 1e-9);
  EXPECT_GT(std::abs(offset), 0) << "the law has a constant part";
}

TEST_F(SessionTest, OpensAgainWhenAMissingFileComes) {
  fs::remove(folder_ / "base.usda");
  open();
  EXPECT_FALSE(told_["scene"]["opening"].empty());
  EXPECT_EQ(told_["scene"]["bodies"], Json::array());
  write("base.usda", kBase);
  Outbox out;
  for (int i = 0; i < 3; ++i) {
    session_->look_at_files(out);
  }
  take(out);
  EXPECT_EQ(told_["scene"]["why"], "file");
  EXPECT_EQ(told_["scene"]["bodies"].size(), 2u);
}

TEST_F(SessionTest, LeavesChecksToWhoHoldsIt) {
  Outbox out;
  session_->hear(1, R"({"do": "findings", "id": 7})", out);
  EXPECT_TRUE(out.messages.empty()) << "it is not answered yet";
  ASSERT_EQ(out.late.size(), 1u);
  const LateAnswer late = std::move(out.late[0]);
  out = {};
  session_->answer_late(late, late.make(), out);
  take(out);
  EXPECT_EQ(told_["answer"]["to"], "findings");
  EXPECT_EQ(told_["answer"]["id"], 7);
  EXPECT_TRUE(told_["answer"]["result"].contains("diagnostics"));
  session_->forget(1);
  out = {};
  session_->answer_late(late, late.make(), out);
  EXPECT_TRUE(out.messages.empty()) << "who asked is gone";
}

TEST_F(SessionTest, PullsBodies) {
  ask({{"do", "drag"}, {"body", "/Arm/link"}, {"anchor", {0, 0, 0}}, {"target", {0.2, 0, 0.2}}});
  ask({{"do", "step"}, {"count", 500}});
  const double pulled = angle();
  ask({{"do", "release"}});
  ask({{"do", "step"}, {"count", 1000}});
  EXPECT_GT(std::abs(pulled - angle()), 0.05);
  ask({{"do", "force"}, {"body", "/Arm/link"}, {"point", {0.2, 0, 0}}, {"force", {0, 0, 5}}});
  ask({{"do", "step"}, {"count", 1000}});
  const double forced = angle();
  Outbox out;
  session_->forget(1);  // who leaves lets go
  session_->greet(1, out);
  ask({{"do", "step"}, {"count", 1000}});
  EXPECT_GT(std::abs(forced - angle()), 0.01);
  EXPECT_EQ(
      ask({{"do", "drag"}, {"body", "/Arm/base"}, {"anchor", {0, 0, 0}}, {"target", {0, 0, 0}}}),
      "live.refused");
}

TEST_F(SessionTest, TellsObservers) {
  ask({{"do", "observe"}, {"plots", true}});
  EXPECT_EQ(told_["plots"]["joints"].size(), 1u);
  told_.erase("plots");
  advance(0.2);
  EXPECT_FALSE(told_.contains("plots")) << "nothing moves";
  ask({{"do", "play"}});
  advance(0.2);
  EXPECT_TRUE(told_.contains("plots"));
  EXPECT_FALSE(told_.contains("contacts"));
}

TEST_F(SessionTest, TellsVelocitiesEffortsAndTargets) {
  ask({{"do", "observe"}, {"plots", true}});
  ask({{"do", "setDrive"}, {"joint", "/Arm/hinge"}, {"position", -0.5}});
  ask({{"do", "setEffort"}, {"joint", "/Arm/hinge"}, {"effort", {0.5}}});
  ask({{"do", "step"}, {"count", 20}});
  const Json& plots = told_["plots"];
  const auto& world = *session_->asset().world;
  EXPECT_EQ(plots["velocities"][0][0], world.joint_state(0).velocity[0]);
  EXPECT_NE(plots["velocities"][0][0], 0.0);
  EXPECT_EQ(plots["efforts"].size(), plots["joints"].size());
  EXPECT_EQ(plots["bodies"].size(), session_->asset().scene().bodies.size());
  EXPECT_EQ(plots["bodies"][0].size(), 6u);
  EXPECT_EQ(told_["state"]["events"], Json::array());
  EXPECT_EQ(plots["targets"][0][0][0], -0.5);
  EXPECT_EQ(plots["efforts"][0].size(), 1u);
  EXPECT_EQ(ask({{"do", "setEffort"}, {"joint", "/Arm/hinge"}, {"effort", {1, 2}}}),
            "live.refused");
  EXPECT_EQ(ask({{"do", "step"}, {"count", 1001}}), "live.bad-field");
}

TEST_F(SessionTest, SelectsVariantsAndEngines) {
  EXPECT_EQ(ask({{"do", "variant"}, {"prim", "/Arm"}, {"set", "Load"}, {"variant", "heavy"}}),
            Json::object());
  EXPECT_EQ(session_->asset().scene().bodies[0].mass, 2);
  EXPECT_EQ(told_["scene"]["revision"], 2);
  EXPECT_EQ(picture_, "picture 2");
  EXPECT_EQ(ask({{"do", "variant"}, {"prim", "/Arm"}, {"set", "Load"}, {"variant", "none"}}),
            "variant.unknown");
  EXPECT_EQ(ask({{"do", "engine"}, {"engine", "mujoco"}}), Json::object());
  EXPECT_EQ(told_["scene"]["revision"], 2) << "the picture stays";
  EXPECT_EQ(ask({{"do", "engine"}, {"engine", "unheard"}}), "live.no-engine");
}

TEST_F(SessionTest, Answers) {
  const Json inspected = ask({{"do", "inspect"}, {"prim", "/Arm/link"}});
  EXPECT_EQ(inspected["prim"], "/Arm/link");
  EXPECT_EQ(inspected["body"]["mass"], 0.5);
  bool has_mass = false;
  for (const Json& row : inspected["all"]) {
    has_mass = has_mass || (row["name"] == "physics:mass" && row["value"] == "0.5" &&
                            row["authored"] == true && row["type"] == "float");
  }
  EXPECT_TRUE(has_mass);
  EXPECT_EQ(ask({{"do", "where"}, {"object", "/Arm/link.physics:mass"}})["value"], "0.5");
  EXPECT_EQ(ask({{"do", "explain"}, {"object", "/Arm/link.physics:mass"}})["value"], "0.5");
  EXPECT_FALSE(ask({{"do", "tree"}})["prims"].empty());
  EXPECT_TRUE(ask({{"do", "findings"}}).contains("diagnostics"));
  EXPECT_TRUE(ask({{"do", "messages"}}).contains("requests"));
  for (const char* object : {"", "/", "x", "/Arm/none", "/Arm/link.none", "/Arm{Load=heavy}"}) {
    EXPECT_TRUE(ask({{"do", "explain"}, {"object", object}, {"other", "x"}}).is_string()) << object;
    ask({{"do", "where"}, {"object", object}});
    ask({{"do", "set"}, {"object", object}, {"value", "1"}});
  }
}

TEST_F(SessionTest, EditsTheFileThatOwnsTheValueAndTakesItBack) {
  const Json edited = ask({{"do", "set"}, {"object", "/Arm/link.physics:mass"}, {"value", "0.75"}});
  ASSERT_TRUE(edited.is_object()) << edited;
  EXPECT_EQ(edited["edits"][0]["before"], "0.5");
  EXPECT_EQ(edited["edits"][0]["after"], "0.75");
  EXPECT_TRUE(edited["edits"][0]["file"].get<std::string>().ends_with("base.usda"));
  EXPECT_FALSE(edited["physics"][0]["differences"].empty()) << "the effect is told";
  EXPECT_NE(text_of(folder_ / "base.usda").find("physics:mass = 0.75"), std::string::npos);
  EXPECT_EQ(text_of(folder_ / "root.usda"), kRoot);
  EXPECT_EQ(session_->asset().scene().bodies[1].mass, 0.75);
  EXPECT_EQ(told_["scene"]["canUndo"], true);
  EXPECT_EQ(ask({{"do", "undo"}}), Json::object());
  EXPECT_EQ(text_of(folder_ / "base.usda"), kBase);
  EXPECT_EQ(told_["scene"]["canUndo"], false);
  EXPECT_EQ(told_["scene"]["canRedo"], true);
  EXPECT_EQ(ask({{"do", "redo"}}), Json::object());
  EXPECT_EQ(session_->asset().scene().bodies[1].mass, 0.75);
  EXPECT_EQ(ask({{"do", "redo"}}), "live.nothing-to-undo");
  write("base.usda", kBase + std::string("# mine\n"));
  EXPECT_EQ(ask({{"do", "undo"}}), "live.file-changed");
  EXPECT_EQ(text_of(folder_ / "base.usda"), kBase + std::string("# mine\n"));
}

TEST_F(SessionTest, RefusesEditsThatCannotBe) {
  const std::string before = text_of(folder_ / "base.usda");
  for (const auto& [object, value] :
       std::vector<std::pair<std::string, std::string>>{{"/Arm/link.physics:mass", "heavy"},
                                                        {"/Arm/none.physics:mass", "1"},
                                                        {"/Arm/link", "1"},
                                                        {"link.physics:mass", "1"}}) {
    EXPECT_TRUE(ask({{"do", "set"}, {"object", object}, {"value", value}}).is_string()) << object;
  }
  EXPECT_EQ(text_of(folder_ / "base.usda"), before);
  EXPECT_EQ(ask({{"do", "undo"}}), "live.nothing-to-undo");
  open(true);
  EXPECT_EQ(told_["hello"]["readOnly"], true);
  EXPECT_EQ(ask({{"do", "set"}, {"object", "/Arm/link.physics:mass"}, {"value", "1"}}),
            "live.read-only");
}

TEST_F(SessionTest, SetsGainsInTheModelAndSavesThem) {
  const Json set = ask({{"do", "setGains"},
                        {"joint", "/Arm/hinge"},
                        {"dof", "rotY"},
                        {"frequency", 20},
                        {"dampingRatio", 0.5}});
  ASSERT_TRUE(set.is_object()) << set;
  EXPECT_NEAR(set["frequency"].get<double>(), 20, 1e-9);
  EXPECT_NEAR(set["dampingRatio"].get<double>(), 0.5, 1e-9);
  const double inertia = set["stiffness"].get<double>() / 400;
  EXPECT_NEAR(set["damping"].get<double>(), 2 * 0.5 * 20 * inertia, 1e-9);
  EXPECT_EQ(text_of(folder_ / "base.usda"), kBase) << "no file is touched";
  ask({{"do", "reset"}});
  const Json table = ask({{"do", "gains"}});
  EXPECT_NEAR(table["drives"][0]["to"]["frequency"].get<double>(), 20, 1e-3) << "it stays";
  const Json planned = ask({{"do", "saveGains"}, {"dryRun", true}});
  EXPECT_EQ(planned["written"], false) << planned;
  EXPECT_NE(planned["files"][0]["diff"].get<std::string>().find("stiffness"), std::string::npos);
  EXPECT_EQ(text_of(folder_ / "base.usda"), kBase);
  EXPECT_TRUE(ask({{"do", "saveGains"}}).is_object());
  EXPECT_NE(text_of(folder_ / "base.usda"), kBase);
  EXPECT_NEAR(ask({{"do", "gains"}})["drives"][0]["frequency"].get<double>(), 20, 1e-3);
  EXPECT_EQ(ask({{"do", "saveGains"}}), "live.nothing-to-write");
  ask({{"do", "undo"}});
  EXPECT_EQ(text_of(folder_ / "base.usda"), kBase);
  for (const Json& wrong :
       {Json{{"frequency", -1}}, Json{{"dampingRatio", 1e9}}, Json{{"stiffness", -1}},
        Json::object(), Json{{"frequency", 1}, {"stiffness", 1}}}) {
    Json request = {{"do", "setGains"}, {"joint", "/Arm/hinge"}, {"dof", "rotY"}};
    request.update(wrong);
    EXPECT_EQ(ask(request), "live.refused") << wrong;
  }
}

TEST_F(SessionTest, EndsLongRequestsAndTakesOneOfAPage) {
  Outbox out;
  session_->hear(1, R"({"do": "testDrives", "test": "step", "id": 1})", out);
  ASSERT_EQ(out.late.size(), 1u);
  const LateAnswer late = std::move(out.late[0]);
  EXPECT_EQ(ask({{"do", "pairs"}}), "live.busy");
  ask({{"do", "cancel"}});
  out = {};
  session_->answer_late(late, late.make(), out);
  take(out);
  EXPECT_EQ(told_["answer"]["result"]["interrupted"], true);
  EXPECT_TRUE(ask({{"do", "testDrives"}, {"test", "step"}}).is_object()) << "another one may come";
  EXPECT_EQ(told_["tested"]["result"]["joint"], "/Arm/hinge");
  EXPECT_EQ(ask({{"do", "testDrives"}, {"test", "stress"}}), "live.refused");
  EXPECT_EQ(ask({{"do", "testDrives"}, {"test", "step"}, {"period", 1e6}}), "live.refused");
}

TEST_F(SessionTest, OpensAgainWhenAFileChanges) {
  ask({{"do", "setDrive"}, {"joint", "/Arm/hinge"}, {"position", 0.25}});
  Outbox out;
  session_->look_at_files(out);
  EXPECT_TRUE(out.messages.empty());
  std::string text = kBase;
  write("base.usda", text.replace(text.find("mass = 0.5"), 10, "mass = 1.5"));
  for (int i = 0; i < 3; ++i) {
    session_->look_at_files(out);
  }
  take(out);
  EXPECT_EQ(told_["scene"]["why"], "file");
  EXPECT_EQ(session_->asset().scene().bodies[1].mass, 1.5);
  write("root.usda", "no layer");
  out = {};
  for (int i = 0; i < 3; ++i) {
    session_->look_at_files(out);
  }
  take(out);
  EXPECT_TRUE(told_.contains("problem")) << "what does not open is told";
  EXPECT_TRUE(told_["state"]["outdated"]["file"].get<std::string>().ends_with("root.usda"));
  EXPECT_EQ(session_->asset().scene().bodies[1].mass, 1.5) << "and what was there stays";
  write("base.usda", "no layer");
  write("root.usda", kRoot);
  for (int i = 0; i < 3; ++i) {
    session_->look_at_files(out);
  }
  take(out);
  EXPECT_FALSE(told_["scene"]["opening"].empty()) << "what is missing is told";
  EXPECT_TRUE(told_["state"]["outdated"].is_null());
  write("base.usda", kBase);
  out = {};
  for (int i = 0; i < 3; ++i) {
    session_->look_at_files(out);
  }
  take(out);
  EXPECT_TRUE(told_["scene"]["opening"].empty());
  ASSERT_EQ(session_->asset().scene().bodies.size(), 2u);
  EXPECT_EQ(session_->asset().scene().bodies[1].mass, 0.5);
}

TEST_F(SessionTest, ShowsWhatNoEngineTakes) {
  write("root.usda", "#usda 1.0\n(\n    defaultPrim = \"A\"\n)\ndef Xform \"A\"\n{\n}\n");
  open();
  EXPECT_EQ(told_["scene"]["simulates"], false);
  EXPECT_EQ(told_["scene"]["problem"]["rule"], "live.no-bodies");
  EXPECT_EQ(frame_.size(), 1u);
  for (const char* request : {"play", "step", "reset"}) {
    EXPECT_EQ(ask({{"do", request}}), "live.no-model");
  }
  advance(0.1);
}

}  // namespace
}  // namespace tenon::live
