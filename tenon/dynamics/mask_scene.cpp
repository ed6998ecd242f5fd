// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Nothing leaves a list, so that all places stay: what is taken out is switched off, as a body,
// collider or joint of an asset that is not enabled, and no track switches it on again. What refers
// to a coordinate that is gone does not act any more. Only a link that no joint holds to the world
// gets a joint of its own to be anchored by. Contacts that joints keep off stay off, so that links
// which overlap by design do not jump.
#include "tenon/dynamics/mask_scene.h"

#include <algorithm>
#include <string>
#include <utility>

#include "tenon/scene/fields/insert_joints.h"
#include "tenon/scene/joint_freedom.h"

namespace tenon::dynamics {
namespace {

using scene::Joint;
using scene::PhysicsScene;

class Masker {
 public:
  Masker(const MaskPlan& plan, const scene::JointForest& forest, PhysicsScene& scene,
         Diagnostics& findings)
      : plan_(plan),
        forest_(forest),
        scene_(scene),
        findings_(findings),
        masked_{plan.link_bypassed, plan.collider_off, plan.joint_off, plan.joint_held,
                plan.anchored} {
    for (std::size_t b = 0; b < plan.body_off.size(); ++b) {
      masked_.body_off[b] = static_cast<char>(masked_.body_off[b] != 0 || plan.body_off[b]);
    }
  }

  void run() {
    rehang_links();
    const std::vector<Index> loose = anchor_by_joints();
    switch_off_bodies();
    switch_off_joints();
    hold_joints();
    drop_references(masked_, scene_, findings_);
    for (Index a = 0; a < scene_.articulations.size();) {
      a += static_cast<Index>(trim_articulation(a, scene_));
    }
    add_anchors(loose);
    scene_.update_joint_pairs();
  }

 private:
  Pose pose_of(const std::optional<Index>& body) const {
    return body ? scene_.bodies[*body].pose : Pose{};
  }

  void tell(const char* rule, const Message& message, Path prim) {
    findings_.add({Severity::Info, rule, message, prim.str(), {}, {}});
  }

  // ---- links and joints

  /// The joints of bypassed links, from the roots outward, hang on what these hung on.
  void rehang_links() {
    for (const Index b : forest_.order) {
      if (plan_.link_bypassed[b] == 0) {
        continue;
      }
      const Index above = *forest_.bodies[b].joint;
      const Joint& holder = scene_.joints[above];
      const std::optional<Index> parent = holder.body0 == b ? holder.body1 : holder.body0;
      for (Index j = 0; j < scene_.joints.size(); ++j) {
        if (j != above) {
          rehang(j, b, parent);
        }
      }
      tell("mask.bypassed",
           "the link is bypassed: its joints hang on " +
               (parent ? named(scene_.bodies[*parent].path, RelatedRole::Body)
                       : Message("the world")),
           scene_.bodies[b].path);
    }
  }

  void rehang(Index j, Index from, const std::optional<Index>& to) {
    Joint& joint = scene_.joints[j];
    const Pose change = inverse(pose_of(to)) * scene_.bodies[from].pose;
    const Path target = to ? scene_.bodies[*to].path : Path();
    if (joint.body0 == from) {
      joint.body0 = to;
      joint.target0 = target;
      joint.frame0 = change * joint.frame0;
    }
    if (joint.body1 == from) {
      joint.body1 = to;
      joint.target1 = target;
      joint.frame1 = change * joint.frame1;
    }
    if (joint.body0 == joint.body1) {
      masked_.joint_off[j] = 1;
    }
  }

  void switch_off_bodies() {
    for (Index b = 0; b < scene_.bodies.size(); ++b) {
      if (!masked_.is_off(b)) {
        continue;
      }
      scene::Body& body = scene_.bodies[b];
      body.enabled = false;
      body.kinematic = true;
      body.linear_velocity = body.angular_velocity = {};
      if (const auto& with = plan_.body_off[b]; with == b) {
        tell("mask.deactivated", "the link is deactivated", body.path);
      } else if (with) {
        tell("mask.deactivated",
             "the link hangs on " + named(scene_.bodies[*with].path, RelatedRole::Body) +
                 ", which is deactivated",
             body.path);
      }
    }
    for (Index c = 0; c < scene_.colliders.size(); ++c) {
      scene::Collider& collider = scene_.colliders[c];
      if (masked_.is_off(collider.body) || plan_.collider_off[c] != 0) {
        collider.enabled = false;
      }
      if (plan_.collider_off[c] != 0) {
        tell("mask.deactivated", "the collider is deactivated", collider.path);
      }
    }
  }

  void switch_off_joints() {
    for (Index j = 0; j < scene_.joints.size(); ++j) {
      Joint& joint = scene_.joints[j];
      if (masked_.is_off(joint.body0) || masked_.is_off(joint.body1)) {
        masked_.joint_off[j] = 1;
      }
      if (masked_.joint_off[j] != 0) {
        joint.enabled = false;
        masked_.joint_held[j] = 0;
      }
      if (plan_.joint_off[j] != 0) {
        tell("mask.deactivated", "the joint is deactivated", joint.path);
      }
    }
  }

