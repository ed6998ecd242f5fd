// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/convert_file.h"

#include <algorithm>
#include <string_view>
#include <vector>

#include "tenon/asset/mjcf_files.h"
#include "tenon/asset_policy.h"
#include "tenon/bytes/files.h"
#include "tenon/bytes/read_record.h"
#include "tenon/guard/not_a_number.h"
#include "tenon/guard/workers.h"
#include "tenon/robot/check_model.h"
#include "tenon/urdf/read_urdf.h"

namespace tenon {
namespace {

/// Behind the first `end` from `at` on; the size of `text` where there is none.
std::size_t behind(std::string_view text, std::string_view end, std::size_t at) {
  const std::size_t found = text.find(end, at);
  return found == std::string_view::npos ? text.size() : found + end.size();
}

/// Behind a document type, whose own declarations are in brackets.
std::size_t behind_document_type(std::string_view text, std::size_t at) {
  const std::size_t open = text.find_first_of("[>", at);
  const bool has_declarations = open != std::string_view::npos && text[open] == '[';
  return behind(text, ">", has_declarations ? behind(text, "]", open) : at);
}

/// The name of the root element; empty where the text is no XML.
std::string_view root_element(std::string_view text) {
  std::size_t at = text.starts_with("\xEF\xBB\xBF") ? 3 : 0;
  for (;;) {
    at = std::min(text.find_first_not_of(" \t\r\n", at), text.size());
    const std::string_view rest = text.substr(at);
    if (rest.starts_with("<!--")) {
      at = behind(text, "-->", at + 4);
    } else if (rest.starts_with("<?")) {
      at = behind(text, "?>", at);
    } else if (rest.starts_with("<!")) {
      at = behind_document_type(text, at);
    } else {
      return rest.starts_with('<') ? rest.substr(1, rest.find_first_of(" \t\r\n/>") - 1)
                                   : std::string_view();
    }
  }
}

/// Told by the root element: a URDF may hold <mujoco> too, further down or in a comment.
bool is_mjcf(std::string_view text) {
  const std::string_view root = root_element(text);
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

Result<robot::RobotModel> read_model(const std::string& path, const ConvertFileOptions& options,
                                     bytes::ReadPolicy& policy, Diagnostics& diagnostics) {
  TENON_TRY(const auto bytes,
            policy.is_closed() ? policy.open(path) : policy.files()->open(path, {}));
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
