// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/structure/package.h"

#include "tenon/base/content_digest.h"
#include "tenon/bytes/read_record.h"
#include "tenon/formats/open_layer.h"
#include "tenon/formats/save_layer.h"
#include "tenon/layer/field_values.h"
#include "tenon/layer/fields.h"
#include "tenon/structure/layout.h"
#include "tenon/structure/shared_arrays.h"
#include "tenon/structure/written_note.h"

namespace tenon::structure {
namespace {

namespace fields = layer::fields;

constexpr std::string_view kRoot = "/package/";

/// A fault of the writers, since the layer comes from no file.
Error unreadable(const Error& cause, const std::string& name) {
  return Error(ErrorCode::Invalid, "the structured asset could not be read: " + cause.to_string())
      .in_file(name)
      .with_rule("structure.differs")
      .with_fix("nothing was written; please report the asset");
}

}  // namespace

layer::LayerPtr selections_layer(Token prim, const std::map<std::string, std::string>& selections) {
  layer::Layer session("anon:selections.usda");
  const Path path = Path::absolute_root().child(prim);
  session.root().set(fields::primChildren, std::vector<Token>{prim});
  layer::Spec& spec = session.create(path, layer::SpecKind::Prim);
  spec.set(fields::specifier, layer::Specifier::Over);
  layer::VariantSelections chosen;
  chosen.items.insert(selections.begin(), selections.end());
  spec.set(fields::variantSelection, std::move(chosen));
  return std::make_shared<layer::Layer>(std::move(session));
}

std::string identifier_in_package(const std::string& name) { return std::string(kRoot) + name; }

compose::LayerOpener opener_of(const Package& package) {
  return [&package](const std::string& asset_path,
                    const layer::Layer& anchor) -> Result<layer::LayerPtr> {
    const std::string target = target_of(asset_path, anchor);
    const bool inside = target.starts_with(kRoot);
    const auto found = package.files.find(inside ? target.substr(kRoot.size()) : "");
    if (found == package.files.end() || found->second.layer == nullptr) {
      return Error(ErrorCode::NotFound, "the package has no layer @" + asset_path + "@")
          .in_file(anchor.identifier());
    }
    return found->second.layer;
  };
}

Result<stage::Stage> open_package(const Package& package,
                                  const std::map<std::string, std::string>& selections,
                                  std::size_t max_work) {
  const layer::LayerPtr interface = package.files.at(package.interface).layer;
  stage::StageOptions options;
  options.compose.set_max_work(max_work);
  options.resolve_asset = [&package](const std::string& path, const layer::Layer& anchor) {
    const std::string target = target_of(path, anchor);
    const bool inside = target.starts_with(kRoot);
    return inside && package.files.contains(target.substr(kRoot.size())) ? target : std::string();
  };
  return stage::Stage::open(interface, selections_layer(interface->default_prim(), selections),
                            opener_of(package), options);
}

namespace {

Result<void> store_layer(const std::string& name, PackageFile& file, const Digests* others) {
  layer::LayerPtr wanted = file.layer;
  if (others != nullptr) {
    auto noted = std::make_shared<layer::Layer>(*wanted);
    add_note(*noted, name, *others, file.format);
    wanted = std::move(noted);
  }
  auto contents = formats::encode_layer(*wanted, file.format);
  if (!contents) {
    return unreadable(std::move(contents).error(), name);
  }
  if (others != nullptr) {
    seal(*contents, name);
  }
  file.bytes = bytes::FileBytes::own(*std::move(contents));
  Diagnostics ignored;  // what is not as it was is found by comparing
  auto layer = formats::read_layer(file.bytes, file.layer->identifier(), ignored);
  if (!layer) {
    return unreadable(std::move(layer).error(), name);
  }
  if (file.format == formats::LayerFormat::Crate) {
    share_arrays(*file.layer, *layer);
  }
  file.layer = std::make_shared<layer::Layer>(*std::move(layer));
  return {};
}

}  // namespace

Result<void> store_layers(Package& package) {
  Digests digests;
  for (auto& [name, file] : package.files) {
    if (name == package.interface) {
      continue;
    }
    if (file.layer != nullptr) {
      TENON_CHECK(store_layer(name, file, nullptr));
    }
    digests.emplace(name, content_digest(file.bytes->text()));
  }
  return store_layer(package.interface, package.files.at(package.interface), &digests);
}

Result<void> add_stored_file(Package& package, const std::string& name, std::string contents) {
  package.files[name].bytes = bytes::FileBytes::own(std::move(contents));
  Digests digests;
  for (const auto& [other, file] : package.files) {
    if (other != package.interface) {
      digests.emplace(other, content_digest(file.bytes->text()));
    }
  }
  return store_layer(package.interface, package.files.at(package.interface), &digests);
}

Result<void> write_package(const Package& package, const std::string& folder,
                           const WriteOptions& options) {
  std::map<std::string, std::string_view> files;
  for (const auto& [name, file] : package.files) {
    files[name] = file.bytes->text();
  }
  return write_folder(files, folder, options);
}

}  // namespace tenon::structure
