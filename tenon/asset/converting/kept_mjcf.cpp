// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The seal of the asset is compared with that of its conversion. The text is given out as it is,
// and nobody here reads it: it is as much the asset's own as a texture. Only the numbers of files
// in it are replaced, by places beside the output, and their bytes come from where the asset may
// read.
#include "tenon/asset/converting/kept_mjcf.h"

#include <algorithm>
#include <filesystem>
#include <map>

#include "tenon/answers/prim_walk.h"
#include "tenon/asset/converting/patch_model.h"
#include "tenon/base/file_finding.h"
#include "tenon/base/text/number_from_text.h"
#include "tenon/bytes/asset_resolver.h"
#include "tenon/bytes/file_kind.h"
#include "tenon/convert/source/record.h"
#include "tenon/convert/source/seal.h"
#include "tenon/describe/describe_visuals.h"
#include "tenon/layer/fields.h"
#include "tenon/physics/vendors/read_mujoco_parts.h"
#include "tenon/robot/mujoco_parts.h"

namespace tenon {
namespace {

convert::Seal seal_of_stage(const stage::Stage& stage, convert::SealParts& parts) {
  convert::SealMaker maker(stage.default_prim().path());
  answers::walk_prims(stage.pseudo_root(), [&](const stage::Prim& prim) {
    if (prim.is_pseudo_root() || !prim.is_active() || !prim.is_defined()) {
      return;
    }
    const Token type = prim.type_name();
    maker.add_prim(prim.path(), type, prim.authored_api_schemas());
    for (const Token name : prim.authored_property_names()) {
      if (prim.is_relationship(name)) {
        maker.add_targets(prim.path(), type, name, prim.relationship(name).targets());
      } else {
        maker.add_value(prim.path(), type, name, prim.attribute(name).get());
      }
    }
  });
  convert::Seal seal = maker.take();
  parts = maker.take_parts();
  return seal;
}

std::string named_few(const std::vector<std::string>& words) {
  constexpr std::size_t kNamed = 8;
  std::string text;
  for (std::size_t i = 0; i < std::min(words.size(), kNamed); ++i) {
    text += (i == 0 ? "" : ", ") + words[i];
  }
  return words.size() > kNamed ? text + " and " + std::to_string(words.size() - kNamed) + " more"
                               : text;
}

/// TextEdits for PhysX alone do not go into a model for MuJoCo, which is reported.
void leave_out_physx(std::vector<std::string>& changed, Diagnostics& diagnostics) {
  std::vector<std::string> left;
  std::erase_if(changed, [&](const std::string& word) {
    const bool physx = word.starts_with("physx") || word.starts_with("api:Physx");
    if (physx) {
      left.push_back(word);
    }
    return physx;
  });
  if (!left.empty()) {
    diagnostics.add(
        file_finding(Severity::Warning, "mjcf.left-out",
                     "edits for PhysX alone are skipped in the model: " + named_few(left), "", 0));
  }
}

/// What may accompany an edit that a model can take over: the schema that declares the property,
/// and properties of a material, which go to the shapes that it is bound to.
bool goes_along(const std::string& word, bool has_bindings) {
  constexpr std::string_view kSchemas[] = {"api:PhysicsMassAPI",     "api:NewtonMassAPI",
                                           "api:NewtonJointAPI",     "api:MjcJointAPI",
                                           "api:PhysicsMaterialAPI", "api:NewtonMaterialAPI"};
  constexpr std::string_view kFriction[] = {"physics:staticFriction", "physics:dynamicFriction",
                                            "newton:torsionalFriction", "newton:rollingFriction"};
  return std::find(std::begin(kSchemas), std::end(kSchemas), word) != std::end(kSchemas) ||
         (has_bindings &&
          std::find(std::begin(kFriction), std::end(kFriction), word) != std::end(kFriction));
}

/// TextEdits of single properties, and words that cannot be told apart so.
struct TextEdits {
  std::vector<PropertyEdit> single;
  std::vector<std::string> others;
};

TextEdits edits_of(const std::vector<std::string>& changed, const std::vector<std::string>& parts,
                   const convert::SealParts& now) {
  const bool has_bindings =
      std::any_of(changed.begin(), changed.end(),
                  [](const std::string& word) { return word.starts_with("material:binding"); });
  TextEdits edits;
  for (const std::string& word : changed) {
    if (goes_along(word, has_bindings)) {
      continue;
    }
    const auto prims = convert::edited_prims(parts, word, now);
    if (!prims) {
      edits.others.push_back(word);
      continue;
    }
    for (const Path prim : *prims) {
      edits.single.push_back({prim, word});
    }
  }
  return edits;
}

void report_written_anew(Diagnostics& diagnostics, const std::string& why) {
  diagnostics.add(file_finding(
      Severity::Warning, "mjcf.written-anew",
      "elements that only MJCF has are dropped, because the model is generated from the asset: " +
          why,
      "", 0));
}

/// Display names where prims have such.
std::string name_on(const stage::Stage& stage, Path path) {
  if (const stage::Prim prim = stage.prim(path)) {
    const layer::Value shown = prim.metadata(layer::fields::displayName);
    if (const auto* text = shown.get<std::string>(); text != nullptr && !text->empty()) {
      return *text;
    }
  }
  return path.name().str();
}

/// The visuals, where an edit is about them.
robot::RobotModel seen_of(const std::vector<PropertyEdit>& edits, const stage::Stage& stage,
                          const scene::PhysicsScene& scene) {
  const auto is_seen = [](const PropertyEdit& edit) {
    return edit.property.starts_with("Camera.") || edit.property.starts_with("Light.");
  };
  Diagnostics unsaid;  // nothing of it is written but what was edited
  return std::any_of(edits.begin(), edits.end(), is_seen)
             ? describe::describe_visuals(stage, scene, unsaid)
             : robot::RobotModel();
}

/// The text with what the asset says otherwise in it; nothing, and a finding, where that cannot be.
std::optional<std::string> with_edits(const std::string& text,
                                      const std::vector<std::string>& changed,
                                      const convert::SealParts& now, const stage::Stage& stage,
                                      const scene::PhysicsScene& scene, Diagnostics& diagnostics) {
  const auto parts = stage.default_prim()
                         .attribute(convert::kSourceParts)
                         .get_as<layer::Array<std::string>>()
                         .value_or(layer::Array<std::string>());
  const TextEdits edits = edits_of(changed, {parts.begin(), parts.end()}, now);
  if (!edits.others.empty() || edits.single.empty()) {
    report_written_anew(diagnostics, "the asset says something else than its source of " +
                                         named_few(edits.others.empty() ? changed : edits.others));
    return std::nullopt;
  }
  const auto patched = patch_model(
      text, edits.single, scene, physics::read_mujoco_parts(stage, scene),
      seen_of(edits.single, stage, scene), [&stage](Path prim) { return name_on(stage, prim); });
  if (!patched || !patched->left.empty()) {
    std::vector<std::string> why;
    for (const UnpatchedEdit& left : patched ? patched->left : std::vector<UnpatchedEdit>()) {
      why.push_back("</" + left.edit.prim.str().substr(1) + ">." + left.edit.property + " (" +
                    left.why + ")");
    }
    report_written_anew(diagnostics, "the model has no place for an edit of " +
                                         (patched ? named_few(why) : patched.error().message()));
    return std::nullopt;
  }
  std::vector<std::string> said;
  for (const PropertyEdit& edit : edits.single) {
    said.push_back(edit.prim.name().str() + "." + edit.property);
  }
  diagnostics.add(file_finding(Severity::Info, "mjcf.patched",
                               "the model that the asset was made from is kept, with the edits "
                               "since: " +
                                   named_few(said),
                               "", 0));
  return patched->text;
}

/// Puts the files of a source in folders beside its text.
class FilePlacer {
 public:
  FilePlacer(const stage::Prim& robot, const std::string& stem, const bytes::ReadPolicy& policy)
      : robot_(robot), stem_(stem), policy_(policy) {}

