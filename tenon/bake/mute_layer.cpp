// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/bake/mute_layer.h"

#include <vector>

#include "tenon/bake/over_specs.h"

namespace tenon::bake {
namespace {

class Muter {
 public:
  Muter(layer::Layer& layer, Diagnostics& diagnostics) : layer_(layer), diagnostics_(diagnostics) {}

  MuteCounts run(const stage::Stage& stage) {
    std::vector<stage::Prim> pending{stage.pseudo_root()};
    while (!pending.empty()) {
      const stage::Prim prim = pending.back();
      pending.pop_back();
      if (!prim.is_pseudo_root()) {
        visit(prim);
      }
      const std::vector<stage::Prim> children = prim.children();
      pending.insert(pending.end(), children.rbegin(), children.rend());
    }
    return counts_;
  }

 private:
  void visit(const stage::Prim& prim) {
    if (prim.has_api("PhysicsRigidBodyAPI")) {
      mute(prim, "physics:rigidBodyEnabled", counts_.bodies);
    }
    if (prim.has_api("PhysicsCollisionAPI")) {
      mute(prim, "physics:collisionEnabled", counts_.colliders);
    }
    if (prim.is_a("PhysicsJoint")) {
      mute(prim, "physics:jointEnabled", counts_.joints);
    }
  }

  void mute(const stage::Prim& prim, const char* flag, std::size_t& count) {
    const Token name(flag);
    const stage::Attribute attribute = prim.attribute(name);
    const bool off = !attribute.get_as<bool>().value_or(true) && !attribute.is_animated();
    if (off) {
      return;
    }
    if (prim.is_instance_proxy()) {
      ++counts_.out_of_reach;
      Diagnostic finding = prim.located(
          Severity::Warning, "strip.in-instance",
          "the prim is inside an instance: " + name.str() + " cannot be switched off on it");
      finding.prim = prim.path().str();
      finding.fix = "make the instance not instanceable, or mute the asset that it refers to";
      diagnostics_.add(std::move(finding));
      return;
    }
    layer::Spec* spec = layer_.find(prim.path().property(name));
    if (spec == nullptr) {
      layer::Spec& made = over_attribute(layer_, prim.path(), name, Token("bool"));
      made.set(layer::fields::custom, layer::Value(false));
      made.set(layer::fields::variability, layer::Value(layer::Variability::Varying));
      spec = &made;
    }
    spec->erase(Token("timeSamples"));
    spec->set(layer::fields::default_value, layer::Value(false));
    ++count;
  }

  layer::Layer& layer_;
  Diagnostics& diagnostics_;
  MuteCounts counts_;
};

}  // namespace

MuteCounts mute_physics(const stage::Stage& stage, layer::Layer& layer, Diagnostics& diagnostics) {
  return Muter(layer, diagnostics).run(stage);
}

}  // namespace tenon::bake
