// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/guard/messages.h"

#include <limits>

#include <gtest/gtest.h>

#include "tenon/base/fill_fields.h"
#include "tenon/base/wire.h"
#include "tenon/guard/not_a_number.h"
#include "tenon/mesh/mesh_scene.h"
#include "tenon/robot/robot_model.h"

namespace tenon::guard {
namespace {

/// Changes the leaf with the number `at`.
struct Change {
  int at = 0;
  int seen = 0;

  template <class T>
  void operator()(T& value) {
    if constexpr (std::is_same_v<T, bool>) {
      value = is_it() ? !value : value;
    } else if constexpr (std::is_enum_v<T>) {
      value = is_it() ? static_cast<T>(value == static_cast<T>(0) ? 1 : 0) : value;
    } else if constexpr (std::is_arithmetic_v<T>) {
      value = is_it() ? static_cast<T>(value + 1) : value;
    } else if constexpr (std::is_same_v<T, std::string>) {
      value += is_it() ? "!" : "";
    } else if constexpr (wire::kIsOptional<T>) {
      (*this)(*value);
      if (is_it()) {
        value.reset();
      }
    } else if constexpr (wire::kIsMap<T>) {
      for (auto& [key, item] : value) {
        (*this)(item);
      }
    } else if constexpr (wire::kIsVector<T> || wire::kIsArray<T>) {
      for (auto& item : value) {
        (*this)(item);
      }
    } else {
      wire::with_fields(value, [&](auto&... field) { ((*this)(field), ...); });
    }
  }
  bool is_it() { return seen++ == at; }
};

/// Every leaf travels: a value comes back as it was, and so does each that differs in one leaf.
template <class T>
void expect_every_field_travels(int min_leaves) {
  T full;
  wire::FillFields{}(full);
  const std::string bytes = wire::encoded(full);
  EXPECT_EQ(bytes.size(), wire::encoded_size(full));
  int leaves = 1;
  for (int at = 0; at < leaves; ++at) {
    T changed = full;
    Change change{at};
    change(changed);
    leaves = change.seen;
    const std::string other = wire::encoded(changed);
    ASSERT_NE(other, bytes) << "leaf " << at;
    const std::optional<T> back = wire::decoded<T>(other);
    ASSERT_TRUE(back) << "leaf " << at;
    EXPECT_EQ(wire::encoded(*back), other) << "leaf " << at;
  }
  EXPECT_GE(leaves, min_leaves);
}

TEST(Wire, CarriesEveryFieldOfAMeshScene) { expect_every_field_travels<mesh::MeshScene>(60); }
TEST(Wire, CarriesEveryFieldOfARobotModel) { expect_every_field_travels<robot::RobotModel>(500); }
TEST(Wire, CarriesEveryFieldOfMessages) {
  expect_every_field_travels<Task>(8);
  expect_every_field_travels<Answer<AboutWorker>>(20);
}

TEST(Wire, GivesBackWhatWasSent) {
  mesh::MeshScene scene;
  wire::FillFields{}(scene);
  scene.meshes[0].points[1] = {{-0.0f, 1e-40f, std::numeric_limits<float>::infinity()}};
  const auto back = wire::decoded<mesh::MeshScene>(wire::encoded(scene));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->meshes[0].points, scene.meshes[0].points);
  EXPECT_EQ(back->meshes[1].name, scene.meshes[1].name);
  EXPECT_EQ(back->images, scene.images);
}

TEST(Wire, RefusesWhatIsNoValue) {
  const std::string vector = wire::encoded(std::vector<std::string>{"a", "b"});
  EXPECT_TRUE(wire::decoded<std::vector<std::string>>(vector));
  for (std::size_t size = 0; size < vector.size(); ++size) {
    EXPECT_FALSE(wire::decoded<std::vector<std::string>>(vector.substr(0, size))) << size;
  }
  EXPECT_FALSE(wire::decoded<std::vector<std::string>>(vector + "x"));
  EXPECT_FALSE(wire::decoded<bool>("\2"));
  EXPECT_FALSE(wire::decoded<std::optional<std::int32_t>>("\2????"));
  EXPECT_TRUE(wire::decoded<ErrorCode>(std::string(1, static_cast<char>(ErrorCode::Missing))));
  EXPECT_FALSE(wire::decoded<ErrorCode>(std::string(1, static_cast<char>(ErrorCode::Missing) + 1)));
  EXPECT_FALSE(wire::decoded<ErrorCode>("\xff"));
  const std::string item = wire::encoded(std::string("k")) + wire::encoded(std::string("v"));
  using Map = std::map<std::string, std::string>;
  EXPECT_TRUE(wire::decoded<Map>(wire::encoded(std::uint64_t{1}) + item));
  EXPECT_FALSE(wire::decoded<Map>(wire::encoded(std::uint64_t{2}) + item + item));  // one key twice
}

TEST(Wire, TakesNoMemoryForCountsThatAreNotThere) {
  for (const std::uint64_t count : {std::uint64_t{5}, std::uint64_t{1} << 40, ~std::uint64_t{0}}) {
    const std::string bytes = wire::encoded(count) + "1234";
    EXPECT_FALSE(wire::decoded<std::string>(bytes));
    EXPECT_FALSE(wire::decoded<std::vector<double>>(bytes));
    EXPECT_FALSE(wire::decoded<std::vector<robot::Link>>(bytes));
    EXPECT_FALSE((wire::decoded<std::map<std::string, std::string>>(bytes)));
  }
}

/// No bytes that a worker may send make more than this many times as much memory.
TEST(Wire, TakesMemoryInProportion) {
  EXPECT_LE(sizeof(robot::Link), 8 * wire::min_size<robot::Link>());
  EXPECT_LE(sizeof(robot::Joint), 8 * wire::min_size<robot::Joint>());
  EXPECT_LE(sizeof(robot::Collider), 8 * wire::min_size<robot::Collider>());
  EXPECT_LE(sizeof(robot::Material), 8 * wire::min_size<robot::Material>());
  EXPECT_LE(sizeof(mesh::PolygonMesh), 8 * wire::min_size<mesh::PolygonMesh>());
  EXPECT_LE(sizeof(mesh::Appearance), 8 * wire::min_size<mesh::Appearance>());
  EXPECT_LE(sizeof(Diagnostic), 8 * wire::min_size<Diagnostic>());
}

TEST(Wire, FindsNumbersThatAreNone) {
  robot::RobotModel model;
  wire::FillFields{}(model);
  EXPECT_FALSE(has_not_a_number(model));
  model.joints[1].effort_limit = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(has_not_a_number(model));
  model.links[1].inertial->inertia[2][1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(has_not_a_number(model));
}

}  // namespace
}  // namespace tenon::guard
