// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/bake/commands/commands_from_npz.h"

#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tenon/bake/test_still_simulation.h"
#include "tenon/bytes/zip/zip_archive.h"
#include "tenon/math/angle.h"

namespace tenon::bake {
namespace {

template <class T>
std::string bytes_of(const std::vector<T>& numbers) {
  return {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(T)};
}

/// A .npy file of format 1.0.
std::string npy(const std::string& type, const std::string& shape, const std::string& data,
                const std::string& fortran_order = "False") {
  const std::string header = "{'descr': '" + type + "', 'fortran_order': " + fortran_order +
                             ", 'shape': (" + shape + "), }\n";
  return std::string("\x93NUMPY\x01\0", 8) + static_cast<char>(header.size()) + '\0' + header +
         data;
}

/// Two rows of "/A.target" and "/A.effort".
std::map<std::string, std::string> good() {
  return {{"time.npy", npy("<f8", "2,", bytes_of<double>({0, 2.5}))},
          {"columns.npy", npy("|S9", "2,", "/A.target/A.effort")},
          {"values.npy", npy("<f4", "2, 2", bytes_of<float>({180, NAN, 90, -3}))}};
}

scene::PhysicsScene one_driven_joint() {
  scene::PhysicsScene scene;
  scene.joints.resize(1);
  scene.joints[0].path = Path::from("/A");
  scene.joints[0].kind = scene::JointKind::Revolute;
  scene.joints[0].drives.resize(1);
  scene.joints[0].drives[0].dof = scene::Dof::RotX;
  return scene;
}

Result<Commands> read(const std::map<std::string, std::string>& arrays) {
  std::vector<bytes::ZipFile> files;
  for (const auto& [name, contents] : arrays) {
    files.push_back({name, contents});
  }
  TENON_TRY(std::string zip, bytes::write_zip(files));
  return commands_from_npz(bytes::FileBytes::own(std::move(zip)), one_driven_joint(),
                           StillSimulation({1}));
}

std::string failure(const std::string& name, const std::string& contents) {
  auto arrays = good();
  arrays[name + ".npy"] = contents;
  const auto commands = read(arrays);
  return commands ? std::string("read") : commands.error().to_string();
}

TEST(CommandsFromNpz, AreReadInDegreesWithGapsWhereTheyAreNotANumber) {
  const auto commands = read(good());
  ASSERT_TRUE(commands.has_value()) << commands.error().to_string();
  EXPECT_EQ(commands->times, (std::vector<double>{0, 2.5}));
  ASSERT_EQ(commands->values.size(), 4U);
  EXPECT_NEAR(commands->values[0], kPi, 1e-15);
  EXPECT_TRUE(std::isnan(commands->values[1]));
  EXPECT_NEAR(commands->values[2], kPi / 2, 1e-15);
  EXPECT_EQ(commands->values[3], -3);
  EXPECT_EQ(commands->columns[1].kind, CommandKind::Effort);
}

TEST(CommandsFromNpz, ColumnMajorArraysWholeNumbersAndWideTextsAreTheSame) {
  auto arrays = good();
  arrays["values.npy"] = npy("<f8", "2, 2", bytes_of<double>({180, 90, NAN, -3}), "True");
  arrays["time.npy"] = npy("<i8", "2,", bytes_of<std::int64_t>({0, 2}));
  std::string names;
  for (const char c : std::string("/A.target/A.effort")) {
    names += c + std::string(3, '\0');
  }
  arrays["columns.npy"] = npy("<U9", "2,", names);
  const auto commands = read(arrays);
  ASSERT_TRUE(commands.has_value()) << commands.error().to_string();
  EXPECT_EQ(commands->times, (std::vector<double>{0, 2}));
  EXPECT_NEAR(commands->values[2], kPi / 2, 1e-15);
  EXPECT_EQ(commands->values[3], -3);
}

TEST(CommandsFromNpz, WhatCannotBeIsAnErrorThatNamesTheArray) {
  const std::string numbers = bytes_of<double>({0, 1});
  const std::vector<std::pair<std::string, std::string>> cases = {
      {failure("time", "no array"), "\"time\" cannot be read"},
      {failure("time", npy("<f8", "3,", numbers)), "ends before its last element"},
      {failure("time", npy("<f8", "1000000000000, 1000000000000", numbers)), "ends before"},
      {failure("time", npy("<f8", "-1,", numbers)), "type, order and at most two sizes"},
      {failure("time", npy("<f8", "1, 1, 2", numbers)), "at most two sizes"},
      {failure("time", npy(">f8", "2,", numbers)), "elements are of type '>f8'"},
      {failure("time", npy("<c16", "1,", numbers)), "elements are of type '<c16'"},
      {failure("time", npy("<f8", "2,", bytes_of<double>({1, 1}))), "time[1] = 1"},
      {failure("time", npy("<f8", "2,", bytes_of<double>({NAN, 1}))), "time[0] = nan"},
      {failure("time", npy("<f8", "1,", numbers.substr(0, 8))), "1 times and 2 columns"},
      {failure("columns", npy("|S9", "2,", "/A.target/B.target")), "\"/B.target\""},
      {failure("columns", npy("|S9", "2,", "/A.target/A.target")), "is there twice"},
      {failure("columns", npy("<f8", "2,", numbers)), "\"columns\" are texts"},
      {failure("values", npy("<f4", "2, 2", bytes_of<float>({0, 0, 0, INFINITY}))),
       "values[1, 1] is not a finite number"},
      {failure("values", npy("<f8", "2,", numbers)), "has not a number for each"},
  };
  for (const auto& [said, expected] : cases) {
    EXPECT_NE(said.find(expected), std::string::npos) << expected << "\n" << said;
    EXPECT_NE(said.find("sim.commands"), std::string::npos) << said;
  }
  auto arrays = good();
  arrays.erase("values.npy");
  EXPECT_NE(read(arrays).error().message().find("no array \"values\""), std::string::npos);
}

}  // namespace
}  // namespace tenon::bake
