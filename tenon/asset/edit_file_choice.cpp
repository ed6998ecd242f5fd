// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The questions come in this order: which file was named, which belongs to the engine that was
// named, which owns the property by the table of structure/layout.h, and in assets without that
// structure which has the strongest opinion, else the root layer. A file for all engines that has
// an opinion already and may hold the property goes before the owner, so that there are not two
// opinions. Inside of instances only what they share is composed, and the file of the instances is
// the owner.
#include "tenon/asset/edit_file_choice.h"

#include <algorithm>
#include <filesystem>

#include "tenon/asset/editing/whole_prim_edits.h"
#include "tenon/base/text/comma_list.h"
#include "tenon/bytes/asset_resolver.h"
#include "tenon/edit/apply_list_edit.h"
#include "tenon/layer/field_values.h"
#include "tenon/layer/fields.h"
#include "tenon/stage/sources/opinion_sources.h"

namespace tenon {
namespace {

namespace fields = layer::fields;
using structure::Role;

/// The field of prims that an edit is about.
Token metadata_of(const AssetEdit& edit) {
  switch (edit.kind) {
    case AssetEdit::Kind::AddVariant:
      return fields::variantSetNames;
    case AssetEdit::Kind::SelectVariant:
      return fields::variantSelection;
    case AssetEdit::Kind::OrderChildren:
      return fields::primOrder;
    case AssetEdit::Kind::OrderProperties:
      return fields::propertyOrder;
    case AssetEdit::Kind::AddArc:
    case AssetEdit::Kind::RemoveArc:
      return fields::references;
    default:
      return edit.field;
  }
}

std::string subject(const AssetEdit& edit) {
  if (edit.kind == AssetEdit::Kind::AddVariant || edit.inside) {
    return "a variant";
  }
  if (edit.is_about_metadata()) {
    return edit.field.str();
  }
  if (edit.is_about_prim() && edit.kind != AssetEdit::Kind::DefinePrim) {
    return metadata_of(edit).str();
  }
  if (edit.is_about_prim()) {
    return "a prim of type " + edit.type_name.str();
  }
  return edit.is_about_api() ? edit.api.str() : edit.object.name().str();
}

Error no_file(const FileQuestion& q, const std::string& message, const std::string& fix) {
  return Error(ErrorCode::NotFound, message)
      .with_prim(q.prim.path().str())
      .with_rule("edit.no-file")
      .with_fix(fix);
}

/// By its path or the end of it.
Result<FileChoice> named_file(const FileQuestion& q, const std::string& name) {
  const std::string absolute = bytes::absolute_file_path(name);
  std::vector<std::string> found;
  for (const std::string& layer : q.layers) {
    if (layer == absolute) {
      return FileChoice{layer, "you asked for it"};
    }
    if (layer.ends_with("/" + name)) {
      found.push_back(layer);
    }
  }
  if (found.size() == 1) {
    return FileChoice{found.front(), "you asked for it"};
  }
  return no_file(
      q, (found.empty() ? "no layer of the asset is called " : "several layers are called ") + name,
      "choose one of: " + comma_list(q.layers, file_part));
}

/// Layers with an opinion, strongest first.
std::vector<std::string> speaking(const FileQuestion& q) {
  const Token property = q.edit.object.is_property() ? q.edit.object.name() : Token();
  std::vector<std::string> layers;
  for (const auto& source : stage::opinion_sources(q.stage, q.prim.path(), property)) {
    if (speaks(source, q.edit)) {
      layers.push_back(source.layer->identifier());
    }
  }
  return layers;
}

Result<FileChoice> strongest_file(const FileQuestion& q) {
  for (const std::string& layer : speaking(q)) {
    if (!bytes::is_in_package(layer)) {
      return FileChoice{layer, "it has the strongest opinion"};
    }
    break;
  }
  if (q.prim.is_instance_proxy()) {
    for (const auto& source : stage::opinion_sources(q.stage, q.prim.path())) {
      if (!bytes::is_in_package(source.layer->identifier())) {
        return FileChoice{source.layer->identifier(), "instances share it"};
      }
    }
    return no_file(q, "the prim is inside an instance whose content is in a package",
                   "unpack it: tenon zip PACKAGE --extract FOLDER");
  }
  return FileChoice{q.stage.root_layer().identifier(),
                    "it is the root layer, and no other layer has an opinion"};
}

std::vector<std::string> files_with(const FileQuestion& q, Role role) {
  std::vector<std::string> files;
  for (const auto& [file, has] : q.roles) {
    if (has == role) {
      files.push_back(file);
    }
  }
  return files;
}

structure::Ownership ownership(const FileQuestion& q) {
  const bool defines = q.edit.kind == AssetEdit::Kind::DefinePrim;
  if (q.edit.is_about_prim() && !defines) {
    return structure::owner_of_metadata(metadata_of(q.edit));
  }
  if (defines) {
    // The scope goes where the poses go.
    const bool is_scope =
        q.edit.type_name == "Scope" && q.edit.object.name().view() == structure::kNamedPosesScope;
    return structure::owner_of_type(is_scope ? Token(structure::kNamedPoseType) : q.edit.type_name);
  }
  return q.edit.is_about_api()
             ? structure::owner_of_api(q.edit.api)
             : structure::owner_of_property(q.edit.object.name(), q.prim.type_name(),
                                            q.prim.authored_api_schemas());
}

Result<FileChoice> engine_file(const FileQuestion& q) {
  const std::string& engine = q.edit.engine.empty() ? q.options.engine : q.edit.engine;
  if (q.roles.empty()) {
    return no_file(q, "the asset has no files for single engines", "name the file with --in");
  }
  if (q.prim.is_instance_proxy()) {
    return Error(ErrorCode::Invalid, "<" + q.prim.path().str() +
                                         "> is inside an instance: what an engine's file says "
                                         "about it is not composed")
        .with_prim(q.prim.path().str())
        .with_rule("edit.instance-proxy")
        .with_fix("leave --engine out: the file of the instances holds it for all engines");
  }
  const Role role = structure::role_of_physics_variant(engine);
  const structure::Ownership owner = ownership(q);
  if (!owner.may_be_in(role)) {
    return Error(ErrorCode::Invalid, subject(q.edit) + " is nothing that " + engine + " reads")
        .with_prim(q.prim.path().str())
        .with_rule("edit.wrong-engine")
        .with_fix("leave --engine out");
  }
  for (const std::string& file : files_with(q, role)) {
    const std::string name = file_part(file);
    if (role != Role::Engine || name.substr(0, name.rfind('.')) == engine) {
      return FileChoice{file, "it is for " + engine + " only"};
    }
  }
  return no_file(q, "the asset has no file for " + engine,
                 "its variants of \"Physics\" are those that tenon variant lists");
}

std::string file_name(const std::string& file) {
  return std::filesystem::path(file).filename().string();
}

std::string owns(const std::string& file, const AssetEdit& edit) {
  return "written to " + file_name(file) + ", which owns " + subject(edit);
}

/// The first of the owners, or else of the files that may hold it, that has a place for the path.
Result<FileChoice> file_of_prim(const FileQuestion& q, const structure::Ownership& owner) {
  std::vector<Role> roles{owner.owner};
  for (const Role role : {Role::Base, Role::Physics}) {
    if (owner.also.contains(role)) {
      roles.push_back(role);
    }
  }
  for (const Role role : roles) {
    for (const std::string& file : files_with(q, role)) {
      if (site_for(q.stage, q.edit, file)) {
        return FileChoice{file, owns(file, q.edit)};
      }
    }
  }
  std::string advice = "name the file with --in";
  for (const std::string& file : files_with(q, Role::Base)) {
    advice += site_for(q.stage, q.edit, file) ? ": " + file_name(file) : "";
  }
  return no_file(
      q, "<" + q.edit.object.str() + "> is in none of the files that hold " + subject(q.edit),
      advice);
}

Result<FileChoice> owning_file(const FileQuestion& q) {
  const structure::Ownership owner = ownership(q);
  const Role role = structure::file_for(owner.owner, q.prim.is_instance_proxy());
  // A neighbour of the owner that speaks already, such as the base for the shapes in it.
  for (const std::string& layer : speaking(q)) {
    const auto at = q.roles.find(layer);
    const bool for_all =
        at != q.roles.end() && !structure::is_engine(at->second) && at->second != Role::Variant;
    if (for_all && owner.may_be_in(at->second)) {
      return FileChoice{layer, file_name(layer) + " already sets " + subject(q.edit)};
    }
  }
  if (q.edit.is_about_prim()) {
    return file_of_prim(q, owner);
  }
  for (const std::string& file : files_with(q, role)) {
    const std::string why = owns(file, q.edit);
    return FileChoice{file,
                      q.prim.is_instance_proxy() ? why + ": the prim is in an instance" : why};
  }
  return no_file(q,
                 "the asset has no file for " + std::string(structure::role_name(role)) +
                     ", which owns " + subject(q.edit),
                 "name the file with --in");
}

/// The strongest file that has the variant; of a new one that which has its set, or holds variants.
Result<FileChoice> file_of_variant(const FileQuestion& q, const VariantPlace& place) {
  for (const std::string& variant : {place.variant, std::string()}) {
    for (const auto& source : stage::opinion_sources(q.stage, place.prim)) {
      const Path at = source.path.variant_selection(Token(place.set), Token(variant));
      if (source.arcs.empty() && source.layer->has(at)) {
        return FileChoice{source.layer->identifier(), "it has the variant"};
      }
    }
  }
  for (const std::string& file : files_with(q, Role::Interface)) {
    return FileChoice{file, owns(file, q.edit)};
  }
  return FileChoice{q.stage.root_layer().identifier(), "it is the root layer"};
}

}  // namespace

bool speaks(const stage::OpinionSource& source, const AssetEdit& edit) {
  if (edit.is_about_prim() || edit.is_about_metadata()) {
    return says(*source.layer, *source.spec, edit);
  }
  if (edit.kind == AssetEdit::Kind::Connect) {
    return source.spec->has(fields::connectionPaths);
  }
  if (!edit.is_about_api()) {
    return source.spec->has(fields::default_value) || source.spec->has(fields::timeSamples) ||
           source.spec->has(fields::targetPaths) || source.spec->has(fields::spline);
  }
  const auto* op = source.spec->get<layer::ListOp<Token>>(fields::apiSchemas);
  if (op == nullptr) {
    return false;
  }
  return edit.kind == AssetEdit::Kind::ApplyApi || edit::adds(*op, edit.api);
}

stage::Prim prim_for(const stage::Stage& stage, const AssetEdit& edit) {
  if (edit.kind != AssetEdit::Kind::DefinePrim) {
    return stage.prim(edit.object.prim());
  }
  const Path above = edit.object.parent();
  return above.is_absolute_root() ? stage.pseudo_root() : stage.prim(above);
}

std::optional<stage::LayerSite> site_for(const stage::Stage& stage, const AssetEdit& edit,
                                         const std::string& layer) {
  if (edit.inside) {
    return stage::site_in_layer(stage, edit.inside->prim, layer);
  }
  if (edit.kind != AssetEdit::Kind::DefinePrim) {
    return stage::site_in_layer(stage, edit.object.prim(), layer);
  }
  auto site = stage::site_in_layer(stage, edit.object.parent(), layer);
  if (site) {
    site->path = site->path.child(edit.object.name());
  }
  return site;
}

std::string file_part(const std::string& path) { return path.substr(path.rfind('/') + 1); }

Result<FileChoice> choose_file(const FileQuestion& question) {
  if (const std::string& name = question.edit.layer; !name.empty()) {
    const auto& layers = question.layers;
    const bool is_identifier =
        name.front() == '/' || std::find(layers.begin(), layers.end(), name) != layers.end();
    return is_identifier ? FileChoice{name, "it says so"} : named_file(question, name);
  }
  if (!question.options.layer.empty()) {
    return named_file(question, question.options.layer);
  }
  if (!question.options.engine.empty() || !question.edit.engine.empty()) {
    return engine_file(question);
  }
  if (question.edit.inside) {
    return file_of_variant(question, *question.edit.inside);
  }
  return question.roles.empty() ? strongest_file(question) : owning_file(question);
}

}  // namespace tenon
