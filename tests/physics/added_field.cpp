// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Compiled by added_field.py in a copy of the sources where Body has a further member, `added`,
// with a row in its table and nothing else. Says what does not carry it.
#include <cstdio>
#include <string>

#include "tenon/answers/scene_json.h"
#include "tenon/scene/fields/scene_difference.h"
#include "tenon/scene/fields/wire_form.h"
#include "tenon/structure/proof/proof.h"

namespace {

using tenon::scene::PhysicsScene;

PhysicsScene scene_with(double added) {
  PhysicsScene scene;
  scene.scenes.push_back({tenon::Path::from("/Scene"), {{0, 0, -9.81}}, {}});
  tenon::scene::Body body;
  body.path = tenon::Path::from("/Body");
  body.added = added;
  scene.bodies.push_back(body);
  return scene;
}

int say(bool carried, const char* what) {
  std::printf("%s: %s\n", what, carried ? "carries it" : "DOES NOT CARRY IT");
  return carried ? 0 : 1;
}

}  // namespace

int main() {
  using tenon::answers::Geometry;
  const PhysicsScene before = scene_with(1);
  const PhysicsScene after = scene_with(2);
  int missing = 0;

  const std::string json = tenon::answers::scene_json(after, Geometry::Inline);
  const auto from_json = tenon::answers::read_scene_json(json);
  missing += say(from_json && from_json->bodies[0].added == 2, "JSON, there and back");
  missing += say(tenon::answers::scene_schema().find("\"added\"") != std::string::npos, "schema");

  const auto differences = tenon::scene::scene_differences(before, after);
  missing += say(differences.size() == 1 && differences[0].after.name == "added", "difference");
  const auto disagreement =
      tenon::structure::compare_physics(before, after, [](tenon::Path path) { return path; });
  missing += say(disagreement.has_value(), "proof of structure");

  missing += say(tenon::scene::scene_hash(before) != tenon::scene::scene_hash(after), "hash");
  const auto from_wire = tenon::scene::read_wire_form(tenon::scene::wire_form(after));
  missing += say(from_wire && from_wire->bodies[0].added == 2, "wire form, there and back");
  return missing == 0 ? 0 : 1;
}
