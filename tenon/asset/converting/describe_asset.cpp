// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// One function for each format makes its text and the files next to it; all of them are values
// until the caller writes them. A configuration of Isaac Lab opens the asset itself, one of mjlab
// the MJCF that is made with it.
#include "tenon/asset/converting/describe_asset.h"

#include <filesystem>
#include <map>
#include <optional>
#include <utility>

#include "tenon/asset/converting/kept_mjcf.h"
#include "tenon/asset/export_mjcf.h"
#include "tenon/asset/export_urdf.h"
#include "tenon/asset/exporting/export_cfg.h"
#include "tenon/asset/exporting/export_sdf.h"
#include "tenon/asset/exporting/export_srdf.h"
#include "tenon/asset/exporting/joint_motors.h"
#include "tenon/asset/exporting/mesh_files.h"
#include "tenon/asset/exporting/ros2_control.h"
#include "tenon/asset/physics_options.h"
#include "tenon/asset_policy.h"
#include "tenon/base/content_digest.h"
#include "tenon/bytes/files.h"
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

class Description {
 public:
  Description(const stage::Stage& stage, const bytes::ReadPolicy& policy,
              const DescribeOptions& options, std::string output, Diagnostics& diagnostics)
      : stage_(stage),
        policy_(policy),
        options_(options),
        output_(std::move(output)),
        stem_(fs::path(output_).stem().string()),
        diagnostics_(diagnostics) {}

  Result<AssetDescription> run(const std::string& asset) {
    switch (options_.format) {
      case DescriptionFormat::Mjcf:
        return as_mjcf();
      case DescriptionFormat::Urdf:
        return as_urdf(false);
      case DescriptionFormat::Ros2Control:
        return as_urdf(true);
      case DescriptionFormat::Sdf:
        return as_sdf();
      case DescriptionFormat::Srdf:
        return as_srdf();
      case DescriptionFormat::IsaacLab:
        return as_isaaclab(asset);
      case DescriptionFormat::Mjlab:
        return as_mjlab();
    }
    return Error(ErrorCode::Unsupported, "the format is not known");
  }

 private:
  scene::PhysicsScene physics_of() {
    return physics::read_physics(stage_, read_options(), diagnostics_);
  }
  std::string folder(const char* ending) const {
    return options_.assets.empty() ? stem_ + ending : options_.assets;
  }

  /// The model, with its meshes in files where `assets` names a folder for them.
  Result<ExportedMjcf> mjcf_of(const scene::PhysicsScene& scene, const std::string& assets) {
    const std::string stem = assets.empty() ? stem_ : assets + "/" + stem_;
    std::optional<ExportedMjcf> kept = kept_mjcf(stage_, scene, stem, policy_, diagnostics_);
    if (kept) {
      return *std::move(kept);
    }
    TENON_TRY(ExportedMjcf model,
              export_mjcf(stage_, scene, assets.empty() ? stem_ + "_images" : assets, policy_,
                          diagnostics_));
    if (!assets.empty()) {
      model.text = with_mesh_files(model.text, assets, model.images);
    }
    return model;
  }

  Result<AssetDescription> as_mjcf() {
    const scene::PhysicsScene scene = physics_of();
    TENON_TRY(const ExportedMjcf model, mjcf_of(scene, options_.assets));
    return AssetDescription{noted(model.text, model.images, output_), DescriptionFormat::Mjcf,
                            scene.bodies.size(), scene.joints.size(), model.images.size()};
  }

  Result<AssetDescription> as_urdf(bool with_control) {
    TENON_TRY(ExportedUrdf urdf, export_urdf(stage_, folder("_meshes"), diagnostics_));
    if (with_control) {
      Diagnostics of_physics;  // told above
      const scene::PhysicsScene scene = physics::read_physics(stage_, read_options(), of_physics);
      const auto motors =
          joint_motors(stage_, scene, "ros2_control.left-out", "ros2_control", diagnostics_);
      const stage::Prim root = stage_.default_prim();
      const std::string name = root ? root.name().str() : "robot";
      urdf.text.insert(urdf.text.rfind("</robot>"), ros2_control_block(name, motors));
    }
    return AssetDescription{noted(urdf.text, urdf.meshes, output_), options_.format, urdf.links,
                            urdf.joints, urdf.meshes.size()};
  }

