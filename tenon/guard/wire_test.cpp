// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/guard/wire.h"

#include <limits>

#include <gtest/gtest.h>

#include "tenon/guard/messages.h"
#include "tenon/guard/not_a_number.h"
#include "tenon/mesh/mesh_scene.h"
#include "tenon/robot/robot_model.h"

namespace tenon::guard {
namespace {

/// Gives every number, word and flag in a value, as deep as it lies, something of its own; lists
/// get two items, optionals are set.
struct Fill {
  int next = 0;

  template <class T>
  void operator()(T& value) {
    if constexpr (std::is_same_v<T, bool>) {
      value = true;
    } else if constexpr (std::is_enum_v<T>) {
      value = static_cast<T>(is_enumerator<T>(1) ? 1 : 0);
    } else if constexpr (std::is_arithmetic_v<T>) {
      value = static_cast<T>(++next % 120);
    } else if constexpr (std::is_same_v<T, std::string>) {
      value = "word " + std::to_string(++next);
    } else if constexpr (kIsOptional<T>) {
      (*this)(value.emplace());
    } else if constexpr (kIsMap<T>) {
      (*this)(value["key " + std::to_string(++next)]);
      (*this)(value["key " + std::to_string(++next)]);
    } else if constexpr (kIsVector<T> || kIsArray<T>) {
      if constexpr (kIsVector<T>) {
        value.resize(2);
      }
      for (auto& item : value) {
        (*this)(item);
      }
    } else {
      std::apply([&](auto&... field) { ((*this)(field), ...); }, fields_of(value));
    }
  }
};

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
    } else if constexpr (kIsOptional<T>) {
      (*this)(*value);
      if (is_it()) {
        value.reset();
      }
    } else if constexpr (kIsMap<T>) {
      for (auto& [key, item] : value) {
        (*this)(item);
      }
    } else if constexpr (kIsVector<T> || kIsArray<T>) {
      for (auto& item : value) {
        (*this)(item);
      }
    } else {
      std::apply([&](auto&... field) { ((*this)(field), ...); }, fields_of(value));
    }
  }
  bool is_it() { return seen++ == at; }
};

/// Every leaf travels: a value comes back as it was, and so does each that differs in one leaf.
template <class T>
void expect_every_field_travels(int least_leaves) {
  T full;
  Fill{}(full);
  const std::string bytes = encoded(full);
  EXPECT_EQ(bytes.size(), encoded_size(full));
  int leaves = 1;
  for (int at = 0; at < leaves; ++at) {
    T changed = full;
    Change change{at};
    change(changed);
    leaves = change.seen;
    const std::string other = encoded(changed);
    ASSERT_NE(other, bytes) << "leaf " << at;
    const std::optional<T> back = decoded<T>(other);
    ASSERT_TRUE(back) << "leaf " << at;
    EXPECT_EQ(encoded(*back), other) << "leaf " << at;
  }
  EXPECT_GE(leaves, least_leaves);
}

TEST(Wire, CarriesEveryFieldOfAMeshScene) { expect_every_field_travels<mesh::MeshScene>(60); }
TEST(Wire, CarriesEveryFieldOfARobotModel) { expect_every_field_travels<robot::RobotModel>(500); }
TEST(Wire, CarriesEveryFieldOfMessages) {
  expect_every_field_travels<Task>(8);
  expect_every_field_travels<Answer<AboutWorker>>(20);
}

TEST(Wire, GivesBackWhatWasSent) {
  mesh::MeshScene scene;
  Fill{}(scene);
  scene.meshes[0].points[1] = {{-0.0f, 1e-40f, std::numeric_limits<float>::infinity()}};
  const auto back = decoded<mesh::MeshScene>(encoded(scene));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->meshes[0].points, scene.meshes[0].points);
  EXPECT_EQ(back->meshes[1].name, scene.meshes[1].name);
  EXPECT_EQ(back->images, scene.images);
}

TEST(Wire, RefusesWhatIsNoValue) {
  const std::string vector = encoded(std::vector<std::string>{"a", "b"});
  EXPECT_TRUE(decoded<std::vector<std::string>>(vector));
  for (std::size_t size = 0; size < vector.size(); ++size) {
    EXPECT_FALSE(decoded<std::vector<std::string>>(vector.substr(0, size))) << size;
  }
  EXPECT_FALSE(decoded<std::vector<std::string>>(vector + "x"));
  EXPECT_FALSE(decoded<bool>("\2"));
  EXPECT_FALSE(decoded<std::optional<std::int32_t>>("\2????"));
  EXPECT_TRUE(decoded<ErrorCode>(std::string(1, static_cast<char>(ErrorCode::Missing))));
  EXPECT_FALSE(decoded<ErrorCode>(std::string(1, static_cast<char>(ErrorCode::Missing) + 1)));
  EXPECT_FALSE(decoded<ErrorCode>("\xff"));
  const std::string item = encoded(std::string("k")) + encoded(std::string("v"));
  using Map = std::map<std::string, std::string>;
  EXPECT_TRUE(decoded<Map>(encoded(std::uint64_t{1}) + item));
  EXPECT_FALSE(decoded<Map>(encoded(std::uint64_t{2}) + item + item));  // one key twice
}

TEST(Wire, TakesNoMemoryForCountsThatAreNotThere) {
  for (const std::uint64_t count : {std::uint64_t{5}, std::uint64_t{1} << 40, ~std::uint64_t{0}}) {
    const std::string bytes = encoded(count) + "1234";
    EXPECT_FALSE(decoded<std::string>(bytes));
    EXPECT_FALSE(decoded<std::vector<double>>(bytes));
    EXPECT_FALSE(decoded<std::vector<robot::Link>>(bytes));
    EXPECT_FALSE((decoded<std::map<std::string, std::string>>(bytes)));
  }
}

/// No bytes that a worker may send make more than this many times as much memory.
TEST(Wire, TakesMemoryInProportion) {
  EXPECT_LE(sizeof(robot::Link), 8 * least_size<robot::Link>());
  EXPECT_LE(sizeof(robot::Joint), 8 * least_size<robot::Joint>());
  EXPECT_LE(sizeof(robot::Collider), 8 * least_size<robot::Collider>());
  EXPECT_LE(sizeof(robot::Material), 8 * least_size<robot::Material>());
  EXPECT_LE(sizeof(mesh::PolygonMesh), 8 * least_size<mesh::PolygonMesh>());
  EXPECT_LE(sizeof(mesh::Appearance), 8 * least_size<mesh::Appearance>());
  EXPECT_LE(sizeof(Diagnostic), 8 * least_size<Diagnostic>());
}

TEST(Wire, FindsNumbersThatAreNone) {
  robot::RobotModel model;
  Fill{}(model);
  EXPECT_FALSE(has_not_a_number(model));
  model.joints[1].effort_limit = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(has_not_a_number(model));
  model.links[1].inertial->inertia[2][1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(has_not_a_number(model));
}

}  // namespace
}  // namespace tenon::guard
