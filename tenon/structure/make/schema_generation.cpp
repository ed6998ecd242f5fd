// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Both generations of mimics say q = offset + multiplier * leader. PhysX has all terms on one side,
// hence the opposite signs. An old schema goes when the new one says what counts of it, else both
// stay and a finding says why. Each view is migrated by itself first. Then a law that came from a
// schema of PhysX is given to all variants that have both joints and no law of their own, because
// Newton's schema is for every engine.
#include "tenon/structure/make/schema_generation.h"

#include <algorithm>
#include <optional>
#include <set>

#include "tenon/base/file_finding.h"
#include "tenon/layer/fields.h"
#include "tenon/physics/attribute_values.h"
#include "tenon/schema/registry.h"
#include "tenon/structure/layer_tree.h"

namespace tenon::structure {
namespace {

namespace fields = layer::fields;
using layer::Layer;
using layer::Spec;
using layer::Value;

constexpr const char* kNewtonMimic = "NewtonMimicAPI";
constexpr const char* kPhysxJoint = "PhysxJointAPI";

/// q = offset + multiplier * leader, in the stage's units.
struct MimicLaw {
  double offset = 0;
  double multiplier = 1;
  Path leader;
};

/// Removes an API schema and all that it declares.
void remove(Layer& content, Path prim, Token api) {
  std::vector<Token> apis = apis_of(content, prim);
  std::erase(apis, api);
  set_apis(make_prim(content, prim), std::move(apis));
  const schema::PrimDefinition definition(Token(), {api});
  for (const Path property : properties_of(content, prim)) {
    if (definition.find(property.name()) != nullptr) {
      remove_property(content, property);
    }
  }
}

/// An empty property as the schema declares it.
Spec declared(Token api, Token property) {
  const schema::PrimDefinition definition(Token(), {api});
  const schema::PropertyDefinition* known = definition.find(property);
  Spec spec;
  const bool relationship = known != nullptr && known->is_relationship;
  spec.kind = relationship ? layer::SpecKind::Relationship : layer::SpecKind::Attribute;
  spec.set(fields::custom, false);
  if (known != nullptr && !relationship) {
    spec.set(fields::typeName, Value(known->type_name));
    spec.set(fields::variability, Value(known->variability));
  }
  return spec;
}

/// Vendors declare these numbers as floats.
void set_number(Layer& content, Path prim, Token api, const std::string& name, double value) {
  Spec spec = declared(api, Token(name));
  spec.set(fields::default_value, Value(static_cast<float>(value)));
  put_property(content, prim.property(Token(name)), spec);
}

void set_leader(Layer& content, Path prim, Token api, const std::string& name, Path leader) {
  Spec spec = declared(api, Token(name));
  set_targets(spec, {leader});
  put_property(content, prim.property(Token(name)), spec);
}

double number(const Layer& content, Path prim, const std::string& name, double fallback) {
  const Spec* spec = content.find(prim.property(Token(name)));
  const Value* value = spec == nullptr ? nullptr : spec->find(fields::default_value);
  return value == nullptr ? fallback : physics::number_of(*value).value_or(fallback);
}

Path leader_of(const Layer& content, Path prim, const std::string& name) {
  const Spec* spec = content.find(prim.property(Token(name)));
  const std::vector<Path> targets = spec == nullptr ? std::vector<Path>() : targets_of(*spec);
  return targets.size() == 1 ? targets.front() : Path();
}

bool has_samples(const Layer& content, Path prim, std::string_view prefix) {
  const std::vector<Path> properties = properties_of(content, prim);
  return std::any_of(properties.begin(), properties.end(), [&](Path property) {
    return property.name().view().starts_with(prefix) &&
           content.find(property)->has(fields::timeSamples);
  });
}

/// "angular" or "linear"; empty for joints of no or of several axes.
std::string axis_of(const Layer& content, Path prim) {
  const Token type = type_of(content, prim);
  return type == "PhysicsRevoluteJoint"    ? "angular"
         : type == "PhysicsPrismaticJoint" ? "linear"
                                           : "";
}

/// "rotX" for a joint that turns about X, and about an axis that there is not (as physics are
/// read). PhysX wants it of sliding joints too, where it has no meaning.
std::string rotation_axis(const Layer& content, Path prim) {
  const Spec* spec = content.find(prim.property("physics:axis"));
  const Token axis = spec == nullptr ? Token() : spec->get_or(fields::default_value, Token());
  return axis == "Y" ? "rotY" : axis == "Z" ? "rotZ" : "rotX";
}

/// The instances that PhysxMimicJointAPI is applied with.
std::vector<std::string> physx_mimics(const Layer& content, Path prim) {
  std::vector<std::string> instances;
  for (const Token api : apis_of(content, prim)) {
    const auto [name, instance] = schema::split_api_name(api);
    if (name == "PhysxMimicJointAPI" && !instance.empty()) {
      instances.push_back(instance.str());
    }
  }
  return instances;
}

class Migration {
 public:
  Migration(SourceViews& views, SchemaGeneration generation, Diagnostics& diagnostics)
      : views_(views), generation_(generation), diagnostics_(diagnostics) {}