  /// Bypassed joints hold their sides as they stand.
  void hold_joints() {
    for (Index j = 0; j < scene_.joints.size(); ++j) {
      if (masked_.joint_held[j] == 0) {
        continue;
      }
      const Joint& old = scene_.joints[j];
      Joint joint = scene::fixed_in_place_of(old);
      joint.frame1 = inverse(pose_of(old.body1)) * pose_of(old.body0) * old.frame0;
      scene_.joints[j] = std::move(joint);
      if (plan_.joint_held[j] != 0) {
        tell("mask.bypassed", "the joint is bypassed: it holds its sides as they stand",
             scene_.joints[j].path);
      }
    }
  }

  // ---- anchors

  /// A joint that may hold the body to the world.
  std::optional<Index> joint_to_world(Index body) const {
    for (Index j = 0; j < scene_.joints.size(); ++j) {
      const Joint& joint = scene_.joints[j];
      const bool alone =
          (joint.body0 == body && !joint.body1) || (joint.body1 == body && !joint.body0);
      if (alone && joint.enabled && masked_.joint_off[j] == 0 &&
          joint.kind != scene::JointKind::Distance) {
        return j;
      }
    }
    return std::nullopt;
  }

  /// -> the links that no joint holds to the world yet.
  std::vector<Index> anchor_by_joints() {
    std::vector<Index> loose;
    for (Index b = 0; b < scene_.bodies.size(); ++b) {
      if (plan_.anchored[b] == 0) {
        continue;
      }
      scene::Body& body = scene_.bodies[b];
      body.linear_velocity = body.angular_velocity = {};
      if (body.kinematic) {
        tell("mask.anchored", "the link is kinematic; it stands where it starts", body.path);
        continue;
      }
      const std::optional<Index> joint = joint_to_world(b);
      if (!joint) {
        tell("mask.anchored", "the link is fixed to the world where it starts", body.path);
        loose.push_back(b);
        continue;
      }
      const Joint& holder = scene_.joints[*joint];
      const bool fixed = holder.kind == scene::JointKind::Fixed;
      tell("mask.anchored",
           named(holder.path, RelatedRole::Joint) +
               (fixed ? " fixes the link to the world already"
                      : " holds the link to the world where it starts"),
           body.path);
      masked_.joint_held[*joint] = fixed ? masked_.joint_held[*joint] : 1;
    }
    return loose;
  }

  Joint anchor_of(Index b) const {
    const scene::Body& body = scene_.bodies[b];
    Joint joint;
    joint.kind = scene::JointKind::Fixed;
    joint.body1 = b;
    joint.target1 = body.path;
    joint.frame0 = body.pose;
    std::string name = "anchor";
    do {
      joint.path = body.path.child(Token(name));
      name += "_";
    } while (is_taken(joint.path));
    return joint;
  }

  bool is_taken(Path path) const {
    const auto is = [path](const auto& object) { return object.path == path; };
    return std::any_of(scene_.bodies.begin(), scene_.bodies.end(), is) ||
           std::any_of(scene_.joints.begin(), scene_.joints.end(), is) ||
           std::any_of(scene_.colliders.begin(), scene_.colliders.end(), is);
  }

  void add_anchors(const std::vector<Index>& bodies) {
    std::vector<Joint> joints;
    for (const Index b : bodies) {
      joints.push_back(anchor_of(b));
    }
    if (joints.empty()) {
      return;
    }
    const std::vector<Index> places = scene::insert_joints(scene_, std::move(joints));
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      for (Index a = 0; a < scene_.articulations.size(); ++a) {
        take_anchor(a, bodies[i], places[i]);
      }
    }
  }

  /// The anchor is the root joint of an articulation that floats, else it closes a loop.
  void take_anchor(Index number, Index body, Index anchor) {
    scene::Articulation& articulation = scene_.articulations[number];
    const auto link = std::find(articulation.links.begin(), articulation.links.end(), body);
    if (link == articulation.links.end()) {
      return;
    }
    auto& joints = articulation.fixed_base ? articulation.loop_joints : articulation.joints;
    joints.insert(std::lower_bound(joints.begin(), joints.end(), anchor), anchor);
    if (articulation.fixed_base) {
      return;
    }
    scene_.joints[anchor].articulation = number;
    articulation.fixed_base = true;
    articulation.root = scene_.joints[anchor].path;
    articulation.links.erase(link);
    std::sort(articulation.links.begin(), articulation.links.end());
    articulation.links.insert(articulation.links.begin(), body);
  }

  const MaskPlan& plan_;
  const scene::JointForest& forest_;
  PhysicsScene& scene_;
  Diagnostics& findings_;
  Masked masked_;  // before anchors are added
};

}  // namespace

void mask_scene(const MaskPlan& plan, const scene::JointForest& forest, PhysicsScene& scene,
                Diagnostics& findings) {
  Masker(plan, forest, scene, findings).run();
}

}  // namespace tenon::dynamics
