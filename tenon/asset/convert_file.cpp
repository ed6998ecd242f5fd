// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/convert_file.h"

#include <algorithm>
#include <string_view>
#include <vector>

#include "tenon/asset/mjcf_files.h"
#include "tenon/asset_policy.h"
#include "tenon/base/text/shown_path.h"
#include "tenon/bytes/files.h"
#include "tenon/bytes/read_record.h"
#include "tenon/formats/foreign_format.h"
#include "tenon/guard/not_a_number.h"
#include "tenon/guard/workers.h"
#include "tenon/robot/check_model.h"
#include "tenon/urdf/read_urdf.h"

namespace tenon {
namespace {

/// Told by the root element: a URDF may hold <mujoco> too, further down or in a comment.
bool is_mjcf(std::string_view text) {
  const std::string_view root = formats::xml_root_element(text);
  return root == "mujoco" || root == "mujocoinclude";
}

/// By MuJoCo in tenon-worker. What comes back is checked before anybody uses it.
Result<robot::RobotModel> read_mjcf(const std::string& path, bytes::ReadPolicy& policy,
                                    Diagnostics& diagnostics) {
  TENON_CHECK(bytes::check_on_disk(policy.files(), path));
  TENON_CHECK(admit_mjcf_files(path, policy));
  guard::Workers workers;
  std::vector<std::string> opened;
  auto read = guard::read_guarded<robot::RobotModel>(
      workers, {guard::Reader::Mjcf, path, policy.roots()}, diagnostics, &opened);
  for (const std::string& file : opened) {
    bytes::note_read(file);
  }
  TENON_TRY(robot::RobotModel model, std::move(read));
  model.parts_folders.clear();  // which folders belong to a model is not for a worker to say
  TENON_CHECK(robot::check_model(model));
  if (guard::has_not_a_number(model)) {
    return Error(ErrorCode::Invalid, "the model holds a number that is not one (NaN)")
        .in_file(path)
        .with_rule("robot.not-finite")
        .with_fix("give finite numbers");
  }
  return model;
}

/// Meshes and SDF are no descriptions that are read.
Result<void> check_is_robot(std::string_view contents, const std::string& path) {
  using formats::ForeignFormat;
  const ForeignFormat format = formats::foreign_format(contents);
  if (format == ForeignFormat::None || format == ForeignFormat::Urdf ||
      format == ForeignFormat::Xacro || format == ForeignFormat::Mjcf) {
    return {};
  }
  return Error(ErrorCode::Unsupported, "this is " +
                                           std::string(formats::foreign_format_name(format)) +
                                           ", not a robot description")
      .in_file(path)
      .with_rule("convert.format")
      .with_fix(formats::foreign_format_advice(format, shown_path(path)));
}

Result<robot::RobotModel> read_model(const std::string& path, const ConvertFileOptions& options,
                                     bytes::ReadPolicy& policy, Diagnostics& diagnostics) {
  TENON_TRY(const auto bytes,
            policy.is_closed() ? policy.open(path) : policy.files()->open(path, {}));
  TENON_CHECK(check_is_robot(bytes->text(), path));
  if (!is_mjcf(bytes->text())) {
    return urdf::read_urdf_text(bytes->text(), path,
                                {options.packages, options.open.search_paths, policy}, diagnostics);
  }
  return read_mjcf(path, policy, diagnostics);
}

bytes::ReadPolicy policy_of(const std::string& path, const ConvertFileOptions& options) {
  bytes::ReadPolicy policy = policy_for(path, options.open);
  for (const auto& [name, folder] : options.packages) {
    policy.add_found(folder);
  }
  return policy;
}

}  // namespace

Result<ConvertedFile> convert_file(const std::string& path, const ConvertFileOptions& options,
                                   Diagnostics& diagnostics) {
  bytes::ReadPolicy policy = policy_of(path, options);
  TENON_TRY(robot::RobotModel model, read_model(path, options, policy, diagnostics));
  if (!options.name.empty()) {
    model.name = options.name;
  }
  for (const std::string& folder : model.parts_folders) {
    policy.add_found(folder);
  }
  convert::ConvertOptions robot = options.robot;
  robot.reading = policy;
  ConvertedFile converted{layer::Layer(""),    {},
                          std::move(policy),   model.links.size(),
                          model.joints.size(), model.meshes.size()};
  TENON_TRY(converted.layer,
            convert::convert_robot(std::move(model), robot, diagnostics, &converted.images));
  return converted;
}

}  // namespace tenon