  std::set<std::string> run() {
    for (SourceView& view : views_.physics) {
      migrate(view.content);
    }
    for (OtherVariant& other : views_.others) {
      migrate(other.content);
    }
    for (const auto& [joint, law] : laws_) {
      share(joint, law);
    }
    return std::move(widened_);
  }

 private:
  bool to_current() const { return generation_ != SchemaGeneration::Legacy; }
  bool to_legacy() const { return generation_ != SchemaGeneration::Current; }

  void note(const char* rule, Path prim, std::string message) {
    if (noted_.emplace(prim, message).second) {
      Diagnostic finding = file_finding(Severity::Info, rule, std::move(message), "");
      finding.prim = prim.str();
      diagnostics_.add(std::move(finding));
    }
  }
  void note_kept(Path prim, const std::string& what, const std::string& why) {
    note("structure.schema-kept", prim, what + " stays in the schema that it is in: " + why);
  }

  void migrate(Layer& content) {
    for (const Path prim : prims_below(content)) {
      const std::vector<std::string> mimics = physx_mimics(content, prim);
      const bool physx_joint = has_api(content, prim, kPhysxJoint);
      const bool newton = has_api(content, prim, kNewtonMimic);
      const std::string axis = axis_of(content, prim);
      const bool physx_axis = !axis.empty() && has_api(content, prim, "PhysxJointAxisAPI:" + axis);
      if (axis.empty() && (!mimics.empty() || physx_joint)) {
        note_kept(prim, "what PhysX has on it", "the joint has not one axis");
        continue;
      }
      if (to_current() && !mimics.empty()) {
        physx_mimic_to_newton(content, prim, mimics.front());
      }
      if (to_current() && physx_joint) {
        joint_to_axis(content, prim, axis);
      }
      if (to_legacy() && newton && mimics.empty()) {
        newton_mimic_to_physx(content, prim);
      }
      if (to_legacy() && physx_axis) {
        axis_to_joint(content, prim, axis);
      }
    }
  }

  void physx_mimic_to_newton(Layer& content, Path prim, const std::string& instance) {
    const std::string prefix = "physxMimicJoint:" + instance + ":";
    const Path leader = leader_of(content, prim, prefix + "referenceJoint");
    if (leader.empty() || has_samples(content, prim, prefix)) {
      note_kept(prim, "PhysxMimicJointAPI", "it has not one reference joint, or has samples");
      return;
    }
    if (!has_api(content, prim, kNewtonMimic)) {
      const MimicLaw law{-number(content, prim, prefix + "offset", 0),
                         -number(content, prim, prefix + "gearing", 1), leader};
      put_law(content, prim, law);
      laws_.emplace(prim, law);
    }
    const bool compliant = number(content, prim, prefix + "naturalFrequency", 0) > 0 &&
                           number(content, prim, prefix + "dampingRatio", 0) > 0;
    if (compliant) {
      note_kept(prim, "PhysxMimicJointAPI", "NewtonMimicAPI beside it knows no compliance");
    } else if (!to_legacy()) {
      remove(content, prim, Token("PhysxMimicJointAPI:" + instance));
    }
  }

  static void put_law(Layer& content, Path prim, const MimicLaw& law) {
    const Token api(kNewtonMimic);
    add_api(content, prim, api);
    set_number(content, prim, api, "newton:mimicCoef0", law.offset);
    set_number(content, prim, api, "newton:mimicCoef1", law.multiplier);
    set_leader(content, prim, api, "newton:mimicJoint", law.leader);
  }

