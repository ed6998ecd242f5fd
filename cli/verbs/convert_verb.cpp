// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The ending of the input decides the direction: assets become MJCF or URDF, all else is a
// description and becomes an asset. Each output carries a note with digests of itself and of the
// files beside it. By this note a later run sees that somebody edited them: it asks before the work
// and once more when nobody else can write. A package holds checksums over its own digest and is
// therefore made twice. Images in no file of their own, and those outside of the folders of the
// output, come along in a folder beside a single layer.
#include <algorithm>
#include <filesystem>
#include <set>

#include "cli/output.h"
#include "cli/output_place.h"
#include "cli/progress.h"
#include "cli/report.h"
#include "cli/verb.h"
#include "tenon/asset/convert_file.h"
#include "tenon/asset/export_mjcf.h"
#include "tenon/asset/export_urdf.h"
#include "tenon/asset/physics_options.h"
#include "tenon/asset/structure_asset.h"
#include "tenon/asset_policy.h"
#include "tenon/base/assignment.h"
#include "tenon/base/content_digest.h"
#include "tenon/base/text/shown_path.h"
#include "tenon/base/text/text_number.h"
#include "tenon/bytes/asset_resolver.h"
#include "tenon/bytes/file_bytes.h"
#include "tenon/formats/package/asset_paths.h"
#include "tenon/formats/save_layer.h"
#include "tenon/pack_asset.h"
#include "tenon/physics/read_physics.h"
#include "tenon/structure/written_note.h"
#include "tenon/tenon.h"

