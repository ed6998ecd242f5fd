// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// All of it is one walk over pairs of structs by their tables: a field that is itself a struct, or
// a list of structs with the same identities on both sides, is entered, every other one is copied
// as it is. Indices in what was copied are led to the objects of the same path in the scene that
// they came to; meshes and materials that it lacks come along, behind those that it has.
#include "tenon/scene/fields/scene_patch.h"

#include <algorithm>
#include <map>
#include <optional>
#include <type_traits>
#include <utility>

#include "tenon/scene/fields/field_pairs.h"
#include "tenon/scene/fields/near_fields.h"
#include "tenon/scene/fields/scene_side.h"

namespace tenon::scene {
namespace {

template <class T>
constexpr bool is_referred_to() {
  return std::is_same_v<T, Scene> || std::is_same_v<T, Body> || std::is_same_v<T, Collider> ||
         std::is_same_v<T, Material> || std::is_same_v<T, Joint> || std::is_same_v<T, Tendon>;
}

/// Two structs of lists are the same thing.
template <class T>
bool same_identity(const T& a, const T& b) {
  bool same = true;
  each_field_of_both(a, b, [&](const FieldInfo& info, const auto& x, const auto& y) {
    same = same && (info.role != Role::Identity || same_fields(x, y));
  });
  return same;
}

template <class T>
bool same_objects(const std::vector<T>& a, const std::vector<T>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const T& x, const T& y) { return same_identity(x, y); });
}

/// Calls `visit(owner, info, name, x, y)` for each field that is copied as a whole.
template <class From, class To, class Visit>
void each_leaf_of_pair(From& from, To& to, const std::string& around, Visit& visit) {
  const OwnerFacts owner = facts_of(to);
  each_field_of_pair(from, to, [&](const FieldInfo& info, auto& x, auto& y) {
    using T = std::remove_cvref_t<decltype(y)>;
    if (!acts(info)) {
      return;
    }
    if constexpr (HasTable<T>) {
      each_leaf_of_pair(x, y, joined(around, info), visit);
    } else {
      if constexpr (is_struct_list<T>()) {
        if (!y.empty() && same_objects(x, y)) {
          for (std::size_t i = 0; i < y.size(); ++i) {
            each_leaf_of_pair(x[i], y[i], joined(around, info), visit);
          }
          return;
        }
      }
      visit(owner, info, joined(around, info), x, y);
    }
  });
}

/// Where references of one scene lead in another.
class Translation {
 public:
  Translation(const PhysicsScene& from, PhysicsScene& to) : from_(from), to_(to) {}

  bool failed() const { return failed_; }

  /// Mends all indices in what was copied from the one scene into the other.
  template <class T>
  void mend(const OwnerFacts& owner, const FieldInfo& info, T& value) {
    if constexpr (HasTable<T>) {
      const OwnerFacts facts = facts_of(value);
      each_field(value, [&](const FieldInfo& inner, auto& field) { mend(facts, inner, field); });
    } else if constexpr (std::is_same_v<T, Index>) {
      if (const List list = list_of(owner, info.refers); list != List::None) {
        value = led(list, value);
      }
    } else if constexpr (wire::kIsOptional<T>) {
      if (value) {
        mend(owner, info, *value);
      }
    } else if constexpr (wire::kIsPair<T>) {
      mend(owner, info, value.first);
      mend(owner, info, value.second);
    } else if constexpr (wire::kIsVector<T>) {
      if constexpr (!std::is_same_v<T, std::vector<bool>>) {
        for (auto& item : value) {
          mend(owner, info, item);
        }
      }
    }
  }

 private:
  Index led(List list, Index index) {
    if (list == List::Meshes) {
      return with_mesh(index);
    }
    const Path path = path_of(from_, list, index);
    for (Index i = 0; i < size_of(to_, list); ++i) {
      if (path_of(to_, list, i) == path) {
        return i;
      }
    }
    if (list == List::Materials && index < from_.materials.size()) {
      to_.materials.push_back(from_.materials[index]);
      return static_cast<Index>(to_.materials.size() - 1);
    }
    failed_ = true;
    return index;
  }

  Index with_mesh(Index index) {
    if (index >= from_.meshes.size()) {
      return index;  // of a shape that has none
    }
    const auto [known, is_new] = meshes_.try_emplace(index, Index{0});
    if (is_new) {
      known->second = static_cast<Index>(to_.meshes.size());
      to_.meshes.push_back(from_.meshes[index]);
    }
    return known->second;
  }

  const PhysicsScene& from_;
  PhysicsScene& to_;
  std::map<Index, Index> meshes_;
  bool failed_ = false;
};

/// Whether two values differ, references by where they lead.
struct Compared {
  const PhysicsScene& a;
  const PhysicsScene& b;

