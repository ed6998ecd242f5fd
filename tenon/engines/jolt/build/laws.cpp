// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// All that acts along a coordinate is a term of its law: bounds, drives, the joint's own spring and
// damper, friction, armature, speed limits.
#include <algorithm>
#include <cmath>

#include "tenon/engines/jolt/build/build.h"
#include "tenon/engines/start_coordinates.h"
#include "tenon/scene/joint_freedom.h"

namespace tenon::engines::jolt {
namespace {

using scene::Dof;
using scene::Index;
using scene::Joint;

void add_bounds(const Joint& joint, const scene::FreeDof& dof, std::vector<LawTerm>& terms) {
  LawTerm term;
  for (const scene::LimitSpring& spring : joint.limit_springs) {
    if (spring.dof == dof.dof) {
      term.stiffness = spring.stiffness;
      term.damping = spring.damping;
      term.restitution = spring.restitution;
      term.bounce_threshold = spring.bounce_threshold;
    }
  }
  if (dof.lower > -scene::kUnlimited) {
    term.kind = TermKind::Lower;
    term.target_position = dof.lower;
    terms.push_back(term);
  }
  if (dof.upper < scene::kUnlimited) {
    term.kind = TermKind::Upper;
    term.target_position = dof.upper;
    terms.push_back(term);
  }
}

void add_passive(const Joint& joint, std::vector<LawTerm>& terms) {
  LawTerm term;
  if (joint.stiffness != 0 || joint.damping != 0) {
    term.stiffness = joint.stiffness;
    term.damping = joint.damping;
    term.target_position = joint.spring_reference;
    term.own = true;
    terms.push_back(term);
  }
  if (joint.friction > 0) {
    term = {};
    term.kind = TermKind::Friction;
    term.max_force = joint.friction;
    terms.push_back(term);
  }
  if (joint.armature > 0) {
    term = {};
    term.kind = TermKind::Armature;
    term.inertia = joint.armature;
    terms.push_back(term);
  }
  if (joint.velocity_limit < scene::kUnlimited) {
    term = {};
    term.kind = TermKind::Slowest;
    term.target_velocity = -joint.velocity_limit;
    terms.push_back(term);
    term.kind = TermKind::Fastest;
    term.target_velocity = joint.velocity_limit;
    terms.push_back(term);
  }
}

// One without gains has its place, too: samples or the user may give it some.
void add_drives(const Build& build, const Joint& joint, Dof dof, std::size_t law, JointMap& map,
                std::vector<LawTerm>& terms) {
  for (Index d = 0; d < joint.drives.size(); ++d) {
    const scene::Drive& drive = joint.drives[d];
    if (drive.dof != dof) {
      continue;
    }
    LawTerm term;
    term.kind = build.options.drives == DriveTerms::Explicit ? TermKind::Force : TermKind::Spring;
    write_drive(drive, term);
    map.drives[d] = DriveAt{law, terms.size()};
    terms.push_back(term);
  }
}

void add_law(Build& build, Index index, std::size_t coordinate) {
  const Joint& joint = build.scene.joints[index];
  JointMap& map = build.model.joints[index];
  std::vector<LawTerm> terms;
  if (coordinate < map.dofs.free.size()) {
    const scene::FreeDof& dof = map.dofs.free[coordinate];
    add_drives(build, joint, dof.dof, coordinate, map, terms);
    add_passive(joint, terms);
    add_bounds(joint, dof, terms);  // last: what is solved last holds best
  } else {
    add_passive(joint, terms);
  }
  const bool turns = coordinate < map.dofs.free.size() && is_angular(map.dofs.free[coordinate].dof);
  if (terms.empty() && !turns) {
    return;  // a law without terms counts turns
  }
  const JPH::Ref<CoordinateLaw> law = new CoordinateLaw({coordinate_of(build, index, coordinate)});
  law->terms = std::move(terms);
  map.laws[coordinate] = law;
  build.model.laws.push_back(law);
}

}  // namespace

void write_drive(const scene::Drive& drive, LawTerm& term) {
  term.stiffness = drive.stiffness;
  term.damping = drive.damping;
  term.max_force = drive.max_force;
  term.acceleration = drive.acceleration;
  term.target_position = drive.target_position;
  term.target_velocity = drive.target_velocity;
  term.envelope = drive.envelope;
}

CoordinateOf coordinate_of(const Build& build, Index joint, std::size_t index) {
  const Joint& source = build.scene.joints[joint];
  CoordinateOf part;
  part.body0 = &side_body(build.model, source.body0);
  part.body1 = &side_body(build.model, source.body1);
  part.frame0 = side_frame(build.scene, source.body0, source.frame0);
  part.frame1 = side_frame(build.scene, source.body1, source.frame1);
  part.dofs = &build.model.joints[joint].dofs;
  part.joint = joint;
  part.index = index;
  part.position = source.initial_position.value_or(0);
  return part;
}

void add_laws(Build& build) {
  for (Index j = 0; j < build.scene.joints.size(); ++j) {
    JointMap& map = build.model.joints[j];
    map.drives.resize(build.scene.joints[j].drives.size());
    if (!map.acts || build.scene.joints[j].kind == scene::JointKind::Distance) {
      continue;
    }
    map.laws.resize(map.dofs.count());
    for (std::size_t i = 0; i < map.laws.size(); ++i) {
      add_law(build, j, i);
    }
  }
}

/// The tree that has all joints of a law.
TreeHolder* tree_of(const Model& model, const CoordinateLaw& law) {
  TreeHolder* tree = model.joints[law.parts().front().joint].tree;
  for (const CoordinateOf& part : law.parts()) {
    tree = model.joints[part.joint].tree == tree ? tree : nullptr;
  }
  return tree;
}

void insert_constraints(Build& build) {
  const auto system_of = [&](const Joint& joint) -> JPH::PhysicsSystem& {
    const std::optional<Index> body = joint.body1.has_value() ? joint.body1 : joint.body0;
    return *build.model.systems[body ? build.scene.bodies[*body].scene : 0].system;
  };
  // Trees first: contacts have pushed single bodies, and a law can only judge the speed of its
  // coordinate once the tree has taken that up.
  for (const JPH::Ref<TreeHolder>& tree : build.model.trees) {
    system_of(build.scene.joints[tree->first_joint()]).AddConstraint(tree);
    build.set_steps(*tree, true);
  }
  for (Index j = 0; j < build.model.joints.size(); ++j) {
    const JointMap& map = build.model.joints[j];
    for (const JPH::Ref<CoordinateLaw>& law : map.laws) {
      if (law != nullptr && !law->terms.empty()) {
        system_of(build.scene.joints[j]).AddConstraint(law);
      }
    }
    if (map.measured != nullptr) {
      system_of(build.scene.joints[j]).AddConstraint(map.measured);
    } else if (map.holder != nullptr) {
      system_of(build.scene.joints[j]).AddConstraint(map.holder);
    }
  }
  for (const JPH::Ref<CoordinateLaw>& law : build.sums) {
    system_of(build.scene.joints[law->parts().front().joint]).AddConstraint(law);
    build.model.laws.push_back(law);
  }
  for (const JPH::Ref<CoordinateLaw>& law : build.model.laws) {
    TreeHolder* tree = tree_of(build.model, *law);
    law->set_tree(tree);
    build.set_steps(*law, tree != nullptr);
  }
}

}  // namespace tenon::engines::jolt
