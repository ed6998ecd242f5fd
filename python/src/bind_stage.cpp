// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Stages and prims of Python: reading (edits: bind_edits.cpp). A prim is a stage and
// a path that is looked up each time, so that it may be kept for as long as one likes, edits
// included; a query of a prim that is gone raises.
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bind_edits.h"
#include "failure.h"
#include "guarded_write.h"
#include "json.h"
#include "opened_stage.h"
#include "options.h"
#include "physics.h"
#include "prim_of.h"
#include "stage_answers.h"
#include "values.h"
#include <nanobind/nanobind.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "tenon/base/text/nearest_name.h"
#include "tenon/formats/save_layer.h"
#include "tenon/stage/flatten/flatten.h"

namespace tenon::python {
namespace {

using namespace nb::literals;

stage::Time time_of(std::optional<double> time) {
  return time ? stage::Time(*time) : stage::Time();
}

PrimOf prim_of(const StagePtr& stage, const std::string& written) {
  PrimOf prim{stage, path_of(written)};
  with_prim(prim, [](const stage::Prim&) {});
  return prim;
}

nb::list paths_of(const std::vector<Path>& paths) {
  nb::list result;
  for (const Path& path : paths) {
    result.append(text(path.str()));
  }
  return result;
}

[[noreturn]] void raise_no_property(const stage::Prim& prim, const std::string& name) {
  std::vector<std::string_view> names;
  const auto known = prim.property_names();
  for (const Token& one : known) {
    names.push_back(one.view());
  }
  const std::string nearest(nearest_name(name, names));
  raise(Error(ErrorCode::NotFound, "<" + prim.path().str() + "> has no property \"" + name + "\"")
            .with_prim(prim.path().str())
            .with_rule("edit.no-property")
            .with_fix(nearest.empty() ? "Prim.properties lists all"
                                      : "did you mean " + nearest + "?"));
}

/// The value of an attribute at a time; of a relationship its targets.
nb::object value_of(const PrimOf& prim, const std::string& name, std::optional<double> time) {
  return with_prim(prim, [&](const stage::Prim& found) -> nb::object {
    if (found.is_relationship(name)) {
      return paths_of(found.relationship(name).targets());
    }
    const stage::Attribute attribute = found.attribute(name);
    if (!attribute.is_defined()) {
      raise_no_property(found, name);
    }
    return to_python(attribute.get(time_of(time)));
  });
}

nb::object flattened(OpenedStage& stage, const std::optional<std::filesystem::path>& output) {
  const auto access = stage.access();
  if (!output) {
    return text(or_raise(unlocked([&] {
      return formats::encode_layer(stage::flatten(*access), formats::LayerFormat::Text);
    })));
  }
  or_raise(unlocked([&]() -> Result<void> {
    TENON_TRY(const auto format, formats::layer_format_for(output->string()));
    TENON_TRY(std::string bytes, formats::encode_layer(stage::flatten(*access), format));
    GuardedRun guard;
    guard.note(*access);
    return write_made({{output->string(), std::move(bytes)}});
  }));
  return nb::none();
}

nb::list children_of(const PrimOf& prim) {
  return with_prim(prim, [&](const stage::Prim& found) {
    nb::list children;
    for (const stage::Prim& child : found.children()) {
      children.append(nb::cast(PrimOf{prim.stage, child.path()}));
    }
    return children;
  });
}

/// Depth first, the prim itself first.
nb::list walk(const PrimOf& top) {
  return with_prim(top, [&](const stage::Prim& found) {
    nb::list walked;
    std::vector<stage::Prim> open{found};
    while (!open.empty()) {
      const stage::Prim prim = open.back();
      open.pop_back();
      if (!prim.is_pseudo_root()) {
        walked.append(nb::cast(PrimOf{top.stage, prim.path()}));
      }
      const std::vector<stage::Prim> children = prim.children();
      open.insert(open.end(), children.rbegin(), children.rend());
    }
    return walked;
  });
}

void bind_prim_values(nb::class_<PrimOf>& prim) {
  prim.def("get", &value_of, "name"_a, "time"_a = nb::none(),
           "The resolved value of an attribute at a time code (the default time where none is "
           "given), in the units of the stage: numbers, str, tuples of vectors, quaternions as "
           "(w, x, y, z), matrices as tuples of rows, arrays of numbers as read-only NumPy views "
           "(count, ...) without a copy; None where there is no value. Of a relationship: its "
           "targets, a list of paths. Raises NotFoundError for an unknown name.");
  prim.def(
      "__getitem__",
      [](const PrimOf& self, const std::string& name) { return value_of(self, name, {}); },
      "name"_a, "The same at the default time, in the units of the stage.");
}

void bind_prim_place(nb::class_<PrimOf>& prim) {
  prim.def_prop_ro(
      "path", [](const PrimOf& self) { return text(self.path.str()); },
      "Absolute path: \"/hand/palm\".");
  prim.def_prop_ro(
      "name", [](const PrimOf& self) { return text(self.path.name().str()); },
      "Last element of the path.");
  prim.def_prop_ro(
      "type_name",
      [](const PrimOf& self) {
        return with_prim(self, [](const stage::Prim& p) { return text(p.type_name().str()); });
      },
      "\"Xform\", \"PhysicsRevoluteJoint\"; empty where it has none.");
  prim.def_prop_ro(
      "stage", [](const PrimOf& self) { return self.stage; }, "The stage that it is of.");
  prim.def_prop_ro(
      "exists",
      [](const PrimOf& self) {
        const auto stage = self.stage->access();
        return stage->prim(self.path).is_valid();
      },
      "False once it was removed.");
  prim.def_prop_ro(
      "parent",
      [](const PrimOf& self) -> std::optional<PrimOf> {
        const Path parent = self.path.parent();
        return parent.is_prim() ? std::optional(PrimOf{self.stage, parent}) : std::nullopt;
      },
      "The prim above; None for those at the top.");
  prim.def_prop_ro("children", &children_of, nb::sig("def children(self) -> list[Prim]"),
                   "Prims right below, in order, also inactive ones and those in instances.");
  prim.def("walk", &walk, nb::sig("def walk(self) -> list[Prim]"),
           "This prim and all below it, depth first.");
}

void bind_prim_schemas(nb::class_<PrimOf>& prim) {
  prim.def_prop_ro(
      "properties",
      [](const PrimOf& self) {
        return with_prim(self, [](const stage::Prim& p) { return words_of(p.property_names()); });
      },
      nb::sig("def properties(self) -> list[str]"), "Names, those that schemas declare included.");
  prim.def_prop_ro(
      "authored",
      [](const PrimOf& self) {
        return with_prim(
            self, [](const stage::Prim& p) { return words_of(p.authored_property_names()); });
      },
      nb::sig("def authored(self) -> list[str]"), "Names of properties that layers author.");
  prim.def_prop_ro(
      "apis",
      [](const PrimOf& self) {
        return with_prim(self,
                         [](const stage::Prim& p) { return words_of(p.authored_api_schemas()); });
      },
      nb::sig("def apis(self) -> list[str]"), "API schemas that are applied.");
  prim.def_prop_ro(
      "variants",
      [](const PrimOf& self) {
        return with_prim(self, [](const stage::Prim& p) {
          nb::dict sets;
          for (const std::string& set : p.variant_set_names()) {
            sets[text(set)] =
                nb::make_tuple(text(p.variant_selection(set)), words_of(p.variant_names(set)));
          }
          return sets;
        });
      },
      nb::sig("def variants(self) -> dict[str, tuple[str, list[str]]]"),
      "By variant set: the selection and what there is.");
}

void bind_prim_questions(nb::class_<PrimOf>& prim) {
  prim.def(
      "is_a",
      [](const PrimOf& self, const std::string& type) {
        return with_prim(self, [&](const stage::Prim& p) { return p.is_a(type); });
      },
      "type"_a, "Its type is this one or derived from it: \"PhysicsJoint\".");
  prim.def(
      "has_api",
      [](const PrimOf& self, const std::string& schema) {
        return with_prim(self, [&](const stage::Prim& p) { return p.has_api(schema); });
      },
      "schema"_a, "The API schema is applied: \"PhysicsRigidBodyAPI\".");
  prim.def(
      "metadata",
      [](const PrimOf& self, const std::string& field, const std::string& property) {
        return with_prim(self, [&](const stage::Prim& p) {
          return to_python(property.empty()              ? p.metadata(field)
                           : p.is_relationship(property) ? p.relationship(property).metadata(field)
                                                         : p.attribute(property).metadata(field));
        });
      },
      "field"_a, "property"_a = "",
      "Composed metadata, of the prim or of one of its properties: \"kind\", \"documentation\", "
      "\"customData\" (a dict); None where nothing is said.");
  prim.def(
      "connections",
      [](const PrimOf& self, const std::string& name) {
        return with_prim(
            self, [&](const stage::Prim& p) { return paths_of(p.attribute(name).connections()); });
      },
      "name"_a, nb::sig("def connections(self, name: str) -> list[str]"),
      "Paths of the attributes that feed this one.");
  prim.def(
      "times",
      [](const PrimOf& self, const std::string& name) {
        return with_prim(self, [&](const stage::Prim& p) {
          nb::list times;
          for (const double time : p.attribute(name).time_samples()) {
            times.append(time);
          }
          return times;
        });
      },
      nb::sig("def times(self, name: str) -> list[float]"),
      "Times of the samples of an attribute [time codes].");
}

void bind_prim(nb::module_& module) {
  nb::class_<PrimOf> prim(module, "Prim",
                          "A prim of a composed stage, looked up by its path at each call.");
  bind_prim_place(prim);
  bind_prim_schemas(prim);
  bind_prim_questions(prim);
  prim.def("__repr__",
           [](const PrimOf& self) { return message("<Prim " + self.path.str() + ">"); });
  prim.def("__eq__", [](const PrimOf& self, const nb::object& other) {
    return nb::isinstance<PrimOf>(other) && nb::cast<const PrimOf&>(other) == self;
  });
  prim.def("__hash__", [](const PrimOf& self) { return std::hash<Path>()(self.path); });
  bind_prim_values(prim);
  bind_prim_edits(prim);
}

void bind_stage_facts(nb::class_<OpenedStage>& stage) {
  stage.def_prop_ro(
      "path", [](const OpenedStage& self) { return text(self.path()); },
      "The file that was opened.");
  stage.def_prop_ro(
      "diagnostics", [](const OpenedStage& self) { return to_list(self.diagnostics()); },
      nb::sig("def diagnostics(self) -> list[Diagnostic]"),
      "What opening found: missing references, values of wrong types.");
  stage.def("prim", &prim_of, "path"_a,
            "The prim at an absolute path. Raises NotFoundError where there is none.");
  stage.def("__getitem__", &prim_of, "path"_a, "The same: stage[\"/hand/palm\"].");
  stage.def(
      "__contains__",
      [](OpenedStage& self, const std::string& path) {
        const auto access = self.access();
        const Result<Path> parsed = Path::parse(path);
        return parsed && access->prim(*parsed).is_valid();
      },
      "path"_a, "Whether there is a prim at the path.");
  stage.def_prop_ro(
      "default_prim",
      [](const StagePtr& self) -> std::optional<PrimOf> {
        const auto access = self->access();
        const stage::Prim prim = access->default_prim();
        return prim ? std::optional(PrimOf{self, prim.path()}) : std::nullopt;
      },
      "The default prim; None where there is none.");
  stage.def_prop_ro(
      "prims", [](const StagePtr& self) { return walk({self, Path::absolute_root()}); },
      nb::sig("def prims(self) -> list[Prim]"), "All prims, depth first.");
  stage.def(
      "metadata",
      [](OpenedStage& self, const std::string& field) {
        const auto access = self.access();
        return to_python(access->metadata(field));
      },
      "field"_a, "Metadata of the stage: \"metersPerUnit\" [m], \"upAxis\".");
  stage.def_prop_ro(
      "layers",
      [](OpenedStage& self) {
        const auto access = self.access();
        nb::list names;
        for (const layer::LayerPtr& layer : access->used_layers()) {
          names.append(text(layer->identifier()));
        }
        return names;
      },
      nb::sig("def layers(self) -> list[str]"), "Files that were opened, sorted.");
  stage.def("__repr__",
            [](const OpenedStage& self) { return message("<Stage " + self.path() + ">"); });
  stage.def(
      "_repr_html_",
      [](nb::handle self) {
        return nb::module_::import_("tenon_usd._lists").attr("html_of_stage")(self);
      },
      nb::sig("def _repr_html_(self) -> str"), "A table for notebooks.");
}

StagePtr open(const std::filesystem::path& path, const OpenArguments& arguments) {
  return OpenedStage::open(path.string(), arguments.open, readings_of(arguments));
}

/// Element by element, each as it is there or as one next to it is called; empty where none is.
std::string nearest_path(const stage::Stage& stage, Path wanted) {
  std::vector<Token> elements;
  for (Path at = wanted; at.is_prim(); at = at.parent()) {
    elements.push_back(at.name());
  }
  stage::Prim at = stage.pseudo_root();
  for (auto element = elements.rbegin(); element != elements.rend(); ++element) {
    stage::Prim next = at.child(*element);
    if (!next) {
      const std::vector<stage::Prim> children = at.children();
      std::vector<std::string> names;
      for (const stage::Prim& child : children) {
        names.push_back(child.name().str());
      }
      const std::string_view nearest =
          nearest_name(element->view(), std::vector<std::string_view>(names.begin(), names.end()));
      next = nearest.empty() ? stage::Prim() : at.child(Token(nearest));
    }
    if (!next) {
      return {};
    }
    at = next;
  }
  return at.path().str();
}

}  // namespace

void raise_no_prim(const stage::Stage& stage, Path wanted) {
  const std::string nearest = nearest_path(stage, wanted);
  raise(Error(ErrorCode::NotFound, "there is no prim <" + wanted.str() + ">")
            .with_rule("edit.no-prim")
            .with_fix(nearest.empty() ? "Stage.prims lists all" : "did you mean " + nearest + "?"));
}

void bind_stage(nb::module_& module) {
  nb::class_<OpenedStage> stage(module, "Stage",
                                "A composed asset, made by open(). Prims and values are in the "
                                "units of the stage; physics is in SI and radians.");
  bind_prim(module);
  bind_stage_facts(stage);
  bind_stage_edits(module, stage);
  stage.def("flatten", &flattened, "path"_a = nb::none(),
            nb::sig("def flatten(self, path: str | os.PathLike[str] | None = None) -> str | None"),
            "The whole scene as one layer without composition: its text, or written to a file "
            "(.usda, .usdc, .usd, .usdz), not one of those that were read.");
  bind_stage_answers(stage);
  module.def("open_stage", &open, "path"_a, "arguments"_a,
             nb::sig("def open_stage(path: str | os.PathLike[str], "
                     "arguments: OpenArguments) -> Stage"),
             "Opens and composes an asset. tenon_usd.open() is the way in.");
}

}  // namespace tenon::python
