// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// Converts robots' descriptions (URDF, MJCF) to Asset Structure 3.0, a folder for each, and opens
// what came of them.
//   batch_conversion OUTPUT_FOLDER ROBOT...
#include <cstdio>
#include <filesystem>
#include <string>

#include "example.h"

#include "tenon/tenon.h"

namespace {

namespace fs = std::filesystem;

tenon::Result<void> convert(const std::string& robot, const fs::path& folder) {
  tenon::Diagnostics diagnostics;
  TENON_TRY(const tenon::ConvertedFile converted, tenon::convert_file(robot, {}, diagnostics));
  TENON_TRY(const auto asset, tenon::structured_robot(converted, diagnostics));
  TENON_CHECK(tenon::structure::write_package(asset.package, folder.string()));

  const std::string interface = (folder / asset.package.interface).string();
  TENON_TRY(const auto stage, tenon::open(interface, {.physics_variant = "physics"}, diagnostics));
  const auto scene = tenon::physics::read_physics(stage, tenon::read_options(), diagnostics);
  tell(diagnostics);
  std::printf("%s: %zu links, %zu bodies, %zu joints in %zu files\n",
              fs::path(robot).filename().string().c_str(), converted.links, scene.bodies.size(),
              scene.joints.size(), asset.package.files.size());
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: batch_conversion OUTPUT_FOLDER ROBOT...\n");
    return 2;
  }
  fs::create_directories(argv[1]);
  int failed = 0;
  for (int i = 2; i < argc; ++i) {
    const fs::path folder = fs::path(argv[1]) / fs::path(argv[i]).stem();
    if (const auto done = convert(argv[i], folder); !done) {
      std::fprintf(stderr, "%s: %s\n", argv[i], done.error().to_string().c_str());
      ++failed;
    }
  }
  return failed == 0 ? 0 : 1;
}
