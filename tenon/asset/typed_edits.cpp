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
#include <utility>

#include "tenon/base/assignment.h"
#include "tenon/base/text/text_number.h"

namespace tenon {
namespace {

using Edits = std::vector<AssetEdit>;

struct Assignment {
  Path prim;
  std::string value;
};

Error bad(const std::string& text, const std::string& fix) {
  return Error(ErrorCode::Invalid, "\"" + text + "\" does not say what to do")
      .with_rule("edit.bad-argument")
      .with_fix(fix);
}

Result<Assignment> read_prim_assignment(const std::string& text, const std::string& form) {
  const auto parts = split_assignment(text);
  const auto path = parts ? Path::parse(parts->first) : Result<Path>(Path());
  if (!parts || !path || !path->is_absolute() || !path->is_prim()) {
    return bad(text, "write " + form);
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
    return bad(text, "a mass is a number of kilograms above 0");
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
    return bad(text, "name what is driven: " + drive.prim.str() + ":rotX=..., or a joint that is");
  }
  Edits edits{applied(drive.prim, "PhysicsDriveAPI:" + instance)};
  for (const std::string& part : split(drive.value, ',')) {
    const std::size_t at = part.find(':');
    const std::string key = part.substr(0, at);
    const bool known = std::find(kKeys.begin(), kKeys.end(), key) != kKeys.end();
    if (at == std::string::npos || !known) {
      return bad(part, "write " + form);
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

Result<Edits> filter_edits(const std::string& text) {
  const std::vector<std::string> parts = split(text, ',');
  const auto first = Path::parse(parts.front());
  const auto second = Path::parse(parts.back());
  const auto is_prim = [](const Result<Path>& path) {
    return path && path->is_absolute() && path->is_prim();
  };
  if (parts.size() != 2 || !is_prim(first) || !is_prim(second) || *first == *second) {
    return bad(text, "write two prims: /hand/palm,/hand/thumb");
  }
  AssetEdit pairs = set(*first, "physics:filteredPairs", parts.back());
  pairs.kind = AssetEdit::Kind::AddTargets;
  return Edits{applied(*first, "PhysicsFilteredPairsAPI"), std::move(pairs)};
}

}  // namespace tenon