  template <class T>
  bool differ(const OwnerFacts& owner, const FieldInfo& info, const T& x, const T& y) const {
    if constexpr (wire::kIsOptional<T>) {
      return x.has_value() != y.has_value() || (x && differ(owner, info, *x, *y));
    } else if constexpr (std::is_same_v<T, Index>) {
      const List list = list_of(owner, info.refers);
      if (list == List::Meshes) {
        return differ_as_meshes(x, y);
      }
      return list == List::None ? x != y : path_of(a, list, x) != path_of(b, list, y);
    } else if constexpr (wire::kIsPair<T>) {
      return differ(owner, info, x.first, y.first) || differ(owner, info, x.second, y.second);
    } else if constexpr (HasTable<T>) {
      bool found = false;
      const OwnerFacts facts = facts_of(x);
      each_field_of_both(x, y, [&](const FieldInfo& inner, const auto& p, const auto& q) {
        found = found ||
                (acts(inner) || inner.role == Role::Identity ? differ(facts, inner, p, q) : false);
      });
      return found;
    } else if constexpr (wire::kIsVector<T>) {
      bool found = x.size() != y.size();
      for (std::size_t i = 0; !found && i < x.size(); ++i) {
        found = differ(owner, info, x[i], y[i]);
      }
      return found;
    } else {
      return !near_fields(x, y);
    }
  }

  bool differ_as_meshes(Index x, Index y) const {
    const bool has_x = x < a.meshes.size();
    const bool has_y = y < b.meshes.size();
    return has_x != has_y || (has_x && !near_fields(a.meshes[x], b.meshes[y]));
  }
};

/// The index of a mesh says nothing where the shape is of none, and which articulation a joint is
/// of says what the articulations say.
bool says_nothing(const OwnerFacts& owner, const FieldInfo& info) {
  return (owner.is_shape && !owner.has_mesh && info.refers == List::Meshes) ||
         (owner.is_joint && info.refers == List::Articulations);
}

template <class T>
std::map<Path, std::size_t> places_of(const std::vector<T>& list) {
  std::map<Path, std::size_t> places;
  for (std::size_t i = 0; i < list.size(); ++i) {
    places.emplace(list[i].path, i);
  }
  return places;
}

/// Calls `both(x, y)` for objects of the same path, `alone(x)` for those of one side.
template <class A, class B, class Both, class Alone>
void pair_objects(A& a, B& b, Both&& both, Alone&& alone) {
  const auto places = places_of(b);
  std::vector<char> met(b.size(), 0);
  for (auto& x : a) {
    const auto found = places.find(x.path);
    if (found == places.end()) {
      alone(x);
    } else {
      met[found->second] = 1;
      both(x, b[found->second]);
    }
  }
  for (std::size_t i = 0; i < b.size(); ++i) {
    if (met[i] == 0) {
      alone(b[i]);
    }
  }
}

class Collected {
 public:
  explicit Collected(std::string_view list) : list_(list) {}

  void add(const std::string& field, Path object) {
    const auto [at, is_new] = places_.try_emplace(field, patches_.size());
    if (is_new) {
      patches_.push_back({list_, field, {}});
    }
    std::vector<Path>& objects = patches_[at->second].objects;
    if (!object.empty() && (objects.empty() || objects.back() != object)) {
      objects.push_back(object);
    }
  }

  void move_to(std::vector<FieldPatch>& found) {
    found.insert(found.end(), patches_.begin(), patches_.end());
  }

 private:
  std::string list_;
  std::vector<FieldPatch> patches_;
  std::map<std::string, std::size_t> places_;
};

template <class T>
void collect_objects(const Compared& sides, const std::vector<T>& a, const std::vector<T>& b,
                     Collected& found) {
  pair_objects(
      a, b,
      [&](const T& x, const T& y) {
        if (!same_identity(x, y)) {
          found.add("", y.path);
        }
        auto leaf = [&](const OwnerFacts& owner, const FieldInfo& info, const std::string& name,
                        const auto& p, const auto& q) {
          if (!says_nothing(owner, info) && sides.differ(owner, info, p, q)) {
            found.add(name, y.path);
          }
        };
        each_leaf_of_pair(x, y, "", leaf);
      },
      [&](const T& only) { found.add("", only.path); });
}

/// Tables of the filter are numbered by collider.
bool same_colliders(const PhysicsScene& a, const PhysicsScene& b) {
  return std::equal(a.colliders.begin(), a.colliders.end(), b.colliders.begin(), b.colliders.end(),
                    [](const Collider& x, const Collider& y) { return x.path == y.path; });
}

/// Calls `visit(joint of a, joint of b)` for those of the same path.
template <class B, class Visit>
void each_joint_of_both(const PhysicsScene& a, B& b, Visit&& visit) {
  pair_objects(a.joints, b.joints, visit, [](const Joint&) {});
}

