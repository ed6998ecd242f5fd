// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What becomes of all settings of vendors on MuJoCo.
#include <cstdio>
#include <cstdlib>
#include <istream>
#include <regex>

#include "tenon/engines/mujoco/mujoco_engine.h"
#include "tenon/engines/test_vendor_settings.h"

namespace tenon::engines {
namespace {

/// A line of a list of attributes that were authored one at a time: their schema, how many had an
/// effect, were reported, or silent, and the last words of the silent ones.
struct Listed {
  std::string schema;
  std::size_t named_otherwise = 0;  ///< with an effect, or reported; without their names
  std::vector<std::string> silent;
};

std::vector<Listed> read_listed(std::istream& stream) {
  std::vector<Listed> all;
  const std::regex line_form(R"((\w+) (\{.*\}) SILENT: \[(.*)\])");
  for (std::string line; std::getline(stream, line);) {
    std::smatch parts;
    if (!std::regex_match(line, parts, line_form)) {
      continue;
    }
    Listed& listed = all.emplace_back();
    listed.schema = parts[1];
    const std::string counts = parts[2];
    const std::regex count_form(R"('(effect|reported)': (\d+))");
    for (std::sregex_iterator at(counts.begin(), counts.end(), count_form), end; at != end; ++at) {
      listed.named_otherwise += std::stoul((*at)[2]);
    }
    const std::string names = parts[3];
    const std::regex name_form(R"('(?:\w+:)?(\w+)')");
    for (std::sregex_iterator at(names.begin(), names.end(), name_form), end; at != end; ++at) {
      listed.silent.push_back((*at)[1]);
    }
  }
  return all;
}

/// Of the 175 attributes of the published list, of which 27 had an effect once, at least 70 act.
void expect_listed_to_act(const std::set<std::string>& runs) {
  const char* folder = std::getenv("TENON_SHARED_DIR");
  const std::string path =
      (folder == nullptr ? std::string(TENON_SOURCE_DIR) + "/../shared" : folder) +
      std::string("/findings/physics/vendor_attributes.txt");
  std::ifstream stream(path);
  if (!stream) {
    std::printf("skipped: no list of attributes at %s\n", path.c_str());
    return;
  }
  std::size_t listed_count = 0;
  std::size_t acting = 0;
  for (const Listed& listed : read_listed(stream)) {
    const auto acts = [&](const std::string& word) {
      return std::any_of(runs.begin(), runs.end(), [&](const std::string& run) {
        return run.starts_with(listed.schema + " ") &&
               (run.ends_with(":" + word) || run.ends_with(" " + word));
      });
    };
    const auto of_schema = static_cast<std::size_t>(std::count_if(
        runs.begin(), runs.end(),
        [&](const std::string& run) { return run.starts_with(listed.schema + " "); }));
    const auto silent =
        static_cast<std::size_t>(std::count_if(listed.silent.begin(), listed.silent.end(), acts));
    listed_count += listed.named_otherwise + listed.silent.size();
    acting += silent + std::min(of_schema - silent, listed.named_otherwise);
  }
  std::printf("%zu of %zu listed attributes act\n", acting, listed_count);
  EXPECT_EQ(listed_count, 174u);
  EXPECT_GE(acting, 70u);
}

TEST(VendorSettings, EachActsIsNamedOrIsHarmless) {
  const Tally tally = tally_of({&mujoco::info, &mujoco::make_simulation, nullptr}, Runs::Physx);
  EXPECT_EQ(tally.silent, "");
  // Contacts that are made earlier exert nothing earlier; what lies in a particle system is static.
  EXPECT_EQ(tally.idle,
            "PhysxCollisionAPI physxCollision:contactOffset\n"
            "PhysxParticleSystem xformOpOrder\n");
  // docs/physics.md quotes these numbers.
  EXPECT_EQ(tally.physx,
            (std::map<std::string, int>{{"acts", 125}, {"harmless", 26}, {"named", 419}}));
  EXPECT_EQ(tally.others,
            (std::map<std::string, int>{{"acts", 168}, {"harmless", 78}, {"named", 244}}));
  EXPECT_EQ(tally.physx_runs.size(), 93u);
  expect_listed_to_act(tally.physx_runs);
}

}  // namespace
}  // namespace tenon::engines
