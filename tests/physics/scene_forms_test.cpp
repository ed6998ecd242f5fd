// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A scene that was written as JSON or as bytes and read back simulates as the one it was made of,
// to the last bit: of every scene that is here, the shared ones where they are.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <memory>

#include <gtest/gtest.h>

#include "tenon/answers/scene_json.h"
#include "tenon/make_simulation.h"
#include "tenon/open_stage.h"
#include "tenon/physics/read_physics.h"
#include "tenon/scene/fields/wire_form.h"

namespace tenon {
namespace {

namespace fs = std::filesystem;

constexpr int kSteps = 40;
constexpr std::size_t kBodies = 200;  ///< of larger scenes the forms are compared, not the runs

struct Case {
  std::string file;
  std::string variant;  ///< of the variant set Physics; empty: as it stands
};

fs::path shared() {
  const char* folder = std::getenv("TENON_SHARED_DIR");
  return folder != nullptr ? fs::path(folder) : fs::path(TENON_SOURCE_DIR) / "../shared";
}

std::vector<Case> all_cases() {
  std::vector<Case> cases;
  for (const char* folder : {"scenes", "findings/physics", "findings/house"}) {
    std::error_code absent;
    for (const auto& entry : fs::directory_iterator(shared() / folder, absent)) {
      if (entry.path().extension() == ".usda") {
        cases.push_back({entry.path().string(), ""});
      }
    }
  }
  for (const char* folder : {"tests/physics/scenes", "examples/scenes"}) {
    for (const auto& entry : fs::directory_iterator(fs::path(TENON_SOURCE_DIR) / folder)) {
      if (entry.path().extension() == ".usda") {
        cases.push_back({entry.path().string(), ""});
      }
    }
  }
  for (const char* variant : {"physics", "physx", "mujoco"}) {
    cases.push_back(
        {std::string(TENON_SOURCE_DIR) + "/examples/inspire_hand/inspire_hand.usda", variant});
    const fs::path isaac = shared() / "assets/inspire_hand_isaac/inspire_hand.usda";
    if (fs::exists(isaac)) {
      cases.push_back({isaac.string(), variant});
    }
  }
  std::sort(cases.begin(), cases.end(), [](const Case& a, const Case& b) {
    return std::tie(a.file, a.variant) < std::tie(b.file, b.variant);
  });
  return cases;
}

/// Every pose and velocity after some steps, in a row; q and -q are one rotation.
std::vector<double> run(const scene::PhysicsScene& scene) {
  Diagnostics diagnostics;
  auto made = make_simulation("mujoco", scene, {}, diagnostics);
  std::vector<double> numbers;
  if (!made) {
    return numbers;  // refused, and so has the other to be
  }
  engines::Simulation& simulation = **made;
  bool steady = true;
  for (int i = 0; i < kSteps && steady; ++i) {
    steady = simulation.step().has_value();
  }
  numbers.push_back(simulation.time());
  for (scene::Index i = 0; i < scene.bodies.size(); ++i) {
    const engines::BodyState state = simulation.body_state(i);
    const Quatd& q = state.pose.orientation;
    const double sign = q.w < 0 ? -1 : 1;
    for (const Vec3d& v : {state.pose.position, state.linear_velocity, state.angular_velocity}) {
      numbers.insert(numbers.end(), v.v.begin(), v.v.end());
    }
    numbers.insert(numbers.end(), {sign * q.w, sign * q.x, sign * q.y, sign * q.z});
  }
  return numbers;
}

TEST(SceneForms, EveryScenesJsonAndBytesSimulateAlike) {
  const std::vector<Case> cases = all_cases();
  if (!fs::exists(shared() / "scenes")) {
    std::printf("only scenes of this project: %s is not here (TENON_SHARED_DIR)\n",
                shared().c_str());
  }
  std::size_t simulated = 0;
  std::size_t unreadable = 0;
  for (const Case& one : cases) {
    SCOPED_TRACE(one.file + " " + one.variant);
    Diagnostics diagnostics;
    OpenOptions options;
    options.physics_variant = one.variant;
    const auto stage = tenon::open(one.file, options, diagnostics);
    if (!stage) {
      ++unreadable;  // published as it is: not all of them are layers
      continue;
    }
    const scene::PhysicsScene scene = physics::read_physics(*stage, {}, diagnostics);

    const std::string json = answers::scene_json(scene, answers::Geometry::Inline);
    const auto of_json = answers::read_scene_json(json);
    ASSERT_TRUE(of_json.has_value()) << of_json.error().to_string();
    EXPECT_EQ(answers::scene_json(*of_json, answers::Geometry::Inline), json);

    const std::string bytes = wire_form(scene);
    const auto of_bytes = scene::read_wire_form(bytes);
    ASSERT_TRUE(of_bytes.has_value()) << of_bytes.error().to_string();
    EXPECT_EQ(wire_form(*of_bytes), bytes);

    if (scene.bodies.size() <= kBodies) {
      const std::vector<double> expected = run(scene);
      EXPECT_EQ(run(*of_json), expected);
      EXPECT_EQ(run(*of_bytes), expected);
      ++simulated;
    }
  }
  std::printf("%zu scenes, %zu simulated, %zu are no layers\n", cases.size(), simulated,
              unreadable);
  EXPECT_LE(unreadable, 3u);
  EXPECT_GE(simulated, 8u);
}

}  // namespace
}  // namespace tenon
