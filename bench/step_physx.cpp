// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// step_physx FILE [--chunk STEPS] [--chunks N]: steps the asset through tenon's interface and a
// second scene of PhysX like it through plain calls of simulate and fetchResults, chunk by chunk.
// Where targets of drives and kinematic bodies are animated the plain side sets those that a run
// before has recorded: what a program that calls PhysX itself would do. Count `difference`: largest
// difference of a place at the end [m]. Zero: both did the same; it is not where the adapter writes
// what PhysX does not know, such as springs beside drives.
#include <vector>

#include "bench/step_beside.h"
#include "tenon/engines/physx/physx_library.h"

namespace tenon::bench {
namespace {

::physx::PxScene& scene_of(const engines::Simulation& simulation) {
  return *const_cast<::physx::PxScene*>(
      static_cast<const ::physx::PxScene*>(simulation.engine_objects().model));
}

namespace px = ::physx;

/// What a program sets before each step: targets of drives, and where kinematic bodies go.
class Inputs {
 public:
  explicit Inputs(px::PxScene& scene) {
    std::vector<px::PxArticulationReducedCoordinate*> trees(scene.getNbArticulations());
    scene.getArticulations(trees.data(), static_cast<px::PxU32>(trees.size()));
    for (px::PxArticulationReducedCoordinate* tree : trees) {
      std::vector<px::PxArticulationLink*> links(tree->getNbLinks());
      tree->getLinks(links.data(), static_cast<px::PxU32>(links.size()));
      for (px::PxArticulationLink* link : links) {
        add_joint(link->getInboundJoint());
      }
    }
    const auto kind = px::PxActorTypeFlag::eRIGID_DYNAMIC;
    std::vector<px::PxActor*> actors(scene.getNbActors(kind));
    scene.getActors(kind, actors.data(), static_cast<px::PxU32>(actors.size()));
    for (px::PxActor* actor : actors) {
      auto* body = static_cast<px::PxRigidDynamic*>(actor);
      if (body->getRigidBodyFlags() & px::PxRigidBodyFlag::eKINEMATIC) {
        bodies_.push_back(body);
      }
    }
  }

  /// One more step, as it stands behind it.
  void record() {
    for (const auto& [joint, axis] : drives_) {
      targets_.push_back(joint->getDriveTarget(axis));
    }
    for (px::PxRigidDynamic* body : bodies_) {
      poses_.push_back(body->getGlobalPose());
    }
  }

  /// Before a step, what another scene like this one has recorded.
  void apply(const Inputs& recorded, std::size_t step) const {
    for (std::size_t i = 0; i < drives_.size(); ++i) {
      const float now = recorded.targets_[step * drives_.size() + i];
      if (step == 0 || now != recorded.targets_[(step - 1) * drives_.size() + i]) {
        drives_[i].joint->setDriveTarget(drives_[i].axis, now);
      }
    }
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      bodies_[i]->setKinematicTarget(recorded.poses_[step * bodies_.size() + i]);
    }
  }

 private:
  struct DrivenAxis {
    px::PxArticulationJointReducedCoordinate* joint = nullptr;
    px::PxArticulationAxis::Enum axis = px::PxArticulationAxis::eTWIST;
  };

  void add_joint(px::PxArticulationJointReducedCoordinate* joint) {
    for (int axis = 0; joint != nullptr && axis < px::PxArticulationAxis::eCOUNT; ++axis) {
      const auto each = static_cast<px::PxArticulationAxis::Enum>(axis);
      if (joint->getMotion(each) != px::PxArticulationMotion::eLOCKED) {
        drives_.push_back({joint, each});
      }
    }
  }

  std::vector<DrivenAxis> drives_;
  std::vector<px::PxRigidDynamic*> bodies_;
  std::vector<float> targets_;          // (step_count x drive_count)
  std::vector<px::PxTransform> poses_;  // (step_count x body_count)
};

Inputs record_inputs(const SimulationPtr& simulation, std::size_t steps) {
  Inputs inputs(scene_of(*simulation));
  for (std::size_t i = 0; i < steps; ++i) {
    step(*simulation);
    inputs.record();
  }
  return inputs;
}

void time_steps(Report& report, const scene::PhysicsScene& scene, const StepOptions& options) {
  const SimulationPtr before = make("physx", scene);
  const Inputs recorded = record_inputs(before, options.chunk * options.chunks);
  const SimulationPtr simulation = make("physx", scene);
  const SimulationPtr plain = make("physx", scene);
  px::PxScene& stepped = scene_of(*plain);
  const Inputs inputs(stepped);
  std::size_t plain_step = 0;
  const auto dt = static_cast<float>(plain->time_step());
  Laps laps;
  laps.ours = [&] { steps(*simulation, options.chunk); };
  laps.theirs = [&] {
    for (std::size_t i = 0; i < options.chunk; ++i, ++plain_step) {
      inputs.apply(recorded, plain_step);
      stepped.simulate(dt);
      stepped.fetchResults(true);
    }
  };
  time_in_turns(report, options.chunks, laps);
  report.count("difference", difference(scene, *simulation, *plain));
}

}  // namespace
}  // namespace tenon::bench

int main(int count, char** values) {
  return tenon::bench::step_beside("step_physx", count, values, tenon::bench::time_steps);
}
