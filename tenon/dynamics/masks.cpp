// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// First all names are looked up in the scene as it is, then everything is done at once, so that the
// order of the options says nothing. Bodies are put where they start before, because joints may say
// that apart from the poses.
#include "tenon/dynamics/masks.h"

#include <algorithm>
#include <string_view>

#include "tenon/base/text/name_pattern.h"
#include "tenon/base/text/nearest_name.h"
#include "tenon/base/text/quoted_text.h"
#include "tenon/dynamics/mask_scene.h"
#include "tenon/dynamics/multibody.h"

namespace tenon::dynamics {
namespace {

/// What a mask may mean.
struct Wanted {
  const char* option;
  bool bodies = false;
  bool joints = false;
  bool prims = false;  // a path above others
};
constexpr Wanted kDeactivate{"deactivate", true, true, true};
constexpr Wanted kBypass{"bypass", true, true, false};
constexpr Wanted kAnchor{"anchor", true, false, false};

struct Meant {
  std::vector<Index> bodies;
  std::vector<Index> joints;
  std::vector<Index> colliders;  // static ones

  bool empty() const { return bodies.empty() && joints.empty() && colliders.empty(); }
};

Error unknown_name(const scene::PhysicsScene& scene, const std::string& text,
                   const Wanted& wanted) {
  constexpr std::size_t kMostNames = 10'000;
  constexpr std::size_t kLongest = 200;
  std::vector<std::string> names;
  const auto add = [&names](const Path& path) {
    if (names.size() < kMostNames && path.name().str().size() <= kLongest) {
      names.push_back(path.name().str());
    }
  };
  for (const scene::Body& body : scene.bodies) {
    add(body.path);
  }
  for (std::size_t j = 0; wanted.joints && j < scene.joints.size(); ++j) {
    add(scene.joints[j].path);
  }
  const std::string_view near = text.size() <= kLongest
                                    ? nearest_name(text, {names.begin(), names.end()})
                                    : std::string_view();
  const std::string kind = wanted.joints ? "no link and no joint is called " : "no link is called ";
  return Error(ErrorCode::NotFound,
               std::string(wanted.option) + ": " + kind + quoted_text(text.substr(0, 100)))
      .with_rule("mask.unknown")
      .with_fix(near.empty() ? "name one that tenon tree ASSET --as flat lists"
                             : "did you mean " + std::string(near) + "?");
}

template <class Object>
void add_below(const std::vector<Object>& objects, Path prim, std::vector<Index>& found) {
  for (Index i = 0; i < objects.size(); ++i) {
    if (objects[i].path.has_prefix(prim)) {
      found.push_back(i);
    }
  }
}

void add_prims(const scene::PhysicsScene& scene, const std::string& text, Meant& meant) {
  const auto prim = Path::parse(text);
  if (!text.starts_with("/") || !prim) {
    return;
  }
  add_below(scene.bodies, *prim, meant.bodies);
  add_below(scene.joints, *prim, meant.joints);
  add_below(scene.colliders, *prim, meant.colliders);
  std::erase_if(meant.colliders, [&](Index i) { return scene.colliders[i].body.has_value(); });
}

Result<Meant> meant_by(const scene::PhysicsScene& scene, const std::vector<std::string>& texts,
                       const Wanted& wanted) {
  Meant all;
  for (const std::string& text : texts) {
    TENON_TRY(const NamePattern pattern, NamePattern::parse(text));
    Meant meant;
    for (Index b = 0; b < scene.bodies.size(); ++b) {
      if (pattern.matches(scene.bodies[b].path)) {
        meant.bodies.push_back(b);
      }
    }
    for (Index j = 0; wanted.joints && j < scene.joints.size(); ++j) {
      if (pattern.matches(scene.joints[j].path)) {
        meant.joints.push_back(j);
      }
    }
    if (meant.empty() && wanted.prims) {
      add_prims(scene, text, meant);
    }
    if (meant.empty()) {
      return unknown_name(scene, text, wanted);
    }
    all.bodies.insert(all.bodies.end(), meant.bodies.begin(), meant.bodies.end());
    all.joints.insert(all.joints.end(), meant.joints.begin(), meant.joints.end());
    all.colliders.insert(all.colliders.end(), meant.colliders.begin(), meant.colliders.end());
  }
  return all;
}

Error conflict(Path path, const std::string& first, const std::string& second) {
  return Error(ErrorCode::Invalid, path.str() + " is to be " + first + " and " + second)
      .with_prim(path.str())
      .with_rule("mask.conflict")
      .with_fix("leave one of the two out");
}

/// The links, and all that hangs on them.
void deactivate_bodies(const std::vector<Index>& bodies, const scene::JointForest& forest,
                       MaskPlan& plan) {
  for (const Index named : bodies) {
    plan.body_off[named] = named;
  }
  for (const Index body : forest.order) {
    const std::optional<Index>& parent = forest.bodies[body].parent;
    if (!plan.body_off[body] && parent && plan.body_off[*parent]) {
      plan.body_off[body] = plan.body_off[*parent];
    }
  }
}

Result<void> bypass(const Meant& meant, const scene::PhysicsScene& scene,
                    const scene::JointForest& forest, MaskPlan& plan) {
  for (const Index j : meant.joints) {
    const auto off = [&](const std::optional<Index>& body) { return body && plan.body_off[*body]; };
    if (plan.joint_off[j] != 0 || off(scene.joints[j].body0) || off(scene.joints[j].body1)) {
      return conflict(scene.joints[j].path, "deactivated", "bypassed");
    }
    plan.joint_held[j] = 1;
  }
  for (const Index b : meant.bodies) {
    if (plan.body_off[b]) {
      return conflict(scene.bodies[b].path, "deactivated", "bypassed");
    }
    if (!forest.bodies[b].joint) {
      return Error(ErrorCode::Invalid, "bypass: " + scene.bodies[b].path.str() +
                                           " hangs on nothing that its joints could hang on")
          .with_prim(scene.bodies[b].path.str())
          .with_rule("mask.no-parent")
          .with_fix("deactivate it, or bypass one of its joints");
    }
    plan.link_bypassed[b] = 1;
  }
  return {};
}

Result<MaskPlan> plan_for(const Masks& masks, const scene::PhysicsScene& scene,
                          const scene::JointForest& forest) {
  MaskPlan plan(scene);
  TENON_TRY(const Meant off, meant_by(scene, masks.deactivate, kDeactivate));
  TENON_TRY(const Meant around, meant_by(scene, masks.bypass, kBypass));
  TENON_TRY(const Meant anchored, meant_by(scene, masks.anchor, kAnchor));
  deactivate_bodies(off.bodies, forest, plan);
  for (const Index c : off.colliders) {
    plan.collider_off[c] = 1;
  }
  for (const Index j : off.joints) {
    plan.joint_off[j] = 1;
  }
  TENON_CHECK(bypass(around, scene, forest, plan));
  for (const Index b : anchored.bodies) {
    if (plan.body_off[b] || plan.link_bypassed[b] != 0) {
      return conflict(scene.bodies[b].path, "anchored",
                      plan.body_off[b] ? "deactivated" : "bypassed");
    }
    plan.anchored[b] = 1;
  }
  return plan;
}

/// Bodies go where the joints say that they start.
void put_at_start(scene::PhysicsScene& scene) {
  if (std::none_of(scene.joints.begin(), scene.joints.end(),
                   [](const scene::Joint& joint) { return joint.initial_position.has_value(); })) {
    return;
  }
  const std::vector<Pose> poses = Multibody(scene).start().bodies;
  for (std::size_t b = 0; b < poses.size(); ++b) {
    scene.bodies[b].pose = poses[b];
  }
}

}  // namespace

Result<void> apply_masks(const Masks& masks, scene::PhysicsScene& scene, Diagnostics& findings) {
  if (masks.empty()) {
    return {};
  }
  const scene::JointForest forest = joint_forest(scene);
  TENON_TRY(const MaskPlan plan, plan_for(masks, scene, forest));
  put_at_start(scene);
  mask_scene(plan, forest, scene, findings);
  return {};
}

}  // namespace tenon::dynamics