bool same_articulations(const PhysicsScene& a, const PhysicsScene& b) {
  bool same = !Compared{a, b}.differ({}, FieldInfo{}, a.articulations, b.articulations);
  each_joint_of_both(a, b, [&](const Joint& x, const Joint& y) {
    FieldInfo refers;
    refers.refers = List::Articulations;
    same = same && !Compared{a, b}.differ({}, refers, x.articulation, y.articulation);
  });
  return same;
}

/// Objects of one side act no more. Bodies cannot be taken out.
template <class T>
bool switch_off(const FieldPatch& patch, std::vector<T>& list) {
  constexpr bool kCan = std::is_same_v<T, Joint> || std::is_same_v<T, Collider>;
  if constexpr (kCan) {
    for (T& object : list) {
      if (std::find(patch.objects.begin(), patch.objects.end(), object.path) !=
          patch.objects.end()) {
        object.enabled = false;
      }
    }
  }
  return kCan;
}

template <class T>
bool take_over_objects(const FieldPatch& patch, std::vector<T>& a, std::vector<T>& b,
                       Translation& translation) {
  if (patch.field.empty()) {
    return switch_off(patch, a) && switch_off(patch, b);
  }
  bool taken = false;
  pair_objects(
      std::as_const(a), b,
      [&](const T& x, T& y) {
        auto leaf = [&](const OwnerFacts& owner, const FieldInfo& info, const std::string& name,
                        const auto& from, auto& to) {
          if (name == patch.field) {
            to = from;
            translation.mend(owner, info, to);
            taken = true;
          }
        };
        each_leaf_of_pair(x, y, "", leaf);
      },
      [](const T&) {});
  return taken && !translation.failed();
}

/// What follows samples of drives counts them by number, and comes along where drives do.
void take_over_drive_tracks(const FieldPatch& patch, const PhysicsScene& a, PhysicsScene& b,
                            Translation& translation) {
  if (patch.list == "joints" && patch.field == "drives") {
    b.scalar_tracks = a.scalar_tracks;
    for (ScalarTrack& track : b.scalar_tracks) {
      each_field(track,
                 [&](const FieldInfo& info, auto& value) { translation.mend({}, info, value); });
    }
  }
}

bool take_over_in(const FieldPatch& patch, PhysicsScene& a, PhysicsScene& b) {
  Translation translation(a, b);
  bool taken = false;
  each_field_of_pair(a, b, [&](const FieldInfo& info, auto& x, auto& y) {
    using T = std::remove_cvref_t<decltype(y)>;
    if (!is_named(patch, info)) {
      return;
    }
    if constexpr (std::is_same_v<T, CollisionFilter>) {
      taken = same_colliders(a, b);
      y = taken ? x : y;
    } else if constexpr (is_struct_list<T>()) {
      if constexpr (is_referred_to<typename T::value_type>()) {
        taken = take_over_objects(patch, x, y, translation);
      } else {
        y = x;
        translation.mend({}, info, y);
        taken = !translation.failed();
        if constexpr (std::is_same_v<T, std::vector<Articulation>>) {
          each_joint_of_both(
              a, b, [](const Joint& from, Joint& to) { to.articulation = from.articulation; });
        }
      }
    } else {
      y = x;
      taken = true;
    }
  });
  take_over_drive_tracks(patch, a, b, translation);
  return taken && !translation.failed();
}

}  // namespace

std::vector<FieldPatch> field_patches(const PhysicsScene& a, const PhysicsScene& b) {
  const Compared sides{a, b};
  std::vector<FieldPatch> found;
  each_field_of_both(a, b, [&](const FieldInfo& info, const auto& x, const auto& y) {
    using T = std::remove_cvref_t<decltype(x)>;
    if (!acts(info)) {
      return;
    }
    Collected of_list(info.name);
    if constexpr (std::is_same_v<T, CollisionFilter>) {
      if (!same_colliders(a, b) || a.disabled_pairs() != b.disabled_pairs() ||
          !same_fields(x.permanent_pairs, y.permanent_pairs) ||
          !same_fields(x.joint_pairs, y.joint_pairs)) {
        of_list.add("filter", {});
      }
    } else if constexpr (is_struct_list<T>()) {
      if constexpr (is_referred_to<typename T::value_type>()) {
        collect_objects(sides, x, y, of_list);
      } else if constexpr (std::is_same_v<T, std::vector<Articulation>>) {
        if (!same_articulations(a, b)) {
          of_list.add(std::string(info.name), {});
        }
      } else if (sides.differ({}, info, x, y)) {
        of_list.add(std::string(info.name), {});
      }
    } else if (sides.differ({}, info, x, y)) {
      of_list.add(std::string(info.name), {});
    }
    of_list.move_to(found);
  });
  return found;
}

bool take_over(const FieldPatch& patch, PhysicsScene& a, PhysicsScene& b) {
  PhysicsScene old_a = a;
  PhysicsScene old_b = b;
  if (take_over_in(patch, a, b)) {
    return true;
  }
  a = std::move(old_a);
  b = std::move(old_b);
  return false;
}

}  // namespace tenon::scene
