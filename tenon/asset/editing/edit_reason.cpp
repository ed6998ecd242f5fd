// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The reader of physics has often said why already: in a finding about the property, or about
// another prim that names this one and is about the same thing, such as an actuator that replaces a
// drive. Next come what is listed as not read and what the prim is not: colliders are shapes,
// masses are of bodies and colliders, the numbers of joints of joints.
#include "tenon/asset/editing/edit_reason.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <utility>

#include "tenon/base/text/text_number.h"

namespace tenon {
namespace {

struct Reason {
  Message why;
  std::string fix;
};
using MaybeReason = std::optional<Reason>;

Token property_of(const AssetEdit& edit) {
  return edit.is_about_api() ? Token() : edit.object.name();
}

bool begins(const AssetEdit& edit, std::string_view head) {
  return property_of(edit).view().starts_with(head);
}

/// The prim that the finding is about itself.
std::string in_brackets(const stage::Prim& prim) { return "<" + prim.path().str() + ">"; }

template <class Object>
const Object* object_at(const std::vector<Object>& objects, Path path) {
  const auto found = std::find_if(objects.begin(), objects.end(),
                                  [&](const Object& object) { return object.path == path; });
  return found == objects.end() ? nullptr : &*found;
}

/// The sentence of a finding, with what it is about.
Message said(const Diagnostic& finding) {
  Message message = finding.message;
  for (const RelatedPrim& related : finding.related) {
    message.about(Path::from(related.path), related.role);
  }
  return message;
}

bool is_about(const Diagnostic& finding, const std::string& prim) {
  return finding.prim == prim ||
         std::any_of(finding.related.begin(), finding.related.end(),
                     [&](const RelatedPrim& related) { return related.path == prim; });
}

/// What readers say of the property itself.
MaybeReason finding_of_property(const PhysicsView& view, const AssetEdit& edit) {
  for (const Diagnostic& finding : view.findings) {
    if (!edit.is_about_api() && finding.prim == edit.object.prim().str() &&
        finding.property == property_of(edit).view()) {
      return Reason{said(finding), finding.fix};
    }
  }
  return std::nullopt;
}

/// Rules by which one opinion takes the place of another, and what these opinions are about.
struct Replaces {
  std::string_view rule;
  std::array<std::string_view, 2> subjects;  ///< beginnings of properties
};
constexpr std::array kReplacing{
    Replaces{"actuator.replaces-drive", {"drive:", "drive:"}},
    Replaces{"mimic.several", {"newton:mimic", "mjc:coef"}},
};

MaybeReason finding_of_winner(const PhysicsView& view, const AssetEdit& edit) {
  const std::string prim = edit.object.prim().str();
  for (const Diagnostic& finding : view.findings) {
    for (const Replaces& replaces : kReplacing) {
      const bool same = is_about(finding, prim);
      const bool about = begins(edit, replaces.subjects[0]) || begins(edit, replaces.subjects[1]);
      if (finding.rule == replaces.rule && same && about) {
        const Message winner =
            finding.prim == prim ? Message("") : named(Path::from(finding.prim)) + ": ";
        return Reason{winner + said(finding), "with --all-engines both are edited"};
      }
    }
  }
  return std::nullopt;
}

MaybeReason not_read(const PhysicsView& view, const AssetEdit& edit) {
  for (const scene::NotRead& one : view.scene.not_read) {
    if (one.prim == edit.object.prim() && one.property == property_of(edit).view()) {
      return Reason{one.why, ""};
    }
  }
  return std::nullopt;
}

/// Shapes below a prim, nearest first; a few suffice.
std::vector<Path> shapes_below(const stage::Prim& prim) {
  constexpr std::size_t kLooked = 1000;
  constexpr std::size_t kWanted = 3;
  std::vector<Path> shapes;
  std::vector<stage::Prim> queue{prim};
  for (std::size_t i = 0; i < queue.size() && i < kLooked && shapes.size() < kWanted; ++i) {
    for (const stage::Prim& child : stage::Prim(queue[i]).children()) {
      if (child.is_a("Gprim")) {
        shapes.push_back(child.path());
      }
      queue.push_back(child);
    }
  }
  shapes.resize(std::min(shapes.size(), kWanted));
  return shapes;
}

std::string type_words(const stage::Prim& prim) {
  const std::string type = prim.type_name().str();
  return in_brackets(prim) + " is " + (type.empty() ? "a prim without a type" : "of type " + type);
}

/// Colliders are shapes; of those, meshes alone have an approximation.
MaybeReason no_collider(const PhysicsView& view, const stage::Prim& prim, const AssetEdit& edit) {
  if (edit.api != "PhysicsCollisionAPI" && property_of(edit) != "physics:approximation" &&
      property_of(edit) != "physics:collisionEnabled") {
    return std::nullopt;
  }
  if (object_at(view.scene.colliders, prim.path()) != nullptr) {
    return prim.is_a("Mesh") ? MaybeReason()
                             : Reason{type_words(prim) + ", and meshes alone are approximated",
                                      "leave the approximation out: a shape collides as it is"};
  }
  std::string fix;
  for (const Path shape : shapes_below(prim)) {
    fix += (fix.empty() ? "choose a shape below it: --collider " : ", ") + shape.str() + "=" +
           (edit.value.empty() ? "on" : edit.value);
  }
  return Reason{type_words(prim) + ", which is not a collider shape",
                fix.empty() ? "choose a shape: a Mesh, Cube, Sphere, Capsule or the like" : fix};
}

bool is_authored(const stage::Prim& prim, const char* name) {
  return prim && prim.attribute(name).has_authored_value();
}

/// The nearest body, which the prim may be.
stage::Prim body_of(const PhysicsView& view, stage::Prim prim) {
  while (prim && object_at(view.scene.bodies, prim.path()) == nullptr) {
    prim = prim.parent();
  }
  return prim;
}

bool is_mass_property(Token name) {
  constexpr std::array kNames{"physics:mass", "physics:density", "physics:centerOfMass",
                              "physics:diagonalInertia", "physics:principalAxes"};
  return std::find(kNames.begin(), kNames.end(), name.view()) != kNames.end();
}

/// Masses count for bodies and colliders, the weaker of two ways to say one not at all.
MaybeReason no_mass(const PhysicsView& view, const stage::Prim& prim, const AssetEdit& edit) {
  if (!is_mass_property(property_of(edit))) {
    return std::nullopt;
  }
  const stage::Prim body = body_of(view, prim);
  if (!body) {
    return Reason{in_brackets(prim) + " belongs to no body, and what stands still has no mass",
                  "apply PhysicsRigidBodyAPI to it or to a prim above it"};
  }
  const bool is_body = body.path() == prim.path();
  const bool is_collider = object_at(view.scene.colliders, prim.path()) != nullptr;
  if (property_of(edit) == "physics:density" && is_authored(prim, "physics:mass")) {
    return Reason{"its mass is authored, which a density does not change",
                  "tenon set ASSET --clear " + prim.path().str() + ".physics:mass"};
  }
  if (!is_body && is_collider && is_authored(body, "physics:mass")) {
    return Reason{"the mass of the body " + named(body.path(), RelatedRole::Body) +
                      " is authored and counts alone",
                  "set it there, or clear it: --clear " + body.path().str() + ".physics:mass"};
  }
  if (!is_body && !is_collider) {
    return Reason{in_brackets(prim) + " is neither a body nor a collider",
                  "set it on the body " + in_brackets(body)};
  }
  return std::nullopt;
}

MaybeReason no_material(const PhysicsView& view, const stage::Prim& prim, const AssetEdit& edit) {
  if (!begins(edit, "material:binding")) {
    return std::nullopt;
  }
  for (const Path target : prim.relationship(property_of(edit)).targets()) {
    const stage::Prim material = view.stage->prim(target);
    if (!material || !material.has_api("PhysicsMaterialAPI")) {
      return Reason{named(target, RelatedRole::Target) + " is no material of the physics",
                    "apply it: --apply " + target.str() + "=PhysicsMaterialAPI"};
    }
  }
  return Reason{"no collider is bound there, or one below has a binding of its own",
                "bind it at the collider"};
}

MaybeReason no_pair(const PhysicsView&, const stage::Prim& prim, const AssetEdit& edit) {
  if (property_of(edit) != "physics:filteredPairs") {
    return std::nullopt;
  }
  return Reason{"no collider of " + in_brackets(prim) + " could touch one of the others before",
                "tenon explain ASSET A B tells why two prims do not touch"};
}

MaybeReason no_object(const PhysicsView& view, const stage::Prim& prim, const AssetEdit& edit) {
  const bool of_joint = begins(edit, "drive:") || begins(edit, "limit:") ||
                        begins(edit, "newton:mimic") || begins(edit, "physxMimicJoint:") ||
                        property_of(edit) == "physics:lowerLimit" ||
                        property_of(edit) == "physics:upperLimit";
  if (of_joint && object_at(view.scene.joints, prim.path()) == nullptr) {
    return Reason{type_words(prim) + ", and no joint that engines receive",
                  "tenon tree --show physics lists the joints"};
  }
  return std::nullopt;
}

/// What readers say of the prim.
MaybeReason finding_of_prim(const PhysicsView& view, const AssetEdit& edit) {
  for (const Diagnostic& finding : view.findings) {
    if (finding.prim == edit.object.prim().str() && finding.property.empty() &&
        finding.severity == Severity::Error) {
      return Reason{said(finding), finding.fix};
    }
  }
  return std::nullopt;
}

Reason reason(const PhysicsView& view, const AssetEdit& edit) {
  for (const auto look : {finding_of_property, finding_of_winner, not_read}) {
    if (MaybeReason found = look(view, edit)) {
      return *found;
    }
  }
  const stage::Prim prim = view.stage->prim(edit.object.prim());
  for (const auto look : {no_collider, no_mass, no_material, no_pair, no_object}) {
    if (MaybeReason found = prim ? look(view, prim, edit) : MaybeReason()) {
      return *found;
    }
  }
  return finding_of_prim(view, edit)
      .value_or(Reason{
          "nothing that engines receive of <" + edit.object.prim().str() + ">" + " depends on it",
          "tenon explain ASSET " + edit.object.prim().str() + " tells what counts"});
}

}  // namespace

Diagnostic no_effect_finding(const PhysicsView& view, const AssetEdit& edit, bool in_view_alone) {
  Reason found = reason(view, edit);
  Diagnostic finding =
      view.stage->prim(edit.object.prim()).located(Severity::Error, "edit.no-effect", "");
  finding.say((edit.is_about_api() ? edit.api.str() : edit.object.name().str()) +
              " changes nothing that engines receive" +
              (in_view_alone ? " under Physics=" + view.variant : "") + ": " + found.why);
  finding.fix = std::move(found.fix);
  finding.property = property_of(edit).str();
  return finding;
}

}  // namespace tenon
