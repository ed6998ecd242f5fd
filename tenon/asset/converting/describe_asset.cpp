// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/converting/describe_asset.h"

#include <filesystem>
#include <map>
#include <utility>

#include "tenon/asset/converting/kept_mjcf.h"
#include "tenon/asset/export_mjcf.h"
#include "tenon/asset/export_urdf.h"
#include "tenon/asset/physics_options.h"
#include "tenon/asset_policy.h"
#include "tenon/base/content_digest.h"
#include "tenon/physics/read_physics.h"

namespace tenon {
namespace {

namespace fs = std::filesystem;

/// With the files beside it that it names. It records what was written, for the next run.
NotedFiles noted(const std::string& text, const std::map<std::string, std::string>& files,
                 const std::string& output) {
  const fs::path folder = fs::path(output).parent_path();
  NotedFiles made;
  for (const auto& [name, contents] : files) {
    made.beside.emplace(name, content_digest(contents));
    made.files.push_back({(folder / name).string(), contents});
  }
  made.files.push_back({output, structure::noted_description(text, made.beside)});
  return made;
}

/// The name of the folder beside the output for files of a kind.
std::string folder_beside(const std::string& output, const char* ending) {
  return fs::path(output).stem().string() + ending;
}

Result<AssetDescription> as_mjcf(const stage::Stage& stage, const bytes::ReadPolicy& policy,
                                 const std::string& output, Diagnostics& diagnostics) {
  const scene::PhysicsScene scene = physics::read_physics(stage, read_options(), diagnostics);
  std::optional<ExportedMjcf> kept =
      kept_mjcf(stage, scene, fs::path(output).stem().string(), policy, diagnostics);
  if (kept) {
    return AssetDescription{noted(kept->text, kept->images, output), DescriptionFormat::Mjcf,
                            scene.bodies.size(), scene.joints.size(), kept->images.size()};
  }
  TENON_TRY(const ExportedMjcf model,
            export_mjcf(stage, scene, folder_beside(output, "_images"), policy, diagnostics));
  return AssetDescription{noted(model.text, model.images, output), DescriptionFormat::Mjcf,
                          scene.bodies.size(), scene.joints.size(), model.images.size()};
}

Result<AssetDescription> as_urdf(const stage::Stage& stage, const std::string& output,
                                 Diagnostics& diagnostics) {
  TENON_TRY(const ExportedUrdf urdf,
            export_urdf(stage, folder_beside(output, "_meshes"), diagnostics));
  return AssetDescription{noted(urdf.text, urdf.meshes, output), DescriptionFormat::Urdf,
                          urdf.links, urdf.joints, urdf.meshes.size()};
}

}  // namespace

Result<AssetDescription> describe_asset(const std::string& path, const OpenOptions& open,
                                        DescriptionFormat format, const std::string& output,
                                        Diagnostics& diagnostics) {
  TENON_TRY(const stage::Stage stage, tenon::open(path, open, diagnostics));
  const bytes::ReadPolicy policy = policy_for(path, open);
  name_outside_layers(stage, policy, diagnostics);
  return format == DescriptionFormat::Urdf ? as_urdf(stage, output, diagnostics)
                                           : as_mjcf(stage, policy, output, diagnostics);
}

answers::Json description_json(const AssetDescription& description, const std::string& output) {
  if (description.format == DescriptionFormat::Mjcf) {
    return {{"output", output}, {"bodies", description.links}, {"joints", description.joints}};
  }
  return {{"output", output},
          {"links", description.links},
          {"joints", description.joints},
          {"meshes", description.files_beside}};
}

}  // namespace tenon
