// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// One PxScene for each scene of the asset: they share nothing. Steps run on the thread that asks
// for them, in an order that bodies elsewhere do not change.
#include "tenon/engines/physx/build/settings.h"
#include "tenon/engines/physx/run/pair_filter.h"

namespace tenon::engines::physx {
namespace {

px::PxCombineMode::Enum mode_of(scene::CombineMode mode) {
  switch (mode) {
    case scene::CombineMode::Average:
      return px::PxCombineMode::eAVERAGE;
    case scene::CombineMode::Min:
      return px::PxCombineMode::eMIN;
    case scene::CombineMode::Multiply:
      return px::PxCombineMode::eMULTIPLY;
    case scene::CombineMode::Max:
      break;
  }
  return px::PxCombineMode::eMAX;
}

// A contact that gives way has its stiffness where others have their restitution.
px::PxMaterial* make_material(Build& build, const scene::Material& source) {
  px::PxMaterial* made = build.model.owned.add(build.runtime.physics->createMaterial(
      to_px(source.static_friction), to_px(source.dynamic_friction), to_px(source.restitution)));
  made->setFrictionCombineMode(mode_of(source.friction_combine));
  made->setRestitutionCombineMode(mode_of(source.restitution_combine));
  if (source.compliance.stiffness > 0 && !source.compliance.acceleration) {
    made->setFlag(px::PxMaterialFlag::eCOMPLIANT_CONTACT, true);
    made->setRestitution(-to_px(source.compliance.stiffness));
    made->setDamping(to_px(source.compliance.damping));
  } else if (source.compliance.stiffness > 0) {
    build.report(source.path, "compliantContactAccelerationSpring",
                 "contacts of PhysX 5.1 are springs by force alone");
  }
  return made;
}

/// For one collider alone; the model owns it.
px::PxMaterial* copy_of(const px::PxMaterial& source, Model& model) {
  px::PxPhysics& physics = *(*open_physx())->physics;
  px::PxMaterial* made = model.owned.add(
      physics.createMaterial(source.getStaticFriction(), source.getDynamicFriction(), 0));
  made->setFlags(source.getFlags());
  made->setRestitution(source.getRestitution());
  made->setFrictionCombineMode(source.getFrictionCombineMode());
  made->setRestitutionCombineMode(source.getRestitutionCombineMode());
  made->setDamping(source.getDamping());
  return made;
}

}  // namespace

Result<void> add_scenes(Build& build) {
  build.model.pairs = std::make_unique<PairRules>();
  build.model.pairs->scene = &build.scene;
  build.model.pairs->report_contacts = needs_contacts(build.options.outputs);
  const PairRulesLink link{build.model.pairs.get()};
  for (const scene::Scene& source : build.scene.scenes) {
    px::PxSceneDesc wanted(build.runtime.physics->getTolerancesScale());
    wanted.gravity = to_px(source.gravity);
    wanted.cpuDispatcher = build.runtime.dispatcher;
    wanted.filterShader = filter_pair;
    wanted.filterShaderData = &link;
    wanted.filterShaderDataSize = sizeof link;
    wanted.kineKineFilteringMode = px::PxPairFilteringMode::eKEEP;
    wanted.staticKineFilteringMode = px::PxPairFilteringMode::eKEEP;
    set_solver(build, static_cast<scene::Index>(build.model.scenes.size()), wanted);
    px::PxScene* made = build.model.owned.add_scene(build.runtime.physics->createScene(wanted));
    if (made == nullptr) {
      return Error(ErrorCode::Invalid, "PhysX makes no scene").with_rule("physx.refused");
    }
    build.model.scenes.push_back(made);
  }
  return {};
}

bool set_friction(const scene::PhysicsScene& scene, scene::Index collider, double coefficient,
                  Model& model) {
  const std::vector<px::PxShape*>& shapes = model.shapes[collider];
  for (px::PxShape* shape : shapes) {
    std::vector<px::PxMaterial*> materials(shape->getNbMaterials());
    shape->getMaterials(materials.data(), static_cast<px::PxU32>(materials.size()));
    for (px::PxMaterial*& material : materials) {
      if (material->userData != shape) {
        material = copy_of(*material, model);
        material->userData = shape;
      }
      material->setStaticFriction(to_px(coefficient));
      material->setDynamicFriction(to_px(coefficient));
    }
    shape->setMaterials(materials.data(), static_cast<px::PxU16>(materials.size()));
  }
  if (!shapes.empty()) {  // pairs that touch already look at their materials again
    px::PxRigidActor& actor = *shapes.front()->getActor();
    model.scenes[scene.colliders[collider].scene]->resetFiltering(
        actor, shapes.data(), static_cast<px::PxU32>(shapes.size()));
  }
  return !shapes.empty();
}

void add_materials(Build& build) {
  for (const scene::Material& material : build.scene.materials) {
    build.materials.push_back(make_material(build, material));
  }
  build.materials.push_back(make_material(build, build.scene.unbound));
}

}  // namespace tenon::engines::physx
