// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "stage_answers.h"

#include <memory>
#include <optional>
#include <string>

#include "failure.h"
#include "json.h"
#include "physics.h"
#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>

#include "tenon/answers/explain.h"
#include "tenon/answers/forest_json.h"
#include "tenon/answers/info_json.h"
#include "tenon/answers/mass_json.h"
#include "tenon/answers/tree_json.h"
#include "tenon/answers/where_opinions.h"
#include "tenon/asset/answers/explained_stage.h"
#include "tenon/asset/answers/where_variants.h"
#include "tenon/asset/physics_options.h"
#include "tenon/physics/read_physics.h"
#include "tenon/scene/joint_forest.h"

namespace tenon::python {
namespace {

using namespace nb::literals;
using answers::Json;

std::shared_ptr<ReadScene> physics_of(OpenedStage& stage) {
  const auto access = stage.access();
  auto read = std::make_shared<ReadScene>();
  unlocked([&] {
    read->scene = physics::read_physics(*access, read_options(stage.readings()), read->diagnostics);
  });
  return read;
}

/// An answer about the physics of a stage and where it comes from.
template <class Answer>
nb::object ask(OpenedStage& stage, const Answer& answer) {
  const auto access = stage.access();
  Diagnostics found;
  Result<Json> json = unlocked(
      [&]() -> Result<Json> { return answer(explained_stage(*access, stage.readings(), found)); });
  return to_python(or_raise(std::move(json), found));
}

nb::object explain(OpenedStage& stage, const std::string& object,
                   const std::optional<std::string>& other) {
  return ask(stage, [&](const answers::Explained& explained) -> Result<Json> {
    TENON_CHECK(answers::check_object(explained.stage, object));
    return answers::explain_object(explained, object, other.value_or(""));
  });
}

nb::object masses(OpenedStage& stage) {
  const nb::object rows = ask(stage, [](const answers::Explained& explained) -> Result<Json> {
    return answers::mass_table_json(explained.stage, explained.scene, explained.provenance);
  });
  return nb::module_::import_("tenon_usd.tables").attr("Rows")(rows);
}

nb::object info(OpenedStage& stage) {
  return ask(stage, [](const answers::Explained& explained) -> Result<Json> {
    return answers::info_json(explained.stage, explained.scene);
  });
}

nb::object kinematic_tree(OpenedStage& stage) {
  return ask(stage, [](const answers::Explained& explained) -> Result<Json> {
    return answers::forest_json(explained.scene, scene::joint_forest(explained.scene));
  });
}

nb::object tree(OpenedStage& stage) {
  const auto access = stage.access();
  return to_python(unlocked([&] { return answers::tree_json(*access); }));
}

Result<Json> where_answer(OpenedStage& opened, const stage::Stage& stage,
                          const WhereQuestion& question, bool variants) {
  const stage::Prim prim = stage.prim(question.prim);
  if (!prim) {
    return Error(ErrorCode::NotFound, "there is no prim <" + question.prim.str() + ">");
  }
  if (!question.property.empty()) {
    TENON_CHECK(answers::check_property(prim, question.property));
  }
  Json answer = answers::where_json(stage, prim, question.property, question.time);
  if (variants) {
    TENON_CHECK(add_other_variants({stage, opened.path(), opened.options()}, question, answer));
  }
  return answer;
}

nb::object where(OpenedStage& opened, const std::string& object, std::optional<double> time,
                 bool variants) {
  const Path path = or_raise(Path::parse(object));
  WhereQuestion question;
  question.prim = path.is_property() ? path.parent() : path;
  question.property = path.is_property() ? path.name() : Token();
  question.time = time;
  const auto access = opened.access();
  return to_python(
      or_raise(unlocked([&] { return where_answer(opened, *access, question, variants); })));
}

}  // namespace

void bind_stage_answers(nb::class_<OpenedStage>& stage) {
  stage.def("physics", &physics_of,
            "What an engine receives of the stage: a PhysicsScene in metres, kilograms, seconds "
            "and radians, read again at each call.");
  stage.def("explain", &explain, "object"_a, "other"_a = nb::none(),
            nb::sig("def explain(self, object: str, other: str | None = None) -> dict[str, Any]"),
            "Where numbers come from: of \"/prim\" what it is to engines [SI, rad], of "
            "\"/prim.property\" every opinion, of two prims whether they collide and why not. "
            "docs/outputs.md lists the keys.");
  stage.def("where", &where, "object"_a, "time"_a = nb::none(), nb::kw_only(), "variants"_a = false,
            nb::sig("def where(self, object: str, time: float | None = None, *, "
                    "variants: bool = False) -> dict[str, Any]"),
            "Every file that speaks about \"/prim.property\" or \"/prim\" and which one counts, at "
            "a time [time codes]; with `variants` also what other variants of \"Physics\" say.");
  stage.def("info", &info, nb::sig("def info(self) -> dict[str, Any]"),
            "What the asset is: units, variants, counts of bodies and joints, mass [kg].");
  stage.def("masses", &masses, nb::sig("def masses(self) -> tenon_usd.tables.Rows"),
            "Of every body the authored and the resolved mass [kg], centre of mass [m] and inertia "
            "[kg m^2], with the reasons: a list of dictionaries, and a table by to_pandas() and "
            "to_arrow().");
  stage.def("tree", &tree, nb::sig("def tree(self) -> list[dict[str, Any]]"),
            "Every prim: path, specifier, type, active, instance.");
  stage.def("kinematic_tree", &kinematic_tree,
            nb::sig("def kinematic_tree(self) -> dict[str, Any]"),
            "Bodies as trees of joints: parent, joint, degrees of freedom, mass [kg].");
}

}  // namespace tenon::python
