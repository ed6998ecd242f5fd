// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What Python changes in stages and prims: each call becomes an AssetEdit, which goes to the file
// that owns what it is about. Inside of `with stage.edits():` they wait, and are made together when
// the block ends or something is read. What no edit is refused for, and is wrong all the same (a
// relationship that leads nowhere), is a warning of Python and a finding of the stage.
#include "bind_edits.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "guarded_write.h"
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "tenon/asset/editing/stage_metadata.h"
#include "tenon/base/text/nearest_name.h"
#include "tenon/bytes/files.h"
#include "tenon/schema/registry.h"

namespace tenon::python {
namespace {

using namespace nb::literals;
using Kind = AssetEdit::Kind;

nb::list rows_of(const std::vector<EditedPlace>& places) {
  nb::list rows;
  for (const EditedPlace& place : places) {
    nb::dict row;
    row["file"] = text(place.file);
    row["spec"] = text(place.spec.str());
    row["why"] = message(place.why);
    row["before"] = text(place.before);
    row["after"] = text(place.after);
    row["variants"] = words_of(place.variants);
    rows.append(row);
  }
  return rows;
}

// ---- targets

/// The path of a prim that is most like one that is not there; empty where none is.
std::string nearest_prim(const stage::Stage& stage, Path wanted) {
  constexpr std::size_t kMostPrims = 20000;  // the search takes long
  std::vector<std::string> paths;
  std::vector<stage::Prim> open{stage.pseudo_root()};
  while (!open.empty() && paths.size() < kMostPrims) {
    const stage::Prim prim = open.back();
    open.pop_back();
    paths.push_back(prim.path().str());
    const std::vector<stage::Prim> children = prim.children();
    open.insert(open.end(), children.begin(), children.end());
  }
  const std::vector<std::string_view> names(paths.begin(), paths.end());
  return std::string(nearest_name(wanted.str(), names));
}

/// What a relationship names and the stage does not have.
Diagnostics lost_targets(const stage::Stage& stage, Path property) {
  Diagnostics found;
  const stage::Prim prim = stage.prim(property.prim());
  if (!prim || !prim.is_relationship(property.name())) {
    return found;
  }
  for (const Path& target : prim.relationship(property.name()).targets()) {
    if (!stage.prim(target.prim())) {
      const std::string nearest = nearest_prim(stage, target.prim());
      found.add(
          {Severity::Warning, "edit.no-target",
           "the relationship names " + named(target, RelatedRole::Target) + ", which is not there",
           prim.path().str(), property.name().str(),
           nearest.empty() ? "define the prim, or name another one"
                           : "did you mean " + nearest + "?"});
    }
  }
  return found;
}

void tell_lost_targets(OpenedStage& stage, const std::vector<Path>& properties) {
  if (properties.empty()) {
    return;
  }
  const auto access = stage.access();
  for (const Path& property : properties) {
    for (const Diagnostic& finding : lost_targets(*access, property)) {
      stage.tell(finding);
      if (PyErr_WarnEx(PyExc_UserWarning, finding.to_string().c_str(), 1) != 0) {
        throw nb::python_error();
      }
    }
  }
}

// ---- edits

/// `with stage.edits() as edits:`
struct EditsBlock {
  StagePtr stage;
  std::vector<EditedPlace> places;
};

void begin(EditsBlock& block) {
  const auto access = block.stage->access_without_waiting();
  block.stage->begin_edits();
}

bool end(EditsBlock& block, const nb::object& kind) {
  OpenedStage& stage = *block.stage;
  std::vector<Path> properties;
  {
    const auto access = stage.access_without_waiting();
    if (!kind.is_none()) {
      or_raise(unlocked([&] { return stage.drop_edits(); }));
      return false;
    }
    Diagnostics found;
    block.places = or_raise(unlocked([&] { return stage.end_edits(found); }), found);
    properties = stage.in_edits() ? std::vector<Path>() : stage.to_look_at();
  }
  tell_lost_targets(stage, properties);
  return false;
}

/// No step of the history, and no file, is of half a block.
void check_in_no_edits(const OpenedStage& stage, const char* what) {
  if (stage.in_edits()) {
    raise(Error(ErrorCode::Invalid, std::string(what) + " is not for the inside of edits()")
              .with_rule("edit.open-edits")
              .with_fix("call it behind the block"));
  }
}

bool is_relationship(const PrimOf& prim, const std::string& name) {
  {
    // Values alone turn no attribute into a relationship: the edits that wait may wait on.
    const auto access = prim.stage->access_without_waiting();
    const std::vector<AssetEdit>& waiting = prim.stage->waiting();
    const bool only_values = std::all_of(waiting.begin(), waiting.end(), [](const AssetEdit& edit) {
      return (edit.kind == Kind::SetProperty || edit.kind == Kind::ClearProperty) &&
             edit.type_name.empty();
    });
    const stage::Prim found = access->prim(prim.path);
    if (only_values && found) {
      return found.is_relationship(name);
    }
  }
  return with_prim(prim, [&](const stage::Prim& found) { return found.is_relationship(name); });
}

nb::list set_value(const PrimOf& prim, const std::string& name, const nb::object& value,
                   std::optional<double> time, const std::string& engine, const std::string& layer,
                   const std::string& type_name) {
  const bool targets = is_relationship(prim, name);
  AssetEdit edit;
  edit.kind = Kind::SetProperty;
  edit.object = prim.path.property(name);
  edit.value = as_text(targets ? "as_targets" : "as_text", value);
  edit.time = time;
  edit.engine = engine;
  edit.layer = layer;
  if (!type_name.empty()) {
    edit.type_name = type_name;
  }
  return edited(*prim.stage, {edit}, targets);
}

nb::list edit_targets(const PrimOf& prim, const std::string& name, const nb::object& paths,
                      Kind kind, const std::string& engine, const std::string& layer) {
  AssetEdit edit;
  edit.kind = kind;
  edit.object = prim.path.property(name);
  edit.value = as_text("as_targets", paths);
  edit.engine = engine;
  edit.layer = layer;
  return edited(*prim.stage, {edit}, kind == Kind::AddTargets);
}

nb::list edit_api(const PrimOf& prim, const std::string& schema, Kind kind,
                  const std::string& engine, const std::string& layer) {
  AssetEdit edit;
  edit.kind = kind;
  edit.object = prim.path;
  edit.api = schema;
  edit.engine = engine;
  edit.layer = layer;
  return edited(*prim.stage, {edit});
}

nb::list edit_variant(const PrimOf& prim, const std::string& set, const std::string& variant,
                      Kind kind, const std::string& layer) {
  AssetEdit edit;
  edit.kind = kind;
  edit.object = prim.path;
  edit.value = set + "=" + variant;
  edit.layer = layer;
  return edited(*prim.stage, {edit});
}

/// A file, or (FILE, PRIM): what a new prim brings in.
std::optional<AssetArc> arc_of(const nb::object& reference, const nb::object& payload) {
  if (reference.is_none() && payload.is_none()) {
    return std::nullopt;
  }
  if (!reference.is_none() && !payload.is_none()) {
    throw nb::value_error("a prim is defined with a reference or a payload, not with both");
  }
  AssetArc arc;
  arc.kind = reference.is_none() ? AssetArc::Kind::Payload : AssetArc::Kind::Reference;
  nb::object file = reference.is_none() ? payload : reference;
  if (nb::isinstance<nb::tuple>(file)) {
    const auto parts = nb::cast<nb::tuple>(file);
    if (parts.size() != 2) {
      throw nb::value_error("what a prim brings in is a file, or a file and the path of a prim");
    }
    arc.prim = path_of(nb::cast<std::string>(parts[1]));
    file = nb::borrow(parts[0]);
  }
  arc.file = bytes::absolute_file_path(nb::cast<std::filesystem::path>(file).string());
  return arc;
}

PrimOf define_prim(const StagePtr& stage, const std::string& path,
                   const std::optional<std::string>& type, const nb::object& reference,
                   const nb::object& payload, bool any_type, const std::string& engine,
                   const std::string& layer) {
  AssetEdit edit;
  edit.kind = Kind::DefinePrim;
  edit.object = path_of(path);
  edit.arc = arc_of(reference, payload);
  const std::string type_name = type.value_or(edit.arc ? "" : "Xform");
  if (!any_type) {
    check_type(type_name, edit.object);
  }
  edit.type_name = type_name;
  edit.engine = engine;
  edit.layer = layer;
  edited(*stage, {edit});
  return {stage, edit.object};
}

void remove_prim(const PrimOf& prim) {
  AssetEdit edit;
  edit.kind = Kind::RemovePrim;
  edit.object = prim.path;
  edited(*prim.stage, {edit});
}

/// The prim under its new name; this one is gone.
PrimOf rename_prim(const PrimOf& prim, const std::string& name) {
  AssetEdit edit;
  edit.kind = Kind::RenamePrim;
  edit.object = prim.path;
  edit.value = name;
  edited(*prim.stage, {edit});
  return {prim.stage, prim.path.parent().child(name)};
}

nb::list rename_property(const PrimOf& prim, const std::string& name, const std::string& to) {
  AssetEdit edit;
  edit.kind = Kind::RenameProperty;
  edit.object = prim.path.property(name);
  edit.value = to;
  return edited(*prim.stage, {edit});
}

nb::list set_stage_metadata(OpenedStage& stage, const std::string& field, const nb::object& value) {
  if (field == "comment" || field == "documentation" || field == "customLayerData") {
    AssetEdit edit;
    edit.kind = Kind::SetStageMetadata;
    edit.object = Path::absolute_root();
    edit.field = Token(field);
    edit.value = as_text("as_metadata", value);
    return edited(stage, {edit});
  }
  const auto edits = or_raise(stage_metadata_edits({field + "=" + as_text("as_text", value)}));
  nb::list rows;
  for (const AssetEdit& edit : edits) {
    rows.extend(edited(stage, {edit}));
  }
  return rows;
}

nb::list saved(OpenedStage& stage, bool undoable) {
  check_in_no_edits(stage, "save()");
  const auto access = stage.access();
  const auto files = or_raise(unlocked([&] { return stage.save(undoable); }));
  nb::list names;
  for (const EditedFile& file : files) {
    names.append(text(file.path));
  }
  return names;
}

template <Result<bool> (OpenedStage::*Move)()>
bool moved(OpenedStage& stage, const char* what) {
  check_in_no_edits(stage, what);
  const auto access = stage.access();
  return or_raise(unlocked([&] { return (stage.*Move)(); }));
}

void bind_values(nb::class_<PrimOf>& prim) {
  prim.def(
      "set", &set_value, "name"_a, "value"_a.none(), nb::kw_only(), "time"_a = nb::none(),
      "engine"_a = "", "layer"_a = "", "type_name"_a = "",
      nb::sig("def set(self, name: str, value: object, *, time: float | None = None, "
              "engine: str = '', layer: str = '', type_name: str = '') "
              "-> list[dict[str, Any]]"),
      "Sets a property in the file that owns it, in memory until save(): a value in the units "
      "of the stage, with the types of get(); None blocks it; of a relationship a list of "
      "paths. `time` is that of a sample [time codes of the stage]; without it the value is "
      "the default one. `engine` (\"physx\", \"mujoco\") or `layer` name another file; `type_name` "
      "(\"double3\") makes an attribute that nobody knows. Returns where it went: a list of "
      "{\"file\", \"spec\", \"why\", \"before\", \"after\", \"variants\"}; inside of "
      "edits() an empty one. A target that is not there is a warning.");
  prim.def(
      "__setitem__",
      [](const PrimOf& self, const std::string& name, const nb::object& value) {
        set_value(self, name, value, std::nullopt, "", "", "");
      },
      "name"_a, "value"_a.none(), "The same, in the file that owns the property.");
  prim.def(
      "clear",
      [](const PrimOf& self, const std::string& name, std::optional<double> time,
         const std::string& layer) {
        AssetEdit edit;
        edit.kind = Kind::ClearProperty;
        edit.object = self.path.property(name);
        edit.time = time;
        edit.layer = layer;
        return edited(*self.stage, {edit});
      },
      "name"_a, nb::kw_only(), "time"_a = nb::none(), "layer"_a = "",
      nb::sig("def clear(self, name: str, *, time: float | None = None, layer: str = '') "
              "-> list[dict[str, Any]]"),
      "Takes the strongest opinion about a property away, or that of the file `layer`; with `time` "
      "one sample [time codes] of an attribute. Returns what set() returns.");
}

void bind_apis(nb::class_<PrimOf>& prim) {
  const auto bind = [&prim](const char* name, Kind kind, const char* about) {
    const std::string signature = std::string("def ") + name +
                                  "(self, schema: str, *, engine: str = '', layer: str = '') "
                                  "-> list[dict[str, Any]]";
    prim.def(
        name,
        [kind](const PrimOf& self, const std::string& schema, const std::string& engine,
               const std::string& layer) { return edit_api(self, schema, kind, engine, layer); },
        "schema"_a, nb::kw_only(), "engine"_a = "", "layer"_a = "", nb::sig(signature.c_str()),
        about);
  };
  bind("apply", Kind::ApplyApi,
       "Applies an API schema: \"PhysicsMassAPI\", \"PhysicsDriveAPI:angular\". Returns what set() "
       "returns.");
  bind("unapply", Kind::RemoveApi, "Takes an API schema away. Returns what set() returns.");
}

void bind_lists(nb::class_<PrimOf>& prim) {
  const auto bind = [&prim](const char* name, Kind kind, const char* about) {
    const std::string signature = std::string("def ") + name +
                                  "(self, name: str, paths: object, *, engine: str = '', "
                                  "layer: str = '') -> list[dict[str, Any]]";
    prim.def(
        name,
        [kind](const PrimOf& self, const std::string& property, const nb::object& paths,
               const std::string& engine, const std::string& layer) {
          return edit_targets(self, property, paths, kind, engine, layer);
        },
        "name"_a, "paths"_a, nb::kw_only(), "engine"_a = "", "layer"_a = "",
        nb::sig(signature.c_str()), about);
  };
  bind("add_targets", Kind::AddTargets,
       "Adds paths or prims to what a relationship has. Returns what set() returns.");
  bind("remove_targets", Kind::RemoveTargets,
       "Takes paths or prims out of a relationship. Returns what set() returns.");
  prim.def(
      "add_variant",
      [](const PrimOf& self, const std::string& set, const std::string& one,
         const std::string& layer) {
        return edit_variant(self, set, one, Kind::AddVariant, layer);
      },
      "set"_a, "variant"_a, nb::kw_only(), "layer"_a = "",
      nb::sig("def add_variant(self, set: str, variant: str, *, layer: str = '') "
              "-> list[dict[str, Any]]"),
      "Adds a variant, and its set where there is none. Returns what set() returns.");
  prim.def(
      "remove_variant",
      [](const PrimOf& self, const std::string& set, const std::string& one) {
        return edit_variant(self, set, one, Kind::RemoveVariant, "");
      },
      "set"_a, "variant"_a,
      nb::sig("def remove_variant(self, set: str, variant: str) -> list[dict[str, Any]]"),
      "Takes a variant away from all files of the asset; its set goes with the last one. Returns "
      "what set() returns.");
}

void bind_block(nb::module_& module) {
  nb::class_<EditsBlock> block(module, "Edits",
                               "Edits that are one step of the history, all or none: what "
                               "Stage.edits() gives, for a with statement.");
  block.def(
      "__enter__",
      [](nb::handle_t<EditsBlock> self) {
        begin(*nb::inst_ptr<EditsBlock>(self));
        return nb::borrow(self);
      },
      nb::sig("def __enter__(self) -> Edits"));
  block.def(
      "__exit__",
      [](EditsBlock& self, const nb::object& kind, const nb::object&, const nb::object&) {
        return end(self, kind);
      },
      "kind"_a.none(), "value"_a.none(), "traceback"_a.none(),
      nb::sig("def __exit__(self, kind: object, value: object, traceback: object) -> None"));
  block.def_prop_ro(
      "places", [](const EditsBlock& self) { return rows_of(self.places); },
      nb::sig("def places(self) -> list[dict[str, Any]]"),
      "Where the edits went, as set() returns it, when the block is over; of a block inside of "
      "another one none.");
}

}  // namespace

nb::list edited(OpenedStage& stage, const std::vector<AssetEdit>& edits, bool of_targets) {
  std::vector<EditedPlace> places;
  std::vector<Path> to_look_at;
  {
    const auto access = stage.access_without_waiting();
    Diagnostics found;
    places = or_raise(unlocked([&] { return stage.edit(edits, found); }), found);
    for (const AssetEdit& edit : edits) {
      if (of_targets && edit.object.is_property()) {
        stage.in_edits() ? stage.look_later(edit.object) : to_look_at.push_back(edit.object);
      }
    }
  }
  tell_lost_targets(stage, to_look_at);
  return rows_of(places);
}

std::string as_text(const char* function, const nb::object& value) {
  return nb::cast<std::string>(nb::module_::import_("tenon_usd.text").attr(function)(value));
}

void check_type(const std::string& type, Path prim) {
  const schema::Schema* known = schema::Registry::instance().find(type);
  if (type.empty() || (known != nullptr && known->kind == schema::SchemaKind::ConcreteTyped)) {
    return;
  }
  std::vector<std::string_view> names;
  for (const schema::Schema* one : schema::Registry::instance().schemas()) {
    if (one->kind == schema::SchemaKind::ConcreteTyped) {
      names.push_back(one->name.view());
    }
  }
  const std::string nearest(nearest_name(type, names));
  const bool api = known != nullptr && known->is_applied_api();
  raise(Error(ErrorCode::Invalid, known == nullptr ? "no type of prims is called \"" + type + "\""
                                  : api ? type + " is an API schema, which prims of a type have"
                                        : type + " is a type that other types are made of")
            .with_prim(prim.str())
            .with_rule("edit.unknown-type")
            .with_fix(api ? "define the prim, and apply() the schema to it"
                      : nearest.empty()
                          ? "any_type=True takes types that no schema declares"
                          : "did you mean " + nearest +
                                "? any_type=True takes types that no schema declares"));
}

void bind_prim_edits(nb::class_<PrimOf>& prim) {
  bind_values(prim);
  bind_apis(prim);
  bind_lists(prim);
  prim.def("remove", &remove_prim, "Takes the prim away from all files of the asset.");
  prim.def("rename", &rename_prim, "name"_a,
           "Gives the prim another name, also in all that names it in files of the asset. Returns "
           "the prim under that name; this one is gone.");
  prim.def("rename_property", &rename_property, "name"_a, "to"_a,
           nb::sig("def rename_property(self, name: str, to: str) -> list[dict[str, Any]]"),
           "Gives a property another name, also in all that names it. Returns what set() returns.");
  bind_prim_authoring(prim);
}

void bind_stage_edits(nb::module_& module, nb::class_<OpenedStage>& stage) {
  bind_block(module);
  bind_stage_authoring(module, stage);
  stage.def(
      "define", &define_prim, "path"_a, "type_name"_a = nb::none(), nb::kw_only(),
      "reference"_a = nb::none(), "payload"_a = nb::none(), "any_type"_a = false, "engine"_a = "",
      "layer"_a = "",
      nb::sig("def define(self, path: str, type_name: str | None = None, *, "
              "reference: str | os.PathLike[str] | tuple[str | os.PathLike[str], str] | "
              "None = None, payload: str | os.PathLike[str] | "
              "tuple[str | os.PathLike[str], str] | None = None, "
              "any_type: bool = False, engine: str = '', layer: str = '') -> Prim"),
      "Makes a prim of a type (Xform) below one that is there, in memory until save(). "
      "`reference` or `payload` is what it brings in: a file, or a file and the path of a prim "
      "in it; its type is that one's then. InvalidError for a type that no schema declares, "
      "unless `any_type`.");
  stage.def(
      "edits", [](const StagePtr& self) { return EditsBlock{self, {}}; },
      "For `with stage.edits():`: the edits of the block are one step of undo(), all or none, and "
      "are made together at its end, or when something is read before. What the block raises takes "
      "them back.");
  stage.def("set_metadata", &set_stage_metadata, "field"_a, "value"_a,
            nb::sig("def set_metadata(self, field: str, value: object) -> list[dict[str, Any]]"),
            "Sets metadata of the stage in its root layer: \"metersPerUnit\" [m], "
            "\"kilogramsPerUnit\" [kg], \"upAxis\", \"timeCodesPerSecond\", \"defaultPrim\" and "
            "others; the error of an unknown one lists them; \"comment\", \"documentation\" and "
            "\"customLayerData\" (a dict), too. Values of the asset keep their numbers. "
            "Returns what Prim.set() returns.");
  stage.def(
      "undo", [](OpenedStage& self) { return moved<&OpenedStage::undo>(self, "undo()"); },
      "Takes the last edit, or block of edits(), back; False where there is none since the last "
      "save(); tenon_usd.undo() is for what was saved.");
  stage.def(
      "redo", [](OpenedStage& self) { return moved<&OpenedStage::redo>(self, "redo()"); },
      "Does again what undo() took back; False where there is nothing.");
  stage.def("save", &saved, nb::kw_only(), "undoable"_a = false,
            nb::sig("def save(self, *, undoable: bool = False) -> list[str]"),
            "Writes the files that edits changed, all or none; their names. Comments and layout of "
            "text layers stay. `undoable` keeps what they were for tenon_usd.undo() and `tenon "
            "undo`. To save elsewhere, copy the folder of the asset and open the copy, or write "
            "one file with flatten().");
}

}  // namespace tenon::python
