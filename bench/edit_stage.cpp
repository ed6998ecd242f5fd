// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// edit_stage COUNT [--repeats N]: defines so many prims in groups of 100 in a stage in memory, sets
// an attribute of each, applies a schema to each and sets what that brings. After every edit the
// composed stage is looked at, as a program does that edits step by step.
#include <cstdlib>
#include <string>

#include "bench/measure.h"
#include "tenon/edit/stage_editor.h"
#include "tenon/layer/value.h"

namespace {

using namespace tenon;

class Edits {
 public:
  explicit Edits(int count) : editor_(edit::StageEditor::in_memory()) {
    for (int i = 0; i < count; ++i) {
      prims_.push_back(Path::from("/World/g" + std::to_string(i / 100) + "/p" + std::to_string(i)));
    }
  }

  /// The number of prims after which `edit(editor, prim)` shows in the stage, as `shows` tells.
  template <class Edit, class Shows>
  std::size_t run(const Edit& edit, const Shows& shows) {
    std::size_t shown = 0;
    for (const Path prim : prims_) {
      if (const auto done = edit(editor_, prim); !done) {
        bench::fail(done.error().to_string());
      }
      const auto stage = bench::value_or_fail(editor_.working_stage());
      shown += shows(stage->prim(prim)) ? 1 : 0;
    }
    return shown;
  }

 private:
  edit::StageEditor editor_;
  std::vector<Path> prims_;
};

void edit_once(bench::Report& report, int count) {
  using Editor = edit::StageEditor;
  Edits edits(count);
  const auto phase = [&](const char* name, const auto& edit, const auto& shows) {
    report.count(name,
                 static_cast<double>(report.time(name, [&] { return edits.run(edit, shows); })));
  };
  const Token size("size");
  const Token mass("physics:mass");
  const Token schema("PhysicsMassAPI");
  phase(
      "define", [](Editor& e, Path prim) { return e.define_prim(prim, "Cube"); },
      [](const stage::Prim& prim) { return prim.type_name() == "Cube"; });
  phase(
      "set",
      [&](Editor& e, Path prim) { return e.set_value(prim.property(size), layer::Value(3.0)); },
      [&](const stage::Prim& prim) { return prim.attribute(size).get_as<double>() == 3.0; });
  phase(
      "apply", [&](Editor& e, Path prim) { return e.apply_api(prim, schema); },
      [&](const stage::Prim& prim) { return prim.has_api(schema); });
  phase(
      "set_again",
      [&](Editor& e, Path prim) { return e.set_value(prim.property(mass), layer::Value(2.0F)); },
      [&](const stage::Prim& prim) { return prim.attribute(mass).get_as<float>() == 2.0F; });
}

}  // namespace

int main(int count, char** values) {
  const bench::Arguments arguments = bench::read_arguments(count, values, 1);
  bench::Report report("edit_stage");
  for (int i = 0; i < arguments.repeats; ++i) {
    edit_once(report, std::atoi(arguments.files[0].c_str()));
  }
  report.print();
  return 0;
}
