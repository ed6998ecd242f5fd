// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// step_physx FILE [--chunk STEPS] [--chunks N]: steps the asset through tenon's interface and a
// second scene of PhysX like it through plain calls of simulate and fetchResults, chunk by chunk.
// Where targets of drives and kinematic bodies are animated the plain side sets those that a run
// before has recorded: what a program that calls PhysX itself would do. Count `difference`: largest
// difference of a place at the end [m]. Zero: both did the same; it is not where the adapter writes
// what PhysX does not know, such as springs beside drives.
#include <algorithm>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "bench/measure.h"
#include "tenon/engines/physx/physx_library.h"
#include "tenon/engines/simulation.h"
#include "tenon/make_simulation.h"
#include "tenon/open_stage.h"
#include "tenon/physics/read_physics.h"

namespace tenon::bench {
namespace {

struct Options {
  std::string file;
  std::size_t chunk = 200;  // steps of one lap
  std::size_t chunks = 40;
};

Options read_options(int count, char** values) {
  Options options;
  for (int i = 1; i < count; ++i) {
    const std::string word = values[i];
    if ((word == "--chunk" || word == "--chunks") && i + 1 < count) {
      (word == "--chunk" ? options.chunk : options.chunks) = std::strtoul(values[++i], nullptr, 10);
    } else {
      options.file = word;
    }
  }
  if (options.file.empty() || options.chunk == 0 || options.chunks == 0) {
    fail("usage: step_physx FILE [--chunk STEPS] [--chunks N]");
  }
  return options;
}

using SimulationPtr = std::unique_ptr<engines::Simulation>;

SimulationPtr make(const scene::PhysicsScene& scene) {
  Diagnostics diagnostics;
  return value_or_fail(make_simulation("physx", scene, {}, diagnostics));
}

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

void step(engines::Simulation& simulation) {
  if (auto done = simulation.step(); !done) {
    fail(done.error().to_string());
  }
}

Inputs record_inputs(const SimulationPtr& simulation, std::size_t steps) {
  Inputs inputs(scene_of(*simulation));
  for (std::size_t i = 0; i < steps; ++i) {
    step(*simulation);
    inputs.record();
  }
  return inputs;
}

double difference(const scene::PhysicsScene& scene, const engines::Simulation& one,
                  const engines::Simulation& other) {
  double largest = 0;
  for (scene::Index b = 0; b < scene.bodies.size(); ++b) {
    const Vec3d apart = one.body_state(b).pose.position - other.body_state(b).pose.position;
    largest = std::max(largest, length(apart));
  }
  return largest;
}

void time_steps(Report& report, const scene::PhysicsScene& scene, const Options& options) {
  const SimulationPtr before = make(scene);
  const Inputs recorded = record_inputs(before, options.chunk * options.chunks);
  const SimulationPtr simulation = make(scene);
  const SimulationPtr plain = make(scene);
  px::PxScene& stepped = scene_of(*plain);
  const Inputs inputs(stepped);
  std::size_t plain_step = 0;
  const auto dt = static_cast<float>(plain->time_step());
  const auto ours = [&] {
    for (std::size_t i = 0; i < options.chunk; ++i) {
      step(*simulation);
    }
    return true;
  };
  const auto theirs = [&] {
    for (std::size_t i = 0; i < options.chunk; ++i, ++plain_step) {
      inputs.apply(recorded, plain_step);
      stepped.simulate(dt);
      stepped.fetchResults(true);
    }
    return true;
  };
  for (std::size_t i = 0; i < options.chunks; ++i) {
    if (i % 2 == 0) {  // neither side is always the first
      report.time("tenon", ours);
      report.time("plain", theirs);
    } else {
      report.time("plain", theirs);
      report.time("tenon", ours);
    }
  }
  report.count("difference", difference(scene, *simulation, *plain));
}

}  // namespace
}  // namespace tenon::bench

int main(int count, char** values) {
  using namespace tenon;
  using namespace tenon::bench;
  const Options options = read_options(count, values);
  Diagnostics diagnostics;
  const stage::Stage stage = value_or_fail(open_stage(options.file, {}, diagnostics));
  const scene::PhysicsScene scene = physics::read_physics(stage, {}, diagnostics);
  Report report("step_physx");
  time_steps(report, scene, options);
  report.count("steps_per_lap", static_cast<double>(options.chunk));
  report.count("bodies", static_cast<double>(scene.bodies.size()));
  report.print();
  return 0;
}
