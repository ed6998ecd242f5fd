// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Section 1.3: joints, bodies, colliders, materials and mimics.
#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "tenon/check/rep0158/judges.h"
#include "tenon/check/simready/reading.h"
#include "tenon/layer/field_values.h"
#include "tenon/layer/fields.h"

namespace tenon::check::rep0158 {
namespace {

bool has_one_axis(const stage::Prim& prim) {
  return prim.type_name() == "PhysicsRevoluteJoint" || prim.type_name() == "PhysicsPrismaticJoint";
}

/// A joint's mimics from it on, until one follows itself.
bool runs_in_a_circle(const std::map<Path, Path>& leaders, Path from) {
  std::set<Path> seen;
  for (auto at = leaders.find(from); at != leaders.end(); at = leaders.find(at->second)) {
    if (!seen.insert(at->first).second) {
      return at->first == from;
    }
  }
  return false;
}

}  // namespace

void judge_1_3_1(const Judged& judged, Report& report) {
  for (const stage::Prim& prim : judged.stage.every) {
    for (const char* name : {"physics:lowerLimit", "physics:upperLimit"}) {
      if (has_one_axis(prim) && !prim.attribute(Token(name)).is_authored()) {
        report.at(prim, std::string("there is no ") + name,
                  std::string("author ") + name + ", inf where there is none");
      }
    }
  }
}

void judge_1_3_2(const Judged& judged, Report& report) {
  const auto& prims = judged.stage.every;
  const auto roots = std::count_if(prims.begin(), prims.end(), [](const stage::Prim& prim) {
    return has_stock_api(prim, "PhysicsArticulationRootAPI");
  });
  if (roots > 1) {
    report.at_root(judged, std::to_string(roots) + " prims have PhysicsArticulationRootAPI",
                   "leave one for bodies that are jointed together");
  }
}

void judge_1_3_3(const Judged& judged, Report& report) {
  for (const stage::Prim& prim : judged.stage.every) {
    if (!has_stock_api(prim, "PhysicsRigidBodyAPI") || !has_stock_api(prim, "PhysicsMassAPI")) {
      continue;
    }
    const std::optional<double> mass = simready::number(prim, "physics:mass");
    if (mass && *mass <= 0) {
      report.at(prim, Token("physics:mass"), "the mass is " + digits(*mass),
                "author the body's mass in kg");
    }
  }
}

void judge_1_3_4(const Judged& judged, Report& report) {
  for (const stage::Prim& prim : judged.stage.every) {
    if (!has_stock_api(prim, "PhysicsCollisionAPI")) {
      continue;
    }
    const std::string purpose = simready::text(prim, "purpose");
    if (prim.is_a(Token("Imageable")) && purpose != "guide") {
      report.at(prim, Token("purpose"), "the collider's purpose is " + purpose,
                "author purpose = \"guide\"");
    }
    const std::string shape = simready::text(prim, "physics:approximation");
    if (shape != "none") {
      report.at(prim, Token("physics:approximation"),
                "physics:approximation is " + (shape.empty() ? "not authored" : shape),
                "author physics:approximation = \"none\"; on bodies that move most engines take "
                "the convex hull then");
    }
  }
}

void judge_1_3_5(const Judged& judged, Report& report) {
  for (const stage::Prim& prim : judged.stage.every) {
    if (!has_stock_api(prim, "PhysicsCollisionAPI")) {
      continue;
    }
    const std::vector<Path> bound = simready::targets(prim, "material:binding:physics");
    if (bound.size() != 1) {
      report.at(prim, "the collider has no material:binding:physics of its own",
                "bind a material with PhysicsMaterialAPI to it");
      continue;
    }
    const stage::Prim material = judged.stage.stage->prim(bound.front());
    for (const char* name :
         {"physics:staticFriction", "physics:dynamicFriction", "physics:restitution"}) {
      if (material && !material.attribute(Token(name)).is_authored()) {
        report.at(material, std::string("the material has no ") + name, "author it");
      }
    }
  }
}

void judge_1_3_7(const Judged& judged, Report& report) {
  const Token name("mimic:joint");
  std::map<Path, Path> leaders;
  for (const stage::Prim& prim : judged.stage.every) {
    if (!names_api(prim, "MimicJointAPI")) {
      continue;
    }
    if (!has_one_axis(prim)) {
      report.at(prim, "MimicJointAPI is on no revolute or prismatic joint", "remove it");
      report.as(Severity::Warning);
      continue;
    }
    const std::vector<Path> named_joints = prim.relationship(name).targets();
    const stage::Prim leader =
        named_joints.size() == 1 ? judged.stage.stage->prim(named_joints.front()) : stage::Prim();
    if (!leader || !has_one_axis(leader)) {
      report.at(prim, name, "mimic:joint does not name one revolute or prismatic joint",
                "name the joint that it follows");
      continue;
    }
    leaders[prim.path()] = leader.path();
  }
  for (const auto& [follower, leader] : leaders) {
    if (runs_in_a_circle(leaders, follower)) {
      report.at(judged.stage.stage->prim(follower), name, "the joint follows itself",
                "let one joint of the circle follow nobody");
    }
  }
}

void judge_1_3_8(const Judged& judged, Report& report) {
  for (const stage::Prim& prim : judged.stage.every) {
    const layer::Value said = prim.metadata(layer::fields::instanceable);
    if (said.get_or<bool>(false) && is_kinematic_or_ros(prim)) {
      report.at(prim, "the prim is instanceable, and a joint, a body or an interface of ROS",
                "make what is drawn below it instanceable");
    }
  }
}

void judge_1_3_9(const Judged& judged, Report& report) {
  for (const stage::Prim& prim : judged.stage.every) {
    if (names_api(prim, "MimicJointAPI")) {
      report.at(prim, "the draft dropped MimicJointAPI", "apply ExtendedPhysicsMimicAPI");
    }
  }
}

}  // namespace tenon::check::rep0158
