// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// One argument becomes several plain edits: first the API schema, then its properties, whose types
// are known by it. Numbers are brought to what the schema means: kilograms to the unit of mass of
// the stage, and for PhysX, whose mimic joints state an equation that sums to zero, the negative
// ratio and offset. Computed numbers are rounded to float before they are written.
#include "tenon/asset/typed_edits.h"

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <utility>

#include "tenon/base/assignment.h"
#include "tenon/base/text/comma_list.h"
#include "tenon/base/text/text_number.h"
#include "tenon/check/overlaps/overlaps.h"

namespace tenon {
namespace {

using Edits = std::vector<AssetEdit>;

struct Assignment {
  Path prim;
  std::string value;
};

Error bad(std::string message, const std::string& fix) {
  return Error(ErrorCode::Invalid, std::move(message)).with_rule("edit.bad-argument").with_fix(fix);
}

Result<Assignment> read_prim_assignment(const std::string& text, const std::string& form) {
  const auto parts = split_assignment(text);
  if (!parts) {
    return bad("no = in \"" + text + "\"", "write " + form);
  }
  const auto path = Path::parse(parts->first);
  if (!path || !path->is_absolute() || !path->is_prim()) {
    return bad("\"" + parts->first + "\" is not the path of a prim, which begins with /",
               "write " + form + "; tenon tree lists all prims");
  }
  return Assignment{*path, parts->second};
}

AssetEdit applied(Path prim, const std::string& api) {
  AssetEdit edit;
  edit.kind = AssetEdit::Kind::ApplyApi;
  edit.object = prim;
  edit.api = Token(api);
  return edit;
}

AssetEdit set(Path prim, const std::string& property, std::string value) {
  AssetEdit edit;
  edit.object = prim.property(Token(property));
  edit.value = std::move(value);
  return edit;
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  while (begin <= text.size()) {
    const std::size_t end = std::min(text.find(separator, begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

/// `a` and `b`, and what is below them, do not collide.
Edits pair_edits(Path a, Path b) {
  AssetEdit pairs = set(a, "physics:filteredPairs", b.str());
  pairs.kind = AssetEdit::Kind::AddTargets;
  return Edits{applied(a, "PhysicsFilteredPairsAPI"), std::move(pairs)};
}

/// The instance of PhysicsDriveAPI that joints of one degree of freedom have; empty for others.
std::string drive_instance(const stage::Prim& joint) {
  return joint.is_a(Token("PhysicsRevoluteJoint"))    ? "angular"
         : joint.is_a(Token("PhysicsPrismaticJoint")) ? "linear"
                                                      : "";
}

}  // namespace

Result<Edits> mass_edits(const stage::Stage& stage, const std::string& text) {
  TENON_TRY(const Assignment mass,
            read_prim_assignment(text, "PRIM=KILOGRAMS, as in /hand/palm=0.14"));
  const auto kilograms = parse_double(mass.value);
  if (!kilograms || !(*kilograms > 0)) {
    return bad("the mass \"" + mass.value + "\" is not a number above 0", "give kilograms");
  }
  const double unit = stage.metadata(Token("kilogramsPerUnit")).get_or(1.0);
  const double value = unit > 0 ? *kilograms / unit : *kilograms;
  return Edits{applied(mass.prim, "PhysicsMassAPI"),
               set(mass.prim, "physics:mass", shortest(static_cast<float>(value)))};
}

Result<Edits> collider_edits(const std::string& text) {
  TENON_TRY(const Assignment collider, read_prim_assignment(text, "PRIM=convexHull, or PRIM=on"));
  Edits edits{applied(collider.prim, "PhysicsCollisionAPI")};
  if (collider.value != "on") {
    edits.push_back(applied(collider.prim, "PhysicsMeshCollisionAPI"));
    edits.push_back(set(collider.prim, "physics:approximation", collider.value));
  }
  return edits;
}

Result<Edits> material_edits(const std::string& text) {
  TENON_TRY(const Assignment material, read_prim_assignment(text, "PRIM=/path/of/Material"));
  AssetEdit binding = set(material.prim, "material:binding:physics", material.value);
  binding.type_name = Token("rel");
  return Edits{applied(material.prim, "MaterialBindingAPI"), std::move(binding)};
}

Result<Edits> drive_edits(const stage::Stage& stage, const std::string& text) {
  static constexpr std::array kKeys{"stiffness",      "damping",        "maxForce",
                                    "targetPosition", "targetVelocity", "type"};
  const std::string form = "JOINT=stiffness:10,damping:1,maxForce:5,targetPosition:0";
  const std::size_t equals = text.find('=');
  const std::size_t colon = text.find(':');
  std::string instance;
  std::string plain = text;
  if (equals != std::string::npos && colon < equals) {
    instance = text.substr(colon + 1, equals - colon - 1);
    plain.erase(colon, equals - colon);
  }
  TENON_TRY(const Assignment drive, read_prim_assignment(plain, form));
  instance = instance.empty() ? drive_instance(stage.prim(drive.prim)) : instance;
  if (instance.empty()) {
    return bad("<" + drive.prim.str() + "> is neither a revolute nor a prismatic joint",
               "name one, or the axis to drive: " + drive.prim.str() + ":rotX=...");
  }
  Edits edits{applied(drive.prim, "PhysicsDriveAPI:" + instance)};
  for (const std::string& part : split(drive.value, ',')) {
    const std::size_t at = part.find(':');
    const std::string key = part.substr(0, at);
    const bool known = std::find(kKeys.begin(), kKeys.end(), key) != kKeys.end();
    if (at == std::string::npos) {
      return bad("no : in \"" + part + "\"", "write " + form);
    }
    if (!known) {
      return bad("unknown key \"" + key + "\"",
                 "a drive takes " + comma_list(kKeys) + ": write " + form);
    }
    edits.push_back(set(drive.prim, "drive:" + instance + ":physics:" + key, part.substr(at + 1)));
  }
  return edits;
}

Result<Edits> mimic_edits(const std::string& text, const std::string& engine) {
  const std::string form = "FOLLOWER=LEADER,MULTIPLIER or FOLLOWER=LEADER,MULTIPLIER,OFFSET";
  TENON_TRY(const Assignment mimic, read_prim_assignment(text, form));
  const std::vector<std::string> parts = split(mimic.value, ',');
  const auto multiplier = parts.size() < 2 ? std::nullopt : parse_double(parts[1]);
  const auto offset = parts.size() < 3 ? std::optional<double>(0) : parse_double(parts[2]);
  if (!multiplier || !offset || parts.size() > 3) {
    return bad(text, "write " + form);
  }
  const auto number = [](double value) { return shortest(static_cast<float>(value + 0.0)); };
  if (engine == "physx") {  // q + gearing * leader + offset = 0
    const std::string head = "physxMimicJoint:rotX:";
    return Edits{applied(mimic.prim, "PhysxMimicJointAPI:rotX"),
                 set(mimic.prim, head + "referenceJoint", parts[0]),
                 set(mimic.prim, head + "gearing", number(-*multiplier)),
                 set(mimic.prim, head + "offset", number(-*offset))};
  }
  return Edits{applied(mimic.prim, "NewtonMimicAPI"),
               set(mimic.prim, "newton:mimicJoint", parts[0]),
               set(mimic.prim, "newton:mimicCoef1", number(*multiplier)),
               set(mimic.prim, "newton:mimicCoef0", number(*offset))};
}

Path filtered_prim(const stage::Stage& stage, const scene::PhysicsScene& scene, Path path) {
  if (!stage.prim(path).is_instance_proxy()) {
    return path;
  }
  const auto collider = std::find_if(scene.colliders.begin(), scene.colliders.end(),
                                     [&](const scene::Collider& c) { return c.path == path; });
  Path owner = collider != scene.colliders.end() && collider->body
                   ? scene.bodies[*collider->body].path
                   : path.parent();
  while (stage.prim(owner).is_instance_proxy()) {
    owner = owner.parent();
  }
  return owner;
}

Result<Edits> filter_edits(const stage::Stage& stage, const scene::PhysicsScene& scene,
                           const std::string& text) {
  const std::vector<std::string> parts = split(text, ',');
  const auto first = Path::parse(parts.front());
  const auto second = Path::parse(parts.back());
  const auto is_prim = [](const Result<Path>& path) {
    return path && path->is_absolute() && path->is_prim();
  };
  if (parts.size() != 2 || !is_prim(first) || !is_prim(second)) {
    return bad("\"" + text + "\" is not two paths of prims", "write /hand/palm,/hand/thumb");
  }
  const Path a = filtered_prim(stage, scene, *first);
  const Path b = filtered_prim(stage, scene, *second);
  if (a == b) {
    return bad(
        "both prims of \"" + text + "\" are " + (*first == *second ? "the same" : "of one body"),
        "name two bodies");
  }
  return pair_edits(a, b);
}

Edits overlap_edits(const stage::Stage& stage, const scene::PhysicsScene& scene) {
  std::set<std::pair<Path, Path>> pairs;
  for (const auto& [first, second] : check::overlaps_at_start(scene, check::kAllOverlaps)) {
    const auto owner = [&](scene::Index i) {
      const scene::Collider& collider = scene.colliders[i];
      const Path path = collider.body ? scene.bodies[*collider.body].path : collider.path;
      return filtered_prim(stage, scene, path);
    };
    const Path a = owner(first);
    const Path b = owner(second);
    if (a != b) {
      pairs.emplace(std::min(a, b), std::max(a, b));
    }
  }
  Edits edits;
  for (const auto& [a, b] : pairs) {
    for (AssetEdit& edit : pair_edits(a, b)) {
      edits.push_back(std::move(edit));
    }
  }
  return edits;
}

}  // namespace tenon
