// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/convert_file.h"

#include <string_view>

#include "tenon/bytes/file_bytes.h"
#include "tenon/urdf/read_urdf.h"

#if TENON_WITH_MUJOCO
#include "tenon/mjcf/read_mjcf.h"
#endif

namespace tenon {
namespace {

/// Told by the root element: a URDF may hold <mujoco> too, further down.
bool is_mjcf(std::string_view text) { return text.find("<mujoco") < text.find("<robot"); }

Result<robot::RobotModel> read_model(const std::string& path, const ConvertFileOptions& options,
                                     Diagnostics& diagnostics) {
  TENON_TRY(const auto bytes, bytes::FileBytes::open(path));
  if (!is_mjcf(bytes->text())) {
    return urdf::read_urdf_text(bytes->text(), path, {options.packages}, diagnostics);
  }
#if TENON_WITH_MUJOCO
  return mjcf::read_mjcf(path, diagnostics);
#else
  return Error(ErrorCode::Missing, "MJCF is read by MuJoCo, which this build is without")
      .in_file(path)
      .with_rule("mjcf.missing")
      .with_fix("build with -DTENON_WITH_MUJOCO=ON");
#endif
}

}  // namespace

Result<ConvertedFile> convert_file(const std::string& path, const ConvertFileOptions& options,
                                   Diagnostics& diagnostics) {
  TENON_TRY(robot::RobotModel model, read_model(path, options, diagnostics));
  const std::size_t links = model.links.size();
  const std::size_t joints = model.joints.size();
  const std::size_t meshes = model.meshes.size();
  convert::InnerImages images;
  TENON_TRY(layer::Layer layer,
            convert::convert_robot(std::move(model), options.robot, diagnostics, &images));
  return ConvertedFile{std::move(layer), std::move(images), links, joints, meshes};
}

}  // namespace tenon