  Result<AssetDescription> as_sdf() {
    TENON_TRY(const ExportedUrdf sdf, export_sdf(stage_, folder("_meshes"), diagnostics_));
    return AssetDescription{noted(sdf.text, sdf.meshes, output_), DescriptionFormat::Sdf, sdf.links,
                            sdf.joints, sdf.meshes.size()};
  }

  Result<AssetDescription> as_srdf() {
    TENON_TRY(const ExportedSrdf srdf, export_srdf(stage_, diagnostics_));
    return AssetDescription{noted(srdf.text, {}, output_), DescriptionFormat::Srdf, srdf.links,
                            srdf.joints, 0};
  }

  Result<AssetDescription> as_isaaclab(const std::string& asset) {
    const scene::PhysicsScene scene = physics_of();
    const fs::path here = fs::path(bytes::absolute_file_path(output_)).parent_path();
    const std::string file =
        fs::path(bytes::absolute_file_path(asset)).lexically_relative(here).generic_string();
    const ExportedCfg cfg = export_cfg(stage_, scene, DescriptionFormat::IsaacLab, file,
                                       options_.open.physics_variant, diagnostics_);
    return AssetDescription{noted(cfg.text, {}, output_), DescriptionFormat::IsaacLab,
                            scene.bodies.size(), cfg.joints, 0};
  }

  Result<AssetDescription> as_mjlab() {
    const scene::PhysicsScene scene = physics_of();
    TENON_TRY(ExportedMjcf model, mjcf_of(scene, folder("_assets")));
    const std::string file = stem_ + ".xml";
    const ExportedCfg cfg =
        export_cfg(stage_, scene, DescriptionFormat::Mjlab, file, {}, diagnostics_);
    std::map<std::string, std::string> beside = std::move(model.images);
    const std::size_t files = beside.size();
    beside.emplace(file, std::move(model.text));
    return AssetDescription{noted(cfg.text, beside, output_), DescriptionFormat::Mjlab,
                            scene.bodies.size(), cfg.joints, files};
  }

  const stage::Stage& stage_;
  const bytes::ReadPolicy& policy_;
  const DescribeOptions& options_;
  std::string output_;
  std::string stem_;
  Diagnostics& diagnostics_;
};

/// Below the folder of the output, so that a note beside it can tell what belongs to it.
Result<void> check_assets(const DescribeOptions& options) {
  const fs::path folder(options.assets);
  const bool has_files =
      options.format != DescriptionFormat::Srdf && options.format != DescriptionFormat::IsaacLab;
  const bool below = folder.is_relative() && folder == folder.lexically_normal() &&
                     (folder.empty() || *folder.begin() != "..") && folder != ".";
  if (options.assets.empty() || (below && has_files && folder.has_filename())) {
    return {};
  }
  return Error(ErrorCode::Invalid,
               has_files ? "--assets is not the name of a folder below that of the output"
                         : "--assets has no effect: this format has no files beside it")
      .with_rule("convert.assets")
      .with_fix(has_files ? "give a name such as --assets meshes" : "leave --assets out");
}

}  // namespace

Result<AssetDescription> describe_asset(const std::string& path, const DescribeOptions& options,
                                        const std::string& output, Diagnostics& diagnostics) {
  TENON_CHECK(check_assets(options));
  TENON_TRY(const stage::Stage stage, tenon::open(path, options.open, diagnostics));
  const bytes::ReadPolicy policy = policy_for(path, options.open);
  name_outside_layers(stage, policy, diagnostics);
  return Description(stage, policy, options, output, diagnostics).run(path);
}

answers::Json description_json(const AssetDescription& description, const std::string& output) {
  if (description.format == DescriptionFormat::Mjcf) {
    return {{"output", output}, {"bodies", description.links}, {"joints", description.joints}};
  }
  if (description.format == DescriptionFormat::Srdf) {
    return {{"output", output}, {"links", description.links}, {"joints", description.joints}};
  }
  if (description.format == DescriptionFormat::IsaacLab ||
      description.format == DescriptionFormat::Mjlab) {
    return {{"output", output}, {"joints", description.joints}};
  }
  return {{"output", output},
          {"links", description.links},
          {"joints", description.joints},
          {"meshes", description.files_beside}};
}

}  // namespace tenon
