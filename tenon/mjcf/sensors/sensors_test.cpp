// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Every kind of sensor that this release of MuJoCo has, by its own list and in its own words: it is
// kept, and measured in the asset or named with its line.
#include "tenon/mjcf/sensors/sensors.h"

#include <filesystem>
#include <fstream>
#include <set>

#include <gtest/gtest.h>
#include <unistd.h>

#include "tenon/engines/mujoco/error_hook.h"
#include "tenon/engines/mujoco/model.h"
#include "tenon/mjcf/read_mjcf.h"

namespace tenon::mjcf {
namespace {

/// Two of whatever sensors can be of.
constexpr const char* kThings = R"(<mujoco>
<asset><mesh name="x" vertex="0 0 0 .1 0 0 0 .1 0 0 0 .1"/></asset>
<worldbody>
<body name="x" pos="0 0 1"><joint name="x" axis="0 1 0" range="-1 1" limited="true"/>
<geom name="x" size="0.1"/><site name="x" size="0.05"/><camera name="x" resolution="4 4"/>
<body name="y" pos="0 0 1"><joint name="y" type="ball"/><geom name="y" size="0.1"/>
<site name="y"/><camera name="y"/></body></body>
</worldbody>
<tendon><fixed name="x" range="-1 1" limited="true"><joint joint="x" coef="1"/></fixed></tendon>
<actuator><position name="x" joint="x" kp="1"/></actuator>
</mujoco>)";

template <class Function>
Function* function(const char* name) {
  return reinterpret_cast<Function*>(engines::mujoco::find_mujoco_function(name));
}

/// The model with one sensor as MuJoCo writes it; empty where MuJoCo refuses the sensor.
std::string model_with(mjtSensor kind, int object, const char* name, int reference) {
  char words[1000] = "";
  std::string text;
  (void)engines::mujoco::guarded([&] {
    const engines::mujoco::SpecPtr spec(function<decltype(::mj_parseXMLString)>(
        "mj_parseXMLString")(kThings, nullptr, words, sizeof(words)));
    mjsSensor* sensor = mjs_addSensor(spec.get());
    sensor->type = kind;
    sensor->objtype = static_cast<mjtObj>(object);
    mjs_setString(sensor->objname, object == mjOBJ_UNKNOWN ? "" : name);
    sensor->reftype = static_cast<mjtObj>(reference);
    mjs_setString(sensor->refname, reference == mjOBJ_UNKNOWN ? "" : "y");
    sensor->intprm[0] = 1;  // what is measured of contacts and rays
    sensor->intprm[2] = 1;  // how many contacts
    sensor->dim = 1;        // of what users measure
    mjModel* model = mj_compile(spec.get(), nullptr);
    if (model != nullptr) {
      const engines::mujoco::ModelPtr held(model);
      std::vector<char> written(100'000);
      function<decltype(::mj_saveXMLString)>("mj_saveXMLString")(
          spec.get(), written.data(), static_cast<int>(written.size()), words, sizeof(words));
      text = written.data();
    }
  });
  return text;
}

/// Of the first things that MuJoCo takes it of; empty: of none.
std::string model_with(mjtSensor kind) {
  for (int reference = 0; reference < mjNOBJECT; ++reference) {
    for (int object = 0; object < mjNOBJECT; ++object) {
      for (const char* name : {"x", "y"}) {
        std::string text = model_with(kind, object, name, reference);
        if (!text.empty()) {
          return text;
        }
      }
    }
  }
  return {};
}

/// The element inside <sensor>.
std::string word_in(const std::string& text) {
  const std::size_t start = text.find('<', text.find("<sensor>") + 1) + 1;
  return text.substr(start, text.find_first_of(" /", start) - start);
}

bool is_measured(const robot::RobotModel& model) {
  for (const robot::Joint& joint : model.joints) {
    if (joint.measured) {
      return true;
    }
  }
  for (const robot::Link& link : model.links) {
    for (const robot::Site& site : link.sites) {
      if (!site.sensors.empty()) {
        return true;
      }
    }
  }
  return false;
}

TEST(MjcfSensors, EveryKindIsMeasuredOrNamedWithItsLine) {
  ASSERT_TRUE(engines::mujoco::open_mujoco());
  const std::string path = (std::filesystem::temp_directory_path() /
                            ("tenon_sensors_" + std::to_string(getpid()) + ".xml"))
                               .string();
  std::set<std::string> measured;
  std::vector<int> not_made;
  for (int kind = 0; kind <= mjSENS_USER; ++kind) {
    const std::string text = kind == mjSENS_PLUGIN ? "" : model_with(static_cast<mjtSensor>(kind));
    if (text.empty()) {
      not_made.push_back(kind);
      continue;
    }
    std::ofstream(path) << text;
    Diagnostics findings;
    const auto model = read_mjcf(path, findings);
    ASSERT_TRUE(model) << text;
    const std::string word = word_in(text);
    std::string named;
    for (const Diagnostic& finding : findings) {
      named += finding.rule == "mjcf.sensor" && finding.line > 0 ? finding.message : "";
    }
    ASSERT_EQ(model->mujoco.sensors.size(), 1u);
    EXPECT_EQ(model->mujoco.sensors[0].kind, word);
    EXPECT_EQ(model->mujoco.sensors[0].instrument.kind.empty(), !is_measured(*model)) << word;
    if (is_measured(*model)) {
      measured.insert(word);
      EXPECT_EQ(named, "") << word;
    } else {
      EXPECT_NE(named.find("1 sensor is kept for models of MuJoCo, and measured by nothing in "
                           "runs (" +
                           word + ")"),
                std::string::npos)
          << text << named;
    }
  }
  std::filesystem::remove(path);
  EXPECT_EQ(not_made, std::vector<int>{mjSENS_PLUGIN});  // there is no plugin
  EXPECT_EQ(measured,
            (std::set<std::string>{"accelerometer",    "actuatorfrc", "actuatorpos", "actuatorvel",
                                   "ballangvel",       "ballquat",    "force",       "frameangvel",
                                   "framelinacc",      "framelinvel", "framepos",    "framequat",
                                   "framexaxis",       "frameyaxis",  "framezaxis",  "gyro",
                                   "jointactuatorfrc", "jointpos",    "jointvel",    "rangefinder",
                                   "torque",           "touch",       "velocimeter"}));
}

}  // namespace
}  // namespace tenon::mjcf
