// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Coordinates are read off the relative poses of joint frames; what they cannot express is reported
// (S-90), and an authored joint position replaces them. Velocities are those that the joints make
// of the bodies' own (fit_velocities). A tree takes coordinates and speeds once it is in its scene,
// and puts its links where they belong.
#include "tenon/engines/physx/build/build.h"
#include "tenon/engines/start_coordinates.h"
#include "tenon/scene/motion/fit_velocities.h"
#include "tenon/scene/start_coordinate.h"

namespace tenon::engines::physx {
namespace {

using scene::Index;

/// The place of each coordinate in the cache of its tree: links in PhysX's order, joint by joint.
void number_coordinates(Model& model) {
  std::vector<std::vector<int>> first(model.trees.size());
  for (std::size_t t = 0; t < model.trees.size(); ++t) {
    px::PxArticulationReducedCoordinate& tree = *model.trees[t].articulation;
    std::vector<px::PxArticulationLink*> links(tree.getNbLinks());
    tree.getLinks(links.data(), static_cast<px::PxU32>(links.size()));
    std::vector<int> dofs(links.size(), 0);
    for (px::PxArticulationLink* link : links) {
      dofs[link->getLinkIndex()] =
          link->getInboundJoint() == nullptr ? 0 : static_cast<int>(link->getInboundJointDof());
    }
    first[t].assign(links.size(), 0);
    for (std::size_t i = 1; i < links.size(); ++i) {
      first[t][i] = first[t][i - 1] + dofs[i - 1];
    }
  }
  for (JointMap& map : model.joints) {
    if (map.role == JointRole::Reduced && (map.dofs.ball || !map.dofs.free.empty())) {
      map.coordinate = first[map.tree][map.link_joint->getChildArticulationLink().getLinkIndex()];
    }
  }
}

void insert(Build& build) {
  Model& model = build.model;
  for (Index c = 0; c < model.static_actors.size(); ++c) {
    if (model.static_actors[c] != nullptr) {
      model.scenes[build.scene.colliders[c].scene]->addActor(*model.static_actors[c]);
    }
  }
  for (Index b = 0; b < model.bodies.size(); ++b) {
    if (!model.is_link(b)) {
      model.scenes[build.scene.bodies[b].scene]->addActor(*model.bodies[b]);
    }
  }
  for (ReducedTree& tree : model.trees) {
    model.scenes[tree.scene]->addArticulation(*tree.articulation);
    tree.cache = model.owned.add_cache(build.runtime, tree.articulation->createCache());
  }
  number_coordinates(model);
}

void set_ball(const JointMap& map, const Pose& relative, px::PxReal* positions) {
  // Twist about x and swings about y and z, as PhysX splits a ball's rotation.
  const Pose of_child = map.reversed ? inverse(relative) : relative;
  const Vec3d turn = rotation_vector(of_child.orientation);
  for (int i = 0; i < 3; ++i) {
    positions[map.coordinate + i] = to_px(turn[static_cast<std::size_t>(i)]);
  }
}

bool is_coordinate(const JointMap& map, std::size_t tree) {
  return map.role == JointRole::Reduced && map.tree == tree && map.coordinate >= 0;
}

// Puts the links of a tree where its coordinates say.
void place_tree(Build& build, std::size_t tree) {
  ReducedTree& made = build.model.trees[tree];
  made.articulation->zeroCache(*made.cache);
  for (Index j = 0; j < build.model.joints.size(); ++j) {
    const JointMap& map = build.model.joints[j];
    if (!is_coordinate(map, tree)) {
      continue;
    }
    const scene::Joint& joint = build.scene.joints[j];
    if (map.dofs.ball) {
      set_ball(map, relative_frames(build.scene, joint), made.cache->jointPosition);
    } else {
      made.cache->jointPosition[map.coordinate] =
          to_px(start_coordinates(build.scene, joint, map.dofs, build.diagnostics).front());
    }
  }
  px::PxArticulationLink* root = nullptr;
  made.articulation->getLinks(&root, 1);
  made.cache->rootLinkData->transform = root->getGlobalPose();
  px::PxArticulationCacheFlags flags = px::PxArticulationCacheFlag::ePOSITION;
  flags |= px::PxArticulationCacheFlag::eROOT_TRANSFORM;
  made.articulation->applyCache(*made.cache, flags);
}

// The diagonal of the mass matrix, which PhysX makes without armatures.
void note_inertias(Build& build, std::size_t tree) {
  const ReducedTree& made = build.model.trees[tree];
  made.articulation->commonInit();
  made.articulation->computeGeneralizedMassMatrix(*made.cache);
  const std::size_t count = made.articulation->getDofs();
  for (Index j = 0; j < build.model.joints.size(); ++j) {
    JointMap& map = build.model.joints[j];
    if (is_coordinate(map, tree) && !map.dofs.ball) {
      const auto place = static_cast<std::size_t>(map.coordinate);
      map.inertia = static_cast<double>(made.cache->massMatrix[place * count + place]) +
                    build.scene.joints[j].armature;
    }
  }
}

void start_tree(Build& build, std::size_t tree, const scene::FittedVelocities& fitted) {
  ReducedTree& made = build.model.trees[tree];
  for (Index j = 0; j < build.model.joints.size(); ++j) {
    const JointMap& map = build.model.joints[j];
    const std::size_t count = is_coordinate(map, tree) ? fitted.joints[j].size() : 0;
    for (std::size_t i = 0; i < count; ++i) {
      const double speed = fitted.joints[j][i];
      made.cache->jointVelocity[map.coordinate + static_cast<int>(i)] =
          to_px(map.dofs.ball && map.reversed ? -speed : speed);
    }
  }
  px::PxArticulationLink* root = nullptr;
  made.articulation->getLinks(&root, 1);
  if (const std::optional<Index> body = body_of(*root)) {
    made.cache->rootLinkData->worldLinVel = to_px(fitted.bodies[*body].linear_velocity);
    made.cache->rootLinkData->worldAngVel = to_px(fitted.bodies[*body].angular_velocity);
  }
  px::PxArticulationCacheFlags flags = px::PxArticulationCacheFlag::eVELOCITY;
  flags |= px::PxArticulationCacheFlag::eROOT_VELOCITIES;
  made.articulation->applyCache(*made.cache, flags);
}

/// Bodies where their coordinates have put them, with the velocities that they are to have alone.
std::vector<scene::BodyState> placed_states(const Build& build, Begin begin) {
  std::vector<scene::BodyState> states = scene::states_at_start(build.scene, build.model.time_step);
  for (Index b = 0; b < states.size(); ++b) {
    if (build.model.is_link(b)) {
      states[b].pose = from_px(build.model.bodies[b]->getGlobalPose());
    }
    if (begin == Begin::Middle) {
      states[b].linear_velocity = build.scene.bodies[b].linear_velocity;
      states[b].angular_velocity = build.scene.bodies[b].angular_velocity;
    }
  }
  return states;
}

/// A vector without the world axes of a mask: 1 x, 2 y, 4 z.
Vec3d without(Vec3d vector, int axes) {
  for (std::size_t i = 0; i < 3; ++i) {
    vector[i] = (axes >> i & 1) != 0 ? 0 : vector[i];
  }
  return vector;
}

void start_free_bodies(Build& build, const scene::FittedVelocities& fitted) {
  for (Index b = 0; b < build.model.bodies.size(); ++b) {
    const scene::Body& body = build.scene.bodies[b];
    if (build.model.is_link(b) || body.kinematic) {
      continue;
    }
    auto& actor = static_cast<px::PxRigidDynamic&>(*build.model.bodies[b]);
    // PhysX holds what is locked against forces, and lets it keep the velocity that it has.
    const scene::BodySettings& settings = body.settings;
    actor.setLinearVelocity(
        to_px(without(fitted.bodies[b].linear_velocity, settings.locked_translation)));
    actor.setAngularVelocity(
        to_px(without(fitted.bodies[b].angular_velocity, settings.locked_rotation)));
  }
}

// Of bodies that the asset lets sleep; a tree sleeps as a whole.
void put_to_sleep(Build& build) {
  for (Index b = 0; b < build.model.bodies.size(); ++b) {
    const scene::Body& body = build.scene.bodies[b];
    if (!body.starts_asleep || body.kinematic) {
      continue;
    }
    if (build.model.is_link(b)) {
      static_cast<px::PxArticulationLink*>(build.model.bodies[b])->getArticulation().putToSleep();
    } else {
      static_cast<px::PxRigidDynamic*>(build.model.bodies[b])->putToSleep();
    }
  }
}

std::vector<scene::JointDofs> dofs_of(const Model& model) {
  std::vector<scene::JointDofs> dofs;
  for (const JointMap& map : model.joints) {
    dofs.push_back(map.dofs);
  }
  return dofs;
}

}  // namespace

void start(Build& build, Begin begin) {
  insert(build);
  for (std::size_t t = 0; t < build.model.trees.size(); ++t) {
    place_tree(build, t);
    note_inertias(build, t);
  }
  const std::vector<scene::BodyState> states = placed_states(build, begin);
  if (scene::anything_moves(build.scene, states)) {
    const auto links =
        begin == Begin::Start ? scene::LinkVelocities::OfJoints : scene::LinkVelocities::Own;
    const scene::FittedVelocities fitted =
        fit_velocities(build.scene, build.forest, dofs_of(build.model), states, links);
    for (std::size_t t = 0; t < build.model.trees.size(); ++t) {
      start_tree(build, t, fitted);
    }
    start_free_bodies(build, fitted);
    report_lost_energy(build.scene, fitted, build.diagnostics);
  }
  if (begin == Begin::Start) {
    put_to_sleep(build);
  }
}

}  // namespace tenon::engines::physx
