// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/export_mjcf.h"

#if TENON_WITH_MUJOCO
#include <filesystem>
#include <set>

#include "tenon/base/file_finding.h"
#include "tenon/bytes/asset_resolver.h"
#include "tenon/bytes/file_kind.h"
#include "tenon/describe/describe_visuals.h"
#include "tenon/layer/fields.h"
#include "tenon/mjcf/write_model.h"
#include "tenon/physics/vendors/read_mujoco_parts.h"
#endif

namespace tenon {

#if TENON_WITH_MUJOCO
namespace {

/// Copies images, each once.
class ImageCopier {
 public:
  ImageCopier(std::string folder, const bytes::ReadPolicy& policy, Diagnostics& diagnostics)
      : folder_(std::move(folder)), policy_(policy), diagnostics_(diagnostics) {}

  /// The name of the copy; empty where there is none.
  std::string copy(const std::string& file) {
    const auto [at, is_new] = copies_.try_emplace(file);
    if (is_new) {
      at->second = read(file);
    }
    return at->second;
  }
  std::map<std::string, std::string> take() { return std::move(images_); }

 private:
  std::string read(const std::string& file) {
    const auto bytes = policy_.open(file);
    if (!bytes && bytes.error().diagnostic().rule == bytes::kOutsideRule) {
      const Diagnostic& why = bytes.error().diagnostic();
      diagnostics_.add(file_finding(Severity::Error, why.rule, why.message + "; it is skipped",
                                    file, 0, why.fix));
      return {};
    }
    if (!bytes || !bytes::is_png((*bytes)->text())) {
      diagnostics_.add(file_finding(Severity::Warning, "mjcf.left-out",
                                    "the image is not a PNG, which is all that MuJoCo reads; it is "
                                    "skipped",
                                    file, 0, "save the image as PNG"));
      return {};
    }
    const std::string inner = bytes::split_package_path(file).inner;
    const std::filesystem::path name =
        std::filesystem::path(inner.empty() ? file : inner).filename();
    std::string place = folder_ + "/" + name.string();
    for (int i = 2; images_.contains(place); ++i) {
      place = folder_ + "/" + name.stem().string() + "_" + std::to_string(i) +
              name.extension().string();
    }
    images_.emplace(place, std::string((*bytes)->text()));
    return place;
  }

  std::string folder_;
  const bytes::ReadPolicy& policy_;
  Diagnostics& diagnostics_;
  std::map<std::string, std::string> copies_;
  std::map<std::string, std::string> images_;
};

/// Display names where prims have such, as descriptions have names that prims cannot have.
mjcf::NameOf names_on(const stage::Stage& stage) {
  return [&stage](std::string_view path) {
    const Path at = Path::from(path);
    if (const stage::Prim prim = stage.prim(at)) {
      const layer::Value shown = prim.metadata(layer::fields::displayName);
      if (const auto* text = shown.get<std::string>(); text != nullptr && !text->empty()) {
        return *text;
      }
    }
    return at.name().str();
  };
}

}  // namespace

Result<ExportedMjcf> export_mjcf(const stage::Stage& stage, const scene::PhysicsScene& scene,
                                 const std::string& folder, const bytes::ReadPolicy& policy,
                                 Diagnostics& diagnostics) {
  robot::RobotModel visuals = describe::describe_visuals(stage, scene, diagnostics);
  ImageCopier copier(folder, policy, diagnostics);
  for (robot::Material& material : visuals.materials) {
    if (!material.texture.empty()) {
      material.texture = copier.copy(material.texture);
    }
    for (robot::MaterialImage& image : material.images) {
      image.file = copier.copy(image.file);
    }
    std::erase_if(material.images,
                  [](const robot::MaterialImage& image) { return image.file.empty(); });
  }
  const stage::Prim root = stage.default_prim();
  visuals.name = root ? names_on(stage)(root.path().str()) : std::string();
  ExportedMjcf result;
  result.images = copier.take();
  TENON_TRY(result.text, mjcf::write_model(scene, visuals, result.images,
                                           physics::read_mujoco_parts(stage, scene),
                                           names_on(stage), diagnostics));
  return result;
}
#else
Result<ExportedMjcf> export_mjcf(const stage::Stage&, const scene::PhysicsScene&,
                                 const std::string&, const bytes::ReadPolicy&, Diagnostics&) {
  return Error(ErrorCode::Missing, "MuJoCo writes MJCF, and this build is without it")
      .with_fix("build with -DTENON_WITH_MUJOCO=ON");
}
#endif

}  // namespace tenon