  /// The place of a file by its number; empty where it cannot be read.
  std::string place(const std::string& number) {
    const auto [at, is_new] = places_.try_emplace(number);
    if (is_new) {
      at->second = read(number);
    }
    return at->second;
  }
  std::map<std::string, std::string> take() { return std::move(files_); }
  const std::string& missing() const { return missing_; }

 private:
  std::string read(const std::string& number) {
    const auto file =
        robot_.attribute(Token(convert::kSourceFile + number)).get_as<layer::AssetPath>();
    const std::string& path = file ? file->resolved : number;
    const auto contents = policy_.open(path);
    const bytes::FileKind kind =
        contents ? bytes::kind_of((*contents)->text()) : bytes::FileKind::Unknown;
    if (kind != bytes::FileKind::Shape && kind != bytes::FileKind::Image) {
      missing_ = file ? file->authored : number;
      return {};
    }
    const std::string_view text = (*contents)->text();
    const bool shape = kind == bytes::FileKind::Shape;
    const std::string inner = bytes::split_package_path(path).inner;
    const std::filesystem::path name =
        std::filesystem::path(inner.empty() ? path : inner).filename();
    std::string place = stem_ + (shape ? "_meshes/" : "_images/");
    const std::string folder = place;
    place += name.string();
    for (int i = 2; files_.contains(place); ++i) {
      place = folder + name.stem().string() + "_" + std::to_string(i) + name.extension().string();
    }
    files_.emplace(place, std::string(text));
    return place;
  }

