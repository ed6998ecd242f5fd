// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// Makes an asset, a box that weighs by its density, saves it and reads it back.
//   authoring box.usda
#include <cstdio>

#include "example.h"

#include "tenon/tenon.h"

namespace {

using tenon::Path;
using tenon::Token;
using tenon::layer::Value;

tenon::Result<void> make_box(tenon::edit::StageEditor& editor) {
  const Path root = Path::absolute_root();
  const Path box = Path::from("/World/Box");
  TENON_CHECK(editor.define_prim(Path::from("/World"), "Xform"));
  TENON_CHECK(editor.set_metadata(root, "defaultPrim", Value(Token("World"))));
  TENON_CHECK(editor.set_metadata(root, "metersPerUnit", Value(1.0)));
  TENON_CHECK(editor.set_metadata(root, "upAxis", Value(Token("Z"))));
  TENON_CHECK(editor.define_prim(Path::from("/World/Scene"), "PhysicsScene"));
  TENON_CHECK(editor.define_prim(box, "Cube"));
  TENON_CHECK(editor.set_value(box.property("size"), Value(0.2)));
  for (const char* schema : {"PhysicsRigidBodyAPI", "PhysicsCollisionAPI", "PhysicsMassAPI"}) {
    TENON_CHECK(editor.apply_api(box, schema));
  }
  return editor.set_value(box.property("physics:density"), Value(500.0F));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: authoring OUTPUT\n");
    return 2;
  }
  auto editor = tenon::edit::StageEditor::in_memory();
  or_exit(editor.as_one_step([&editor] { return make_box(editor); }));
  for (const auto& [identifier, layer] : editor.edited_layers()) {
    or_exit(tenon::formats::save_layer(*layer, argv[1]));
  }

  tenon::Diagnostics diagnostics;
  const auto stage = or_exit(tenon::open(argv[1], {}, diagnostics));
  const auto scene = tenon::physics::read_physics(stage, tenon::read_options(), diagnostics);
  tell(diagnostics);
  for (const tenon::scene::Body& body : scene.bodies) {
    std::printf("%s: %.6f kg, moment of inertia %.8f kg m^2\n", body.path.str().c_str(), body.mass,
                body.inertia[0][0]);
  }
}
