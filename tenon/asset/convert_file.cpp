// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Which format a description has is told by its contents. URDF and SDF are read here, MJCF by the
// worker, and macros of xacro are expanded before anything else is looked at. Lines are then those
// of text that no editor shows: findings name them in their messages, not as places.
#include "tenon/asset/convert_file.h"

#include <algorithm>
#include <string_view>
#include <vector>

#include "tenon/asset/mjcf_files.h"
#include "tenon/asset_policy.h"
#include "tenon/base/file_finding.h"
#include "tenon/base/text/shell_word.h"
#include "tenon/base/text/shown_path.h"
#include "tenon/bytes/files.h"
#include "tenon/bytes/read_record.h"
#include "tenon/formats/foreign_format.h"
#include "tenon/guard/not_a_number.h"
#include "tenon/guard/workers.h"
#include "tenon/robot/check_model.h"
#include "tenon/sdf/read_sdf.h"
#include "tenon/urdf/read_urdf.h"
#include "tenon/xacro/expand_xacro.h"

namespace tenon {
namespace {

constexpr const char* kExpandedRule = "xacro.expanded";

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

/// The text without macros. Its lines are others than those of the file.
Result<std::string> expanded(const std::string& path, const ConvertFileOptions& options,
                             bytes::ReadPolicy& policy, Diagnostics& diagnostics) {
  TENON_TRY(xacro::ExpandedXacro done,
            xacro::expand_xacro(path, {options.arguments, options.packages, policy}));
  for (const std::string& file : done.opened) {
    bytes::note_read(file);
  }
  for (const std::string& folder : done.found_folders) {
    policy.add_found(folder);
  }
  diagnostics.add(file_finding(Severity::Info, kExpandedRule,
                               "the macros were expanded by xacro; lines are those of its output",
                               path, 0, "see them with xacro " + shell_word(shown_path(path))));
  return std::move(done.text);
}

/// Meshes are no descriptions.
Result<void> check_is_robot(std::string_view contents, const std::string& path) {
  using formats::ForeignFormat;
  const ForeignFormat format = formats::foreign_format(contents);
  if (format == ForeignFormat::None || format == ForeignFormat::Urdf ||
      format == ForeignFormat::Xacro || format == ForeignFormat::Sdf ||
      format == ForeignFormat::Mjcf) {
    return {};
  }
  return Error(ErrorCode::Unsupported, "this is " +
                                           std::string(formats::foreign_format_name(format)) +
                                           ", not a robot description")
      .in_file(path)
      .with_rule("convert.format")
      .with_fix(formats::foreign_format_advice(format, shown_path(path)));
}

/// What only one of the formats has.
Result<void> check_format_options(const std::string& path, const ConvertFileOptions& options,
                                  bool is_sdf, bool is_xacro) {
  const char* message = !options.model.empty() && !is_sdf ? "--model chooses a model of an SDF file"
                        : !options.arguments.empty() && !is_xacro
                            ? "--arg is for files with macros of xacro"
                            : nullptr;
  if (message == nullptr) {
    return {};
  }
  return Error(ErrorCode::Invalid, message)
      .in_file(path)
      .with_rule("convert.option")
      .with_fix("leave it out");
}

Result<robot::RobotModel> read_model(const std::string& path, const ConvertFileOptions& options,
                                     bytes::ReadPolicy& policy, Diagnostics& diagnostics) {
  TENON_TRY(const auto bytes,
            policy.is_closed() ? policy.open(path) : policy.files()->open(path, {}));
  TENON_CHECK(check_is_robot(bytes->text(), path));
  if (is_mjcf(bytes->text())) {
    TENON_CHECK(check_format_options(path, options, false, false));
    return read_mjcf(path, policy, diagnostics);
  }
  std::string_view text = bytes->text();
  const bool has_macros = xacro::is_xacro(text, path);
  std::string without_macros;
  if (has_macros) {
    TENON_TRY(without_macros, expanded(path, options, policy, diagnostics));
    text = without_macros;
  }
  const bool is_sdf = formats::foreign_format(text) == formats::ForeignFormat::Sdf;
  TENON_CHECK(check_format_options(path, options, is_sdf, has_macros));
  if (is_sdf) {
    return sdf::read_sdf_text(text, path,
                              {options.packages, options.open.search_paths, policy, options.model},
                              diagnostics);
  }
  return urdf::read_urdf_text(text, path, {options.packages, options.open.search_paths, policy},
                              diagnostics);
}

/// Without those that cannot be found.
std::size_t meshes_found(const robot::RobotModel& model) {
  return static_cast<std::size_t>(std::count_if(
      model.meshes.begin(), model.meshes.end(),
      [](const robot::MeshFile& mesh) { return !mesh.path.empty() || !mesh.triangles.empty(); }));
}

bytes::ReadPolicy policy_of(const std::string& path, const ConvertFileOptions& options) {
  bytes::ReadPolicy policy = policy_for(path, options.open);
  for (const auto& [name, folder] : options.packages) {
    policy.add_found(folder);
  }
  return policy;
}

/// A place in the text that xacro made of a file becomes a part of the message.
Diagnostic without_expanded_line(Diagnostic finding, const std::string& path) {
  if (finding.file == path && finding.line != 0) {
    finding.message += " (line " + std::to_string(finding.line) + " of the output of xacro)";
    finding.line = finding.column = finding.end_line = finding.end_column = 0;
  }
  return finding;
}

Error without_expanded_line(const Error& error, const std::string& path) {
  std::vector<Diagnostic> further;
  for (const Diagnostic& finding : error.further()) {
    further.push_back(without_expanded_line(finding, path));
  }
  return Error(error.code(), without_expanded_line(error.diagnostic(), path))
      .with_further(std::move(further));
}

Result<ConvertedFile> convert_read_file(const std::string& path, const ConvertFileOptions& options,
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
                          model.joints.size(), meshes_found(model)};
  TENON_TRY(converted.layer,
            convert::convert_robot(std::move(model), robot, diagnostics, &converted.images));
  return converted;
}

}  // namespace

Result<ConvertedFile> convert_file(const std::string& path, const ConvertFileOptions& options,
                                   Diagnostics& diagnostics) {
  Diagnostics found;
  Result<ConvertedFile> converted = convert_read_file(path, options, found);
  const bool is_expanded = std::any_of(found.begin(), found.end(), [](const Diagnostic& finding) {
    return finding.rule == kExpandedRule;
  });
  for (const Diagnostic& finding : found) {
    diagnostics.add(is_expanded ? without_expanded_line(finding, path) : finding);
  }
  if (!converted && is_expanded) {
    return without_expanded_line(converted.error(), path);
  }
  return converted;
}

}  // namespace tenon