  /// The law in every variant that has both joints and none of its own.
  void share(Path joint, const MimicLaw& law) {
    for (SourceView& view : views_.physics) {
      Layer& content = view.content;
      const bool there = content.has(joint) && content.has(law.leader) && is_active(content, joint);
      if (there && !has_api(content, joint, kNewtonMimic) && physx_mimics(content, joint).empty()) {
        put_law(content, joint, law);
        widened_.insert(view.variant);
        note("structure.mimic-in-all", joint,
             "NewtonMimicAPI is for every engine: the joint now follows in all variants");
      }
    }
  }

  void newton_mimic_to_physx(Layer& content, Path prim) {
    const Path leader = leader_of(content, prim, "newton:mimicJoint");
    const bool enabled = [&] {
      const Spec* spec = content.find(prim.property("newton:mimicEnabled"));
      return spec == nullptr || spec->get_or(fields::default_value, true);
    }();
    if (leader.empty() || !enabled || has_samples(content, prim, "newton:mimic")) {
      note_kept(prim, kNewtonMimic, "it has not one leader, is switched off, or has samples");
      return;
    }
    const std::string instance = rotation_axis(content, prim);
    const std::string prefix = "physxMimicJoint:" + instance + ":";
    const Token api("PhysxMimicJointAPI:" + instance);
    add_api(content, prim, api);
    set_number(content, prim, api, prefix + "gearing",
               -number(content, prim, "newton:mimicCoef1", 1));
    set_number(content, prim, api, prefix + "offset",
               -number(content, prim, "newton:mimicCoef0", 0));
    set_leader(content, prim, api, prefix + "referenceJoint", leader);
    Spec axis = declared(api, Token(prefix + "referenceJointAxis"));
    axis.set(fields::default_value, Value(Token(rotation_axis(content, leader))));
    put_property(content, prim.property(Token(prefix + "referenceJointAxis")), axis);
    if (!to_current() && !has_api(content, prim, "MjcEqualityJointAPI")) {
      note_kept(prim, kNewtonMimic, "other engines read no mimic of PhysX's");
    }
  }

  /// Copies a number with all that is said about it, where the other schema says nothing yet.
  static void copy(Layer& content, Path prim, const std::string& from, Token api,
                   const std::string& to) {
    const Spec* known = content.find(prim.property(Token(from)));
    if (known != nullptr && !content.has(prim.property(Token(to)))) {
      const Spec spec = *known;
      add_api(content, prim, api);
      put_property(content, prim.property(Token(to)), spec);
    }
  }

  void joint_to_axis(Layer& content, Path prim, const std::string& axis) {
    const Token api("PhysxJointAxisAPI:" + axis);
    for (const char* name : {"armature", "maxJointVelocity"}) {
      copy(content, prim, std::string("physxJoint:") + name, api,
           "physxJointAxis:" + axis + ":" + name);
    }
    if (number(content, prim, "physxJoint:jointFriction", 0) != 0 ||
        has_samples(content, prim, "physxJoint:jointFriction")) {
      note_kept(prim, "physxJoint:jointFriction", "a coefficient without unit is not an effort");
    } else if (!to_legacy()) {
      remove(content, prim, Token(kPhysxJoint));
    }
  }

  void axis_to_joint(Layer& content, Path prim, const std::string& axis) {
    const std::string prefix = "physxJointAxis:" + axis + ":";
    for (const char* name : {"armature", "maxJointVelocity"}) {
      copy(content, prim, prefix + name, Token(kPhysxJoint), std::string("physxJoint:") + name);
    }
    bool friction = false;
    for (const char* name :
         {"staticFrictionEffort", "dynamicFrictionEffort", "viscousFrictionCoefficient"}) {
      friction = friction || number(content, prim, prefix + name, 0) != 0 ||
                 has_samples(content, prim, prefix + name);
    }
    if (friction) {
      note_kept(prim, "PhysxJointAxisAPI:" + axis, "PhysxJointAPI knows no effort of friction");
    } else if (!to_current()) {
      remove(content, prim, Token("PhysxJointAxisAPI:" + axis));
    }
  }

  SourceViews& views_;
  SchemaGeneration generation_;
  Diagnostics& diagnostics_;
  std::map<Path, MimicLaw> laws_;
  std::set<std::pair<Path, std::string>> noted_;
  std::set<std::string> widened_;
};

}  // namespace

std::set<std::string> use_generation(SourceViews& views, SchemaGeneration generation,
                                     Diagnostics& diagnostics) {
  if (generation == SchemaGeneration::AsAuthored) {
    return {};
  }
  return Migration(views, generation, diagnostics).run();
}

}  // namespace tenon::structure
