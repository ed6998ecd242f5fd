// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "tenon/base/fill_fields.h"
#include "tenon/base/wire.h"
#include "tenon/scene/fields/list_of.h"
#include "tenon/scene/fields/scene_fields.h"

/// For tests that walk every field: a scene in which each has a value of its own, and the same
/// scene with one of them changed.
namespace tenon::scene {

inline void make_sound(Collider& collider) { collider.shape.kind = ShapeKind::Mesh; }
inline void make_sound(Joint& joint) { joint.mimics[1].dof = Dof::RotZ; }
/// Settings are numbers or a word.
inline void make_words(std::vector<VendorSetting>& settings) {
  for (VendorSetting& setting : settings) {
    setting.numbers.clear();
  }
}
inline void make_sound(Tendon& tendon) { make_words(tendon.settings); }
inline void make_sound(Body& body) { make_words(body.parts.physx); }
inline void make_sound(Scene& scene) {
  make_words(scene.parts.physx);
  for (VendorSetting& setting : *scene.parts.mujoco) {
    setting.token.clear();
  }
}

template <class Object>
void make_sound(std::vector<Object>& list, std::vector<ObjectTrack<Object>>& tracks) {
  for (Object& object : list) {
    make_sound(object);
  }
  for (ObjectTrack<Object>& track : tracks) {
    for (Object& object : track.states) {
      make_sound(object);
    }
  }
}

/// Sound by check_scene.
inline PhysicsScene filled_scene() {
  PhysicsScene scene;
  wire::FillFields{}(scene);
  // Tables of two groups by two.
  scene.filter.group_pair_off = {0, 1, 1, 0};
  // Colliders of two bodies, each a set of its own.
  for (Index i = 0; i < 2; ++i) {
    scene.colliders[i].body = i;
  }
  scene.filter.sets_of_collider = {{0}, {1}};
  scene.filter.sets_off = scene.filter.permanent_sets_off = {{0, 1}};
  for (JointPairs& pairs : scene.filter.joint_pairs) {
    pairs.sets = {{0, 1}};
  }
  for (GroupState& state : scene.group_states) {
    state.group_pair_off = {1, 0, 0, 1};
  }
  make_sound(scene.colliders, scene.collider_tracks);
  make_sound(scene.bodies, scene.body_tracks);
  for (Articulation& articulation : scene.articulations) {
    make_words(articulation.parts.physx);
  }
  make_sound(scene.joints, scene.joint_tracks);
  make_sound(scene.tendons, scene.tendon_tracks);
  make_sound(scene.scenes, scene.scene_tracks);
  for (ShapesTrack& track : scene.shapes_tracks) {
    for (BodyShapes& shapes : track.shapes) {
      for (Shape& shape : shapes.shapes) {
        shape.kind = ShapeKind::Mesh;
      }
    }
  }
  return scene;
}

/// What a changed leaf is: its path in the tables, and whether a difference of it is one of motion.
struct Leaf {
  std::string name;
  Role role = Role::Physics;
};

/// Changes the leaf with a number. Of a list the last item has leaves: every field has one, and the
/// time of a test does not double with each list in a list.
class ChangeLeaf {
 public:
  explicit ChangeLeaf(int at) : at_(at) {}

  /// False when there are no more than `at` leaves.
  bool changed() const { return seen_ > at_; }
  const Leaf& leaf() const { return leaf_; }

  template <class T>
  void walk(T& of, Role around) {
    each_field(of, [&](const FieldInfo& info, auto& value) {
      if (changed()) {
        return;
      }
      names_.push_back(info.name);
      visit(value, around == Role::Provenance ? around : info.role);
      names_.pop_back();
    });
  }

 private:
  template <class T>
  void visit(T& value, Role role) {
    if (changed()) {
      return;
    }
    if constexpr (HasTable<T>) {
      walk(value, role);
    } else if constexpr (wire::kIsOptional<T>) {
      if (is_it(role)) {
        value.reset();
      } else if (value) {
        visit(*value, role);
      }
    } else if constexpr (wire::kIsPair<T>) {
      visit(value.first, role);
      visit(value.second, role);
    } else if constexpr (wire::kIsVector<T>) {
      if (!value.empty()) {
        visit(value.back(), role);
      }
    } else if constexpr (wire::kIsArray<T>) {
      for (auto& item : value) {
        visit(item, role);
      }
    } else if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T> ||
                         std::is_same_v<T, std::string> || std::is_same_v<T, Path>) {
      if (is_it(role)) {
        change(value);
      }
    } else {
      wire::with_fields(value, [&](auto&... field) { (visit(field, role), ...); });
    }
  }

  template <class T>
  static void change(T& value) {
    if constexpr (std::is_same_v<T, bool>) {
      value = !value;
    } else if constexpr (std::is_enum_v<T>) {
      value = static_cast<T>(value == static_cast<T>(0) ? 1 : 0);
    } else if constexpr (std::is_same_v<T, std::string>) {
      value += "!";
    } else if constexpr (std::is_same_v<T, Path>) {
      value = Path::from(value.str() + "_changed");
    } else if constexpr (std::is_floating_point_v<T>) {
      value += 0.125;
    } else {
      value = static_cast<T>(value == 0 ? 1 : 0);
    }
  }

  bool is_it(Role role) {
    if (seen_++ != at_) {
      return false;
    }
    leaf_.role = role;
    for (const std::string_view name : names_) {
      (leaf_.name += '.') += name;
    }
    return true;
  }

  int at_;
  int seen_ = 0;
  std::vector<std::string_view> names_;
  Leaf leaf_;
};

/// Calls `visit(changed scene, leaf)` for each leaf of `scene` in turn.
template <class Visit>
void each_changed_leaf(const PhysicsScene& scene, Visit&& visit) {
  for (int at = 0;; ++at) {
    PhysicsScene changed = scene;
    ChangeLeaf change(at);
    change.walk(changed, Role::Physics);
    if (!change.changed()) {
      return;
    }
    visit(changed, change.leaf());
  }
}

}  // namespace tenon::scene