  const stage::Prim& robot_;
  std::string stem_;
  const bytes::ReadPolicy& policy_;
  std::map<std::string, std::string> places_;  // by number
  std::map<std::string, std::string> files_;
  std::string missing_;
};

/// The text with the places of its files where their numbers stand.
std::string with_files(std::string_view text, FilePlacer& files) {
  const std::string mark = {'"', robot::MujocoSource::kFileMark};
  std::string out;
  std::size_t at = 0;
  for (std::size_t found = text.find(mark); found != std::string_view::npos;
       found = text.find(mark, at)) {
    const std::size_t end = std::min(text.find('"', found + mark.size()), text.size());
    const std::string number(text.substr(found + mark.size(), end - found - mark.size()));
    const bool is_number =
        !number.empty() && number.find_first_not_of("0123456789") == std::string::npos;
    out += text.substr(at, found + 1 - at);
    out += is_number ? files.place(number) : mark.substr(1) + number;
    at = end;
  }
  return out + std::string(text.substr(at));
}

}  // namespace

std::optional<ExportedMjcf> kept_mjcf(const stage::Stage& stage, const scene::PhysicsScene& scene,
                                      const std::string& stem, const bytes::ReadPolicy& policy,
                                      Diagnostics& diagnostics) {
  const stage::Prim robot = stage.default_prim();
  if (!robot) {
    return std::nullopt;
  }
  const auto text = robot.attribute(convert::kSourceText).get_as<std::string>();
  const auto seal = robot.attribute(convert::kSourceSeal).get_as<layer::Array<std::string>>();
  if (!text || !seal) {
    return std::nullopt;
  }
  convert::SealParts parts;
  std::vector<std::string> changed =
      convert::changed_since({seal->begin(), seal->end()}, seal_of_stage(stage, parts));
  leave_out_physx(changed, diagnostics);
  std::string edited = *text;
  if (!changed.empty()) {
    const auto patched = with_edits(*text, changed, parts, stage, scene, diagnostics);
    if (!patched) {
      return std::nullopt;
    }
    edited = *patched;
  }
  FilePlacer files(robot, stem, policy);
  ExportedMjcf result;
  result.text = with_files(edited, files);
  if (!files.missing().empty()) {
    report_written_anew(diagnostics, "the file @" + files.missing() +
                                         "@ cannot be read, or is neither a shape nor an image");
    return std::nullopt;
  }
  result.images = files.take();
  return result;
}

}  // namespace tenon
