// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What prims have beside properties and schemas, as edits of Python: arcs, variants, metadata,
// order. And the requests of the command, `tenon set`, `tenon add` and `tenon remove`, on a stage:
// they are read by the same functions as those of the command, from the stage as it is edited now.
#include <algorithm>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "bind_edits.h"
#include "guarded_write.h"
#include "values.h"
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "tenon/asset/authoring/add_edits.h"
#include "tenon/asset/authoring/remove_edits.h"
#include "tenon/asset/edit_request.h"
#include "tenon/bytes/files.h"
#include "tenon/layer/field_values.h"
#include "tenon/layer/fields.h"
#include "tenon/structure/layout.h"

namespace tenon::python {
namespace {

using namespace nb::literals;
using Kind = AssetEdit::Kind;
using Words = std::vector<std::string>;

AssetEdit edit_of(const PrimOf& prim, Kind kind, const std::string& layer) {
  AssetEdit edit;
  edit.kind = kind;
  edit.object = prim.path;
  edit.layer = layer;
  return edit;
}

// ---- arcs

struct ArcCalls {
  AssetArc::Kind kind;
  const char* noun;
  bool of_files;
};

AssetArc arc_to(const ArcCalls& calls, const std::optional<std::filesystem::path>& file,
                const std::optional<std::string>& prim) {
  if (!file && !prim) {
    throw nb::value_error("an arc leads to a file, to a prim, or to a prim of a file");
  }
  AssetArc arc;
  arc.kind = calls.kind;
  arc.file = file ? bytes::absolute_file_path(file->string()) : std::string();
  arc.prim = prim ? path_of(*prim) : Path();
  return arc;
}

nb::list edit_arc(const PrimOf& prim, Kind kind, AssetArc arc, const std::string& layer) {
  AssetEdit edit = edit_of(prim, kind, layer);
  edit.arc = std::move(arc);
  return edited(*prim.stage, {edit});
}

void bind_file_arc(nb::class_<PrimOf>& prim, const ArcCalls& calls) {
  using File = std::optional<std::filesystem::path>;
  using Inside = std::optional<std::string>;
  const std::string noun = calls.noun;
  const std::string file =
      "(self, file: str | os.PathLike[str] | None = None, "
      "prim: str | None = None, *, ";
  const std::string add = "def add_" + noun + file +
                          "offset: float = 0.0, scale: float = 1.0, first: bool = False, "
                          "layer: str = '') -> list[dict[str, Any]]";
  prim.def(
      ("add_" + noun).c_str(),
      [calls](const PrimOf& self, const File& file, const Inside& inside, double offset,
              double scale, bool first, const std::string& layer) {
        AssetArc arc = arc_to(calls, file, inside);
        arc.offset = {offset, scale};
        arc.first = first;
        return edit_arc(self, Kind::AddArc, std::move(arc), layer);
      },
      "file"_a = nb::none(), "prim"_a = nb::none(), nb::kw_only(), "offset"_a = 0.0,
      "scale"_a = 1.0, "first"_a = false, "layer"_a = "", nb::sig(add.c_str()),
      ("Adds a " + noun +
       " to a file's default prim, to another prim of it, or without a file to a prim of the "
       "stage, behind those that there are or `first`. A time t of the file is offset + scale * t "
       "of the stage [time codes]. NotFoundError where it leads nowhere. Returns what set() "
       "returns.")
          .c_str());
  const std::string remove =
      "def remove_" + noun + file + "layer: str = '') -> list[dict[str, Any]]";
  prim.def(
      ("remove_" + noun).c_str(),
      [calls](const PrimOf& self, const File& file, const Inside& inside,
              const std::string& layer) {
        return edit_arc(self, Kind::RemoveArc, arc_to(calls, file, inside), layer);
      },
      "file"_a = nb::none(), "prim"_a = nb::none(), nb::kw_only(), "layer"_a = "",
      nb::sig(remove.c_str()),
      ("Takes the " + noun +
       " away that leads there, whatever its offset, from the strongest file that has it. Returns "
       "what set() returns.")
          .c_str());
}

void bind_class_arc(nb::class_<PrimOf>& prim, const ArcCalls& calls) {
  const std::string noun = calls.noun;
  const std::string add = "def add_" + noun +
                          "(self, prim: str, *, first: bool = False, layer: str = '') "
                          "-> list[dict[str, Any]]";
  prim.def(
      ("add_" + noun).c_str(),
      [calls](const PrimOf& self, const std::string& to, bool first, const std::string& layer) {
        AssetArc arc = arc_to(calls, {}, to);
        arc.first = first;
        return edit_arc(self, Kind::AddArc, std::move(arc), layer);
      },
      "prim"_a, nb::kw_only(), "first"_a = false, "layer"_a = "", nb::sig(add.c_str()),
      ("Lets the prim " + noun +
       " another one of the stage, which may be made later. Returns what set() returns.")
          .c_str());
  const std::string remove =
      "def remove_" + noun + "(self, prim: str, *, layer: str = '') -> list[dict[str, Any]]";
  prim.def(("remove_" + noun).c_str(),
           [calls](const PrimOf& self, const std::string& to, const std::string& layer) {
             return edit_arc(self, Kind::RemoveArc, arc_to(calls, {}, to), layer);
           },
           "prim"_a, nb::kw_only(), "layer"_a = "", nb::sig(remove.c_str()),
           "Takes that back. Returns what set() returns.");
}

std::string file_of(const std::string& asset_path, const layer::Layer& layer) {
  return asset_path.empty() ? asset_path : structure::target_of(asset_path, layer);
}

void add_row(nb::list& rows, const char* kind, const std::string& layer, const std::string& file,
             Path prim, const layer::LayerOffset& offset) {
  nb::dict row;
  row["kind"] = kind;
  row["file"] = text(file);
  row["prim"] = text(prim.str());
  row["offset"] = offset.offset;
  row["scale"] = offset.scale;
  row["layer"] = text(layer);
  rows.append(row);
}

template <class Item, class Add>
void for_items(const layer::Spec& spec, Token field, const Add& add) {
  if (const auto* op = spec.get<layer::ListOp<Item>>(field)) {
    std::vector<Item> items;
    op->apply_to(items);
    for (const Item& item : items) {
      add(item);
    }
  }
}

/// What each layer says, strongest first.
nb::list arcs_of(const PrimOf& prim) {
  return with_prim(prim, [](const stage::Prim& found) {
    nb::list rows;
    for (const stage::SpecSite& site : found.spec_stack()) {
      const std::string& layer = site.layer->identifier();
      const auto of_files = [&](const char* kind) {
        return [&rows, &site, &layer, kind](const auto& item) {
          add_row(rows, kind, layer, file_of(item.asset_path, *site.layer), item.prim_path,
                  item.offset);
        };
      };
      const auto of_prims = [&](const char* kind) {
        return [&rows, &layer, kind](Path item) { add_row(rows, kind, layer, "", item, {}); };
      };
      for_items<layer::Reference>(*site.spec, layer::fields::references, of_files("reference"));
      for_items<layer::Payload>(*site.spec, layer::fields::payload, of_files("payload"));
      for_items<Path>(*site.spec, layer::fields::inheritPaths, of_prims("inherit"));
      for_items<Path>(*site.spec, layer::fields::specializes, of_prims("specialize"));
    }
    return rows;
  });
}

void bind_arcs(nb::class_<PrimOf>& prim) {
  for (const ArcCalls& calls : {ArcCalls{AssetArc::Kind::Reference, "reference", true},
                                ArcCalls{AssetArc::Kind::Payload, "payload", true},
                                ArcCalls{AssetArc::Kind::Inherit, "inherit", false},
                                ArcCalls{AssetArc::Kind::Specialize, "specialize", false}}) {
    calls.of_files ? bind_file_arc(prim, calls) : bind_class_arc(prim, calls);
  }
  prim.def_prop_ro(
      "arcs", &arcs_of, nb::sig("def arcs(self) -> list[dict[str, Any]]"),
      "What layers bring into the prim, strongest first: {\"kind\", \"file\" (empty: the stage "
      "itself), \"prim\" (empty: the default prim), \"offset\" [time codes], \"scale\", "
      "\"layer\"}; kinds are reference, payload, inherit and specialize.");
}

// ---- metadata, variants, order

nb::list edit_metadata(const PrimOf& prim, Kind kind, const std::string& field,
                       const nb::object& value, const std::string& property, const std::string& key,
                       const std::string& layer) {
  AssetEdit edit = edit_of(prim, kind, layer);
  edit.object = property.empty() ? prim.path : prim.path.property(property);
  edit.field = Token(field);
  edit.key = key;
  if (kind == Kind::SetMetadata) {
    edit.value = as_text(key.empty() ? "as_metadata" : "as_entry", value);
  }
  return edited(*prim.stage, {edit});
}

void bind_metadata(nb::class_<PrimOf>& prim) {
  prim.def(
      "set_metadata",
      [](const PrimOf& self, const std::string& field, const nb::object& value,
         const std::string& property, const std::string& key, const std::string& layer) {
        return edit_metadata(self, Kind::SetMetadata, field, value, property, key, layer);
      },
      "field"_a, "value"_a, nb::kw_only(), "property"_a = "", "key"_a = "", "layer"_a = "",
      nb::sig("def set_metadata(self, field: str, value: object, *, property: str = '', "
              "key: str = '', layer: str = '') -> list[dict[str, Any]]"),
      "Sets metadata of the prim, or of one of its properties: \"kind\", \"documentation\", "
      "\"active\", \"instanceable\", \"hidden\", \"displayName\", \"assetInfo\", \"customData\" "
      "and others, in the file that says it already, else in the one that owns it, or in `layer`. "
      "Dictionaries are dicts, and `key` (\"a:b\") is one entry of one. InvalidError for a field "
      "that there is not. Returns what set() returns.");
  prim.def(
      "clear_metadata",
      [](const PrimOf& self, const std::string& field, const std::string& property,
         const std::string& key, const std::string& layer) {
        return edit_metadata(self, Kind::ClearMetadata, field, nb::none(), property, key, layer);
      },
      "field"_a, nb::kw_only(), "property"_a = "", "key"_a = "", "layer"_a = "",
      nb::sig("def clear_metadata(self, field: str, *, property: str = '', key: str = '', "
              "layer: str = '') -> list[dict[str, Any]]"),
      "Takes away what the strongest file, or `layer`, says of it. Returns what set() returns.");
  prim.def(
      "set_type",
      [](const PrimOf& self, const std::string& type, bool any_type, const std::string& layer) {
        if (!any_type) {
          check_type(type, self.path);
        }
        AssetEdit edit = edit_of(self, Kind::SetMetadata, layer);
        edit.field = layer::fields::typeName;
        edit.value = type;
        return edited(*self.stage, {edit});
      },
      "type_name"_a, nb::kw_only(), "any_type"_a = false, "layer"_a = "",
      nb::sig("def set_type(self, type_name: str, *, any_type: bool = False, layer: str = '') "
              "-> list[dict[str, Any]]"),
      "Makes it a prim of another type (\"\": of none). InvalidError for a type that no schema "
      "declares, unless `any_type`. Returns what set() returns.");
}

nb::list select_variant(const PrimOf& prim, const std::string& set,
                        const std::optional<std::string>& variant, const std::string& layer) {
  AssetEdit edit = edit_of(prim, Kind::SelectVariant, layer);
  edit.value = variant ? set + "=" + *variant : set;
  return edited(*prim.stage, {edit});
}

nb::list put_in_order(const PrimOf& prim, Kind kind, const Words& names, const std::string& layer) {
  AssetEdit edit = edit_of(prim, kind, layer);
  for (const std::string& name : names) {
    edit.names.emplace_back(name);
  }
  return edited(*prim.stage, {edit});
}

nb::list connect(const PrimOf& prim, const std::string& name, const nb::object& sources,
                 const std::string& layer) {
  AssetEdit edit = edit_of(prim, Kind::Connect, layer);
  edit.object = prim.path.property(name);
  const nb::object paths = nb::module_::import_("tenon_usd.text").attr("paths")(sources);
  for (const std::string& path : nb::cast<Words>(paths)) {
    edit.targets.push_back(path_of(path));
  }
  return edited(*prim.stage, {edit});
}

void bind_choices(nb::class_<PrimOf>& prim) {
  prim.def("select_variant", &select_variant, "set"_a, "variant"_a.none(), nb::kw_only(),
           "layer"_a = "",
           nb::sig("def select_variant(self, set: str, variant: str | None, *, layer: str = '') "
                   "-> list[dict[str, Any]]"),
           "Selects a variant in the file; None takes the selection away, \"\" selects none, "
           "whatever weaker files select. Returns what set() returns.");
  const auto order = [&prim](const char* name, Kind kind, const char* signature,
                             const char* about) {
    prim.def(
        name,
        [kind](const PrimOf& self, const Words& names, const std::string& layer) {
          return put_in_order(self, kind, names, layer);
        },
        "names"_a, nb::kw_only(), "layer"_a = "", nb::sig(signature), about);
  };
  order("reorder", Kind::OrderChildren,
        "def reorder(self, names: Sequence[str], *, layer: str = '') -> list[dict[str, Any]]",
        "Puts children in this order; others follow those that they stood behind. Returns what "
        "set() returns.");
  order("reorder_properties", Kind::OrderProperties,
        "def reorder_properties(self, names: Sequence[str], *, layer: str = '') "
        "-> list[dict[str, Any]]",
        "The same of properties. Returns what set() returns.");
  prim.def("connect", &connect, "name"_a, "sources"_a.none(), nb::kw_only(), "layer"_a = "",
           nb::sig("def connect(self, name: str, sources: object, *, layer: str = '') "
                   "-> list[dict[str, Any]]"),
           "Connects an attribute to others, by their paths: one or a list; None takes all away. "
           "Returns what set() returns.");
}

/// `with stage.in_variant(PRIM, SET, VARIANT):`
struct VariantBlock {
  StagePtr stage;
  VariantPlace place;
};

bool has_variant(OpenedStage& stage, const VariantPlace& place) {
  const auto access = stage.access();
  const stage::Prim prim = access->prim(place.prim);
  const Words names = prim ? prim.variant_names(place.set) : Words();
  return std::find(names.begin(), names.end(), place.variant) != names.end();
}

void begin(VariantBlock& block) {
  if (!has_variant(*block.stage, block.place)) {
    AssetEdit edit;
    edit.kind = Kind::AddVariant;
    edit.object = block.place.prim;
    edit.value = block.place.set + "=" + block.place.variant;
    edited(*block.stage, {edit});
  }
  const auto access = block.stage->access_without_waiting();
  block.stage->go_inside(block.place);
}

void bind_variant_block(nb::module_& module) {
  nb::class_<VariantBlock> block(module, "InVariant",
                                 "What Stage.in_variant() gives, for a with statement.");
  block.def("__enter__", [](VariantBlock& self) { begin(self); });
  block.def(
      "__exit__",
      [](VariantBlock& self, const nb::object&, const nb::object&, const nb::object&) {
        const auto access = self.stage->access_without_waiting();
        self.stage->come_out();
      },
      "kind"_a.none(), "value"_a.none(), "traceback"_a.none(),
      nb::sig("def __exit__(self, kind: object, value: object, traceback: object) -> None"));
}

// ---- requests of the command

/// How the asset, as it is edited now, is read and edited.
EditOptions options_of(OpenedStage& stage, const std::string& engine, const std::string& layer) {
  EditOptions options;
  options.open = or_raise(stage.options_as_edited());
  options.engine = engine;
  options.layer = layer;
  return options;
}

/// Edits that name no file of their own go where the call says.
nb::list edited_in(OpenedStage& stage, std::vector<AssetEdit> edits, const std::string& engine,
                   const std::string& layer) {
  for (AssetEdit& edit : edits) {
    const bool named = !edit.engine.empty() || !edit.layer.empty() || edit.is_about_specs();
    edit.engine = named ? edit.engine : engine;
    edit.layer = named ? edit.layer : layer;
  }
  return edited(stage, edits, true);
}

EditRequest request_of(const nb::dict& words) {
  const auto list = [&](const char* name) {
    return words.contains(name) ? nb::cast<Words>(words[name]) : Words();
  };
  EditRequest request;
  request.assignments = list("assignments");
  request.clear = list("clear");
  request.apply = list("apply");
  request.remove = list("remove");
  request.mass = list("mass");
  request.collider = list("collider");
  request.material = list("material");
  request.drive = list("drive");
  request.mimic = list("mimic");
  request.filter = list("filter");
  return request;
}

nb::list set_all(OpenedStage& stage, const nb::args& assignments, bool filter_overlaps,
                 bool all_engines, const std::string& type_name, const std::string& engine,
                 const std::string& layer, const nb::kwargs& words) {
  const nb::module_ texts = nb::module_::import_("tenon_usd.text");
  const nb::object lists = texts.attr("set_words")(assignments, words);
  EditRequest request = request_of(nb::cast<nb::dict>(lists));
  request.filter_overlaps = filter_overlaps;
  request.all_engines = all_engines;
  request.type = type_name;
  std::vector<AssetEdit> edits;
  {
    const auto access = stage.access();
    const EditOptions options = options_of(stage, engine, layer);
    edits = or_raise(unlocked([&] { return read_edits(stage.path(), request, options); }));
  }
  return edited_in(stage, std::move(edits), engine, layer);
}

/// "PATH=KIND,KIND" and the options, as the command has them.
AuthoringRequest authoring_of(const std::string& path, const nb::args& kinds,
                              const nb::kwargs& options) {
  const nb::module_ texts = nb::module_::import_("tenon_usd.text");
  const auto read = nb::cast<nb::tuple>(texts.attr("authoring_words")(path, kinds, options));
  AuthoringRequest request;
  request.what = nb::cast<Words>(read[0]);
  request.options = nb::cast<std::map<std::string, std::string>>(read[1]);
  request.properties = nb::cast<Words>(read[2]);
  return request;
}

/// Makes what a request adds; the edits that this took.
std::vector<AssetEdit> added(OpenedStage& stage, const AuthoringRequest& request,
                             const std::string& engine, const std::string& layer) {
  std::vector<AssetEdit> edits;
  {
    const auto access = stage.access();
    const EditOptions how = options_of(stage, engine, layer);
    const auto views = or_raise(unlocked([&] { return stage.views(); }));
    Diagnostics found;
    edits = or_raise(unlocked([&] { return add_edits(views, request, how, found); }), found);
  }
  edited_in(stage, edits, engine, layer);
  return edits;
}

PrimOf add(const StagePtr& stage, const std::string& path, const nb::args& kinds,
           const std::string& engine, const std::string& layer, const nb::kwargs& options) {
  added(*stage, authoring_of(path, kinds, options), engine, layer);
  return {stage, path_of(path)};
}

nb::list add_matching(const StagePtr& stage, const std::string& pattern, const nb::args& kinds,
                      const std::string& engine, const std::string& layer,
                      const nb::kwargs& options) {
  AuthoringRequest request = authoring_of(pattern, kinds, options);
  request.match = true;
  std::set<Path> prims;
  for (const AssetEdit& edit : added(*stage, request, engine, layer)) {
    prims.insert(edit.object.prim());
  }
  nb::list changed;
  for (const Path& prim : prims) {
    changed.append(nb::cast(PrimOf{stage, prim}));
  }
  return changed;
}

void remove(OpenedStage& stage, const std::string& path, const nb::args& kinds,
            const std::string& engine, const nb::kwargs& options) {
  const AuthoringRequest request = authoring_of(path, kinds, options);
  std::vector<AssetEdit> edits;
  {
    const auto access = stage.access();
    const auto views = or_raise(unlocked([&] { return stage.views(); }));
    edits = or_raise(unlocked([&] { return remove_edits(views, request, engine); }));
  }
  edited(stage, edits);
}

void bind_requests(nb::class_<OpenedStage>& stage) {
  stage.def(
      "set", &set_all, "assignments"_a, "filter_overlaps"_a = false, "all_engines"_a = false,
      "type_name"_a = "", "engine"_a = "", "layer"_a = "", "words"_a,
      nb::sig("def set(self, *assignments: str, mass: Mapping[str, float] = ..., "
              "drive: Mapping[str, Mapping[str, float | str]] = ..., "
              "mimic: Mapping[str, tuple[str, float] | tuple[str, float, float]] = ..., "
              "collider: Mapping[str, str] = ..., material: Mapping[str, str] = ..., "
              "filter: Sequence[tuple[str, str]] = ..., "
              "apply: Mapping[str, str | Sequence[str]] = ..., "
              "remove: Mapping[str, str | Sequence[str]] = ..., clear: Sequence[str] = ..., "
              "filter_overlaps: bool = False, all_engines: bool = False, type_name: str = '', "
              "engine: str = '', layer: str = '') -> list[dict[str, Any]]"),
      "What `tenon set` does, as one step: texts \"PATH.property=VALUE\" (+= and -= for "
      "relationships); by the path of a prim `mass` [kg], gains of a `drive` (\"stiffness\", "
      "\"damping\", \"maxForce\" and others, in degrees as UsdPhysics has them), the leader, "
      "multiplier and offset of a `mimic`, the approximation of a `collider`, the physics "
      "`material`; pairs of prims to `filter`; schemas to `apply` and `remove`; properties to "
      "`clear`. Returns what Prim.set() returns.");
  stage.def("add", &add, "path"_a, "kinds"_a, "engine"_a = "", "layer"_a = "", "options"_a,
            nb::sig("def add(self, path: str, *kinds: str, engine: str = '', layer: str = '', "
                    "**options: object) -> Prim"),
            "What `tenon add` does, as one step: stage.add(\"/World/box\", \"cube\", \"body\", "
            "\"collider\", size=0.1, at=(0, 0, 1)). `tenon help add` lists the kinds and their "
            "options, which have '_' for '-' here, and `with_` for a word of Python; `set` is a "
            "dict of other properties. Units are those of the stage, angles are degrees. Returns "
            "the prim.");
  stage.def("add_matching", &add_matching, "pattern"_a, "kinds"_a, "engine"_a = "", "layer"_a = "",
            "options"_a,
            nb::sig("def add_matching(self, pattern: str, *kinds: str, engine: str = '', "
                    "layer: str = '', **options: object) -> list[Prim]"),
            "What `tenon add --match` does, as one step: puts kinds on all prims that a name, a "
            "path or a regular expression for the whole of either means and that lack them: "
            "stage.add_matching(\".*_collision\", \"collider\", approximation=\"convexHull\"). "
            "Options as of add(). Returns the prims, by path; NotFoundError where there are none.");
  stage.def("remove", &remove, "path"_a, "kinds"_a, "engine"_a = "", "options"_a,
            nb::sig("def remove(self, path: str, *kinds: str, engine: str = '', "
                    "**options: object) -> None"),
            "What `tenon remove` does, as one step: takes kinds off a prim, or the whole prim with "
            "the joints of its bodies and all that names it.");
}

}  // namespace

void bind_prim_authoring(nb::class_<PrimOf>& prim) {
  bind_arcs(prim);
  bind_metadata(prim);
  bind_choices(prim);
}

void bind_stage_authoring(nb::module_& module, nb::class_<OpenedStage>& stage) {
  bind_variant_block(module);
  bind_requests(stage);
  stage.def(
      "in_variant",
      [](const StagePtr& self, const std::string& prim, const std::string& set,
         const std::string& variant) { return VariantBlock{self, {path_of(prim), set, variant}}; },
      "prim"_a, "set"_a, "variant"_a,
      "For `with stage.in_variant(PRIM, SET, VARIANT):`: edits of the block go into that variant "
      "of the prim, whichever is selected; a new one is made, and its set. Edits of other prims, "
      "and those of all files at once (rename, remove), raise InvalidError.");
}

}  // namespace tenon::python