namespace tenon::cli {
namespace {

namespace fs = std::filesystem;

struct ConvertArguments {
  std::string input;
  std::string output;
  std::vector<std::string> packages;
  FileAccess files;
  std::string gains;
  std::string schema = "current";
  std::string physics;
  bool fix_base = false;
  bool float_base = false;
  bool merge_fixed = false;
  bool scene = false;
  bool flat = false;
  bool force = false;
};

/// "K,D", both numbers.
std::optional<convert::Gains> gains_of(const std::string& text) {
  const std::size_t comma = text.find(',');
  if (comma == std::string::npos) {
    return std::nullopt;
  }
  const auto stiffness = parse_double(text.substr(0, comma));
  const auto damping = parse_double(text.substr(comma + 1));
  if (!stiffness || !damping || !(*stiffness >= 0) || !(*damping >= 0)) {
    return std::nullopt;
  }
  return convert::Gains{*stiffness, *damping};
}

/// A JSON object: joint -> [K, D], "*" for all others.
Result<void> read_gains_file(const std::string& path, convert::ConvertOptions& options) {
  const auto fault = [&](const std::string& message) {
    return Error(ErrorCode::Invalid, message)
        .in_file(path)
        .with_fix("write {\"joint\": [K, D], \"*\": [K, D]} in N m/rad and N m s/rad");
  };
  const auto file = bytes::FileBytes::open(path);
  if (!file) {
    return fault("the gains are neither two numbers K,D nor a file that can be read");
  }
  const Json json = Json::parse((*file)->text(), nullptr, false);
  if (!json.is_object()) {
    return fault("the gains file is not a JSON object");
  }
  for (const auto& [name, pair] : json.items()) {
    const bool sound = pair.is_array() && pair.size() == 2 && pair[0].is_number() &&
                       pair[1].is_number() && pair[0].get<double>() >= 0 &&
                       pair[1].get<double>() >= 0;
    if (!sound) {
      return fault("the gains of \"" + name + "\" are not two numbers of 0 or more");
    }
    const convert::Gains gains{pair[0].get<double>(), pair[1].get<double>()};
    if (name == "*") {
      options.gains = gains;
    } else {
      options.joint_gains[name] = gains;
    }
  }
  return {};
}

Result<ConvertFileOptions> convert_options(const ConvertArguments& options) {
  ConvertFileOptions result;
  result.open = options.files.open_options();
  result.robot.flat = options.flat;
  result.robot.fix_base = options.fix_base;
  result.robot.float_base = options.float_base;
  result.robot.merge_fixed = options.merge_fixed;
  result.robot.scene = options.scene;
  result.robot.schema = options.schema == "legacy" ? convert::SchemaGeneration::Legacy
                        : options.schema == "both" ? convert::SchemaGeneration::Both
                                                   : convert::SchemaGeneration::Current;
  if (!options.gains.empty()) {
    result.robot.gains = gains_of(options.gains);
    if (!result.robot.gains) {
      TENON_CHECK(read_gains_file(options.gains, result.robot));
    }
  }
  for (const std::string& text : options.packages) {
    TENON_TRY(auto package, split_assignment(text));
    result.packages.insert(std::move(package));
  }
  return result;
}

/// Absolute asset paths become relative to the folder of `output`.
void make_relative(layer::Layer& layer, const std::string& output) {
  const fs::path folder = fs::absolute(output).lexically_normal().parent_path();
  for (const layer::Layer::Entry& entry : layer.entries()) {
    const auto* asset = entry.spec.get<layer::AssetPath>(layer::fields::default_value);
    if (asset == nullptr || !fs::path(asset->authored).is_absolute()) {
      continue;
    }
    std::string name = fs::path(asset->authored).lexically_relative(folder).generic_string();
    if (!name.starts_with("../")) {
      name.insert(0, "./");
    }
    layer.find(entry.path)
        ->set(layer::fields::default_value,
              layer::Value(layer::AssetPath{std::move(name), "", ""}));
  }
}

std::string name_of_image(const std::string& identifier) {
  const std::string inner = bytes::split_package_path(identifier).inner;
  return inner.empty() ? fs::path(identifier).filename().string() : inner;
}

/// Images of the description's folders that would lie outside of the folders of the output: they
/// have to come along, for the asset to be whole.
convert::InnerImages images_elsewhere(const ConvertedFile& converted,
                                      const ConvertArguments& options) {
  convert::InnerImages found;
  if (bytes::is_package_name(options.output)) {
    return found;  // takes them in
  }
  const bytes::ReadPolicy here = policy_for(options.output, {});
  layer::Layer copy = converted.layer;
  formats::rename_assets(copy, [&](const std::string& asset, formats::AssetUse use, Path) {
    const bool is_file = use == formats::AssetUse::Value && fs::path(asset).is_absolute();
    if (is_file && !converted.images.contains(asset) && !here.allows(asset)) {
      if (const auto contents = converted.reading.open(asset)) {
        found.emplace(asset, std::string((*contents)->text()));
      }
    }
    return asset;
  });
  return found;
}

/// Images, those inside of mesh files for one, get places in a folder of their own beside the
/// output; asset paths follow. The images by their places.
convert::InnerImages place_images(convert::InnerImages images, const ConvertArguments& options,
                                  layer::Layer& layer) {
  convert::InnerImages placed;
  if (images.empty()) {
    return placed;
  }
  const fs::path output = fs::absolute(options.output).lexically_normal();
  const fs::path folder = output.parent_path() / (output.stem().string() + "_images");
  std::map<std::string, std::string> place_of;
  std::set<std::string> taken;
  for (auto& [identifier, contents] : images) {
    const fs::path name(name_of_image(identifier));
    std::string free = name.string();
    for (int i = 2; !taken.insert(free).second; ++i) {
      free = name.stem().string() + "_" + std::to_string(i) + name.extension().string();
    }
    const std::string place = (folder / free).generic_string();
    placed.emplace(place, std::move(contents));
    place_of.emplace(identifier, place);
  }
  formats::rename_assets(layer, [&](const std::string& asset, formats::AssetUse, Path) {
    const auto place = place_of.find(asset);
    return place == place_of.end() ? asset : place->second;
  });
  return placed;
}

/// Digests of files beside the output, by their names from there.
structure::Digests digests_of(const convert::InnerImages& files, const std::string& output) {
  const fs::path folder = fs::absolute(output).lexically_normal().parent_path();
  structure::Digests digests;
  for (const auto& [place, contents] : files) {
    digests.emplace(fs::path(place).lexically_relative(folder).generic_string(),
                    content_digest(contents));
  }
  return digests;
}

/// What was edited since it was written stays, without --force; what is not known to have been
/// written, too.
Result<void> commit_unedited(const ConvertArguments& options, const structure::Digests& beside,
                             Outputs& outputs) {
  if (!options.force) {
    outputs.check_before_commit(
        [&] { return structure::check_not_edited(options.output, beside); });
  }
  return outputs.commit();
}

/// A package holds checksums: it is made once to know the digest, once more with it.
Result<std::string> noted_package(layer::Layer layer, const convert::InnerImages& images,
                                  const bytes::ReadPolicy& policy, const ConvertArguments& options,
                                  Diagnostics& diagnostics) {
  OpenOptions open;
  open.allowed_reads = policy.roots();
  const std::string name = fs::path(options.output).filename().string();
  structure::add_note(layer, name, {}, formats::LayerFormat::Package);
  TENON_TRY(const std::string first, pack_layer(layer, options.output, open, images, diagnostics));
  structure::set_own_digest(layer, structure::own_digest(first, name));
  Diagnostics known;
  return pack_layer(std::move(layer), options.output, open, images, known);
}

/// One file, and images beside it. It says what was written, for the next time.
Result<void> write_file(ConvertedFile& converted, const ConvertArguments& options, Outputs& outputs,
                        Diagnostics& diagnostics) {
  layer::Layer& layer = converted.layer;
  TENON_TRY(const formats::LayerFormat format, formats::layer_format_for(options.output));
  convert::InnerImages images = place_images(std::move(converted.images), options, layer);
  if (format == formats::LayerFormat::Package) {  // takes them in
    TENON_TRY(std::string package,
              noted_package(std::move(layer), images, converted.reading, options, diagnostics));
    outputs.put(options.output, std::move(package));
    return commit_unedited(options, {}, outputs);
  }
  make_relative(layer, options.output);
  const std::string name = fs::path(options.output).filename().string();
  const structure::Digests digests = digests_of(images, options.output);
  structure::add_note(layer, name, digests, format);
  for (auto& [place, contents] : images) {
    outputs.put_beside(place, std::move(contents));
  }
  TENON_TRY(std::string contents, formats::encode_layer(layer, format));
  structure::seal(contents, name);
  outputs.put(options.output, std::move(contents));
  return commit_unedited(options, digests, outputs);
}

/// As `tenon structure` would make of the same asset in a file, proven in the same way.
Result<void> write_structure(layer::Layer layer, const ConvertedFile& converted,
                             const ConvertArguments& options, Diagnostics& diagnostics) {
  const convert::InnerImages& images = converted.images;
  structure::AssetSource source = asset_source(std::move(layer), converted.reading);
  const auto resolve = source.resolve_asset;
  source.resolve_asset = [&images, resolve](const std::string& asset, const layer::Layer& anchor) {
    return images.contains(asset) ? asset : resolve(asset, anchor);
  };
  const auto open = source.open_asset;
  source.open_asset = [&images,
                       open](const std::string& asset) -> decltype(source.open_asset(asset)) {
    const auto image = images.find(asset);
    if (image == images.end()) {
      return open(asset);
    }
    return bytes::FileBytes::own(image->second);
  };
  TENON_TRY(const structure::StructuredAsset asset,
            structure::make_package(source, {}, diagnostics));
  return write_asset(asset.package, options.output, {.force = options.force});
}

/// What would be lost is told before the work.
Result<void> claim(const ConvertArguments& options, OutputKind kind, Outputs& outputs) {
  TENON_CHECK(outputs.claim(kind, options.output));
  return options.force ? Result<void>() : structure::check_not_edited(options.output);
}

Result<ConvertedFile> convert_and_write(const ConvertArguments& options, Diagnostics& diagnostics) {
  TENON_TRY(const ConvertFileOptions wanted, convert_options(options));
  const bool folder = names_folder(options.output);  // straight into Asset Structure 3.0
  Outputs outputs;
  TENON_CHECK(folder ? structure::check_folder(options.output, {.force = options.force})
                     : claim(options, OutputKind::Layer, outputs));
  TENON_TRY(ConvertedFile converted, convert_file(options.input, wanted, diagnostics));
  if (folder) {
    TENON_CHECK(write_structure(converted.layer, converted, options, diagnostics));
  } else {
    converted.images.merge(images_elsewhere(converted, options));
    TENON_CHECK(write_file(converted, options, outputs, diagnostics));
  }
  return converted;
}

/// With the files beside it that it names. It says what was written, for the next time.
Result<void> write_description(const std::string& text,
                               const std::map<std::string, std::string>& files,
                               const ConvertArguments& options, Outputs& outputs) {
  const fs::path folder = fs::path(options.output).parent_path();
  structure::Digests digests;
  for (const auto& [name, contents] : files) {
    digests.emplace(name, content_digest(contents));
    outputs.put_beside((folder / name).string(), contents);
  }
  outputs.put(options.output, structure::noted_description(text, digests));
  return commit_unedited(options, digests, outputs);
}

OpenOptions open_options(const ConvertArguments& options) {
  OpenOptions open = options.files.open_options();
  open.physics_variant = options.physics;
  return open;
}

/// The other way: an asset's physics as a model of MuJoCo.
int run_export(Report& report, const ConvertArguments& options) {
  Outputs outputs;
  if (auto claimed = claim(options, OutputKind::Description, outputs); !claimed) {
    return report.fail(claimed.error());
  }
  auto stage = open_stage(options.input, open_options(options), report.diagnostics);
  if (!stage) {
    return report.fail(stage.error());
  }
  const bytes::ReadPolicy policy = policy_for(options.input, open_options(options));
  name_outside_layers(*stage, policy, report.diagnostics);
  const scene::PhysicsScene scene =
      physics::read_physics(*stage, read_options(), report.diagnostics);
  const std::string folder = fs::path(options.output).stem().string() + "_images";
  const auto model = export_mjcf(*stage, scene, folder, policy, report.diagnostics);
  if (!model) {
    return report.fail(model.error());
  }
  const auto written = write_description(model->text, model->images, options, outputs);
  if (!written) {
    return report.fail(written.error());
  }
  return report.finish(left_out(report.diagnostics) ? kNo : kOk, {{"output", options.output},
                                                                  {"bodies", scene.bodies.size()},
                                                                  {"joints", scene.joints.size()}});
}

int run_export_urdf(Report& report, const ConvertArguments& options) {
  Outputs outputs;
  if (auto claimed = claim(options, OutputKind::Description, outputs); !claimed) {
    return report.fail(claimed.error());
  }
  auto stage = open_stage(options.input, open_options(options), report.diagnostics);
  if (!stage) {
    return report.fail(stage.error());
  }
  name_outside_layers(*stage, policy_for(options.input, open_options(options)), report.diagnostics);
  const std::string folder = fs::path(options.output).stem().string() + "_meshes";
  const auto urdf = export_urdf(*stage, folder, report.diagnostics);
  if (!urdf) {
    return report.fail(urdf.error());
  }
  const auto written = write_description(urdf->text, urdf->meshes, options, outputs);
  if (!written) {
    return report.fail(written.error());
  }
  report.note("wrote " + shown_path(options.output) + ": " + std::to_string(urdf->links) +
              " links, " + std::to_string(urdf->joints) + " joints, " +
              std::to_string(urdf->meshes.size()) + " mesh files");
  return report.finish(kOk, {{"output", options.output},
                             {"links", urdf->links},
                             {"joints", urdf->joints},
                             {"meshes", urdf->meshes.size()}});
}

bool ends_in(const std::string& path, std::initializer_list<const char*> endings) {
  std::string ending = fs::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  return std::find(endings.begin(), endings.end(), ending) != endings.end();
}

int run_convert(const Globals& globals, const ConvertArguments& options) {
  Report report(globals, "convert", options.input);
  const Progress progress(globals, "converting " + shown_path(options.input));
  if (ends_in(options.input, {".usda", ".usdc", ".usd", ".usdz"})) {
    if (ends_in(options.output, {".urdf"})) {
      return run_export_urdf(report, options);
    }
    if (!ends_in(options.output, {".xml"})) {
      return report.fail(
          Error(ErrorCode::Unsupported, "an asset can be converted to MJCF or URDF only")
              .with_fix("name the output .xml or .urdf; `tenon cat` and `tenon structure` write "
                        "assets"));
    }
    return run_export(report, options);
  }
  const auto converted = convert_and_write(options, report.diagnostics);
  if (!converted) {
    return report.fail(converted.error());
  }
  report.note("wrote " + shown_path(options.output) + ": " + std::to_string(converted->links) +
              " links, " + std::to_string(converted->joints) + " joints, " +
              std::to_string(converted->meshes) + " mesh files");
  return report.finish(report.diagnostics.has_errors() ? kNo : kOk,
                       {{"output", options.output},
                        {"links", converted->links},
                        {"joints", converted->joints},
                        {"meshes", converted->meshes}});
}

}  // namespace

void add_convert(const Command& parent, const Globals& globals, Chosen& chosen) {
  const Command verb = parent.add_subcommand(
      "convert",
      "Convert a robot description (URDF, MJCF) to an asset, or an asset to a description");
  auto options = std::make_shared<ConvertArguments>();
  verb.add_option("input", options->input, "A URDF or MJCF file, or an asset")
      .required()
      .file_only();
  verb.add_option("output", options->output,
                  "A .usda, .usdc, .usd or .usdz file, or a folder for Asset Structure 3.0; for an "
                  "asset an .xml or .urdf file")
      .required();
  verb.add_option("--package", options->packages,
                  "NAME=DIR: where a ROS package is; without "
                  "it, the folders above the input are searched")
      .repeatable();
  options->files.add_to(verb);
  verb.add_flag("--fix-base", options->fix_base, "Hold the root link in the world");
  verb.add_flag("--float-base", options->float_base,
                "A root link without mass is free to move, as that of a walking robot; else it "
                "stands still");
  verb.add_flag("--merge-fixed", options->merge_fixed,
                "Make links on fixed joints parts of the links that hold them");
  verb.add_option("--physics", options->physics,
                  "Of an asset: the variant of its set \"Physics\" to describe");
  verb.add_flag("--scene", options->scene,
                "Keep a MJCF model's world as a PhysicsScene: gravity, time step, options");
  verb.add_flag("--flat", options->flat, "Links side by side, not nested");
  verb.add_flag("--force", options->force,
                "Overwrite an asset or a description that was edited since it was written");
  verb.add_option("--gains", options->gains,
                  "K,D: a drive for each joint that follows no other, in N m/rad and N m s/rad "
                  "(N/m and N s/m); or a JSON file {\"joint\": [K, D], \"*\": [K, D]}");
  verb.add_option("--schema", options->schema,
                  "Vendors' schemas for joints: current (Newton, PhysX joint axes), legacy (PhysX "
                  "joints and mimics of Isaac Sim 5, MuJoCo) or both")
      .one_of({"current", "legacy", "both"});
  verb.footer(
      "Examples:\n  tenon convert hand.urdf hand.usda\n"
      "  tenon convert hand.urdf hand/     one file for each concern, as tenon structure makes it\n"
      "  tenon convert arm.urdf arm.usdc --fix-base --gains 400,40\n"
      "  tenon convert humanoid.xml humanoid.usda\n  tenon convert hand.usda hand.xml\n"
      "  tenon convert hand.usda hand.urdf\n"
      "  tenon convert ur5.urdf ur5.usdz --package ur_description=../ur_description\n"
      "Exit code 1: written, but something of the robot is left out; each case is listed.");
  choose(verb, chosen, [&globals, options] { return run_convert(globals, *options); });
}

}  // namespace tenon::cli
