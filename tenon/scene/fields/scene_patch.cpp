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
#include <utility>

#include "tenon/scene/fields/near_fields.h"
#include "tenon/scene/fields/patched_fields.h"
#include "tenon/scene/fields/same_fields.h"
#include "tenon/scene/fields/scene_side.h"

namespace tenon::scene {
namespace {

/// Lists whose objects are taken over one by one, by path.
bool is_referred_to(const DataType& list) {
  return list.is_a<std::vector<Scene>>() || list.is_a<std::vector<Body>>() ||
         list.is_a<std::vector<Collider>>() || list.is_a<std::vector<Material>>() ||
         list.is_a<std::vector<Joint>>() || list.is_a<std::vector<Tendon>>();
}

/// Two structs of lists are the same thing.
bool same_identity(DataView a, DataView b) {
  return std::all_of(a.type->fields.begin(), a.type->fields.end(), [&](const DataField& field) {
    return field.info->role != Role::Identity || same_data(a.member(field), b.member(field));
  });
}

bool same_objects(DataView a, DataView b) {
  bool same = a.size() == b.size();
  for (std::size_t i = 0; same && i < a.size(); ++i) {
    same = same_identity(a[i], b[i]);
  }
  return same;
}

/// A field that is copied as a whole.
struct LeafPair {
  OwnerFacts owner;
  const FieldInfo* info;
  std::string name;  ///< "drives.stiffness"
  DataView from;
  DataRef to;
};

void add_leaves(DataView from, DataRef to, const std::string& around,
                std::vector<LeafPair>& leaves) {
  const OwnerFacts owner = facts_of(to);
  for (const DataField& field : from.type->fields) {
    if (!acts(*field.info)) {
      continue;
    }
    const DataView x = from.member(field);
    const DataRef y = to.member(field);
    const std::string name = joined(around, *field.info);
    if (x.kind() == DataKind::Struct) {
      add_leaves(x, y, name, leaves);
    } else if (is_struct_list(*x.type) && y.size() != 0 && same_objects(x, y)) {
      for (std::size_t i = 0; i < y.size(); ++i) {
        add_leaves(x[i], y[i], name, leaves);
      }
    } else {
      leaves.push_back({owner, field.info, name, x, y});
    }
  }
}

/// Where references of one scene lead in another.
class Translation {
 public:
  Translation(const PhysicsScene& from, PhysicsScene& to) : from_(from), to_(to) {}

  bool failed() const { return failed_; }

  /// Maps all indices in a value that was copied from one scene into the other.
  void mend(const OwnerFacts& owner, const FieldInfo& info, DataRef value) {
    switch (value.kind()) {
      case DataKind::Struct: {
        const OwnerFacts facts = facts_of(value);
        for (const DataField& field : value.type->fields) {
          mend(facts, *field.info, value.member(field));
        }
        break;
      }
      case DataKind::Ordinal:
        if (const List list = list_of(owner, info.refers); list != List::None) {
          value.as<Index>() = led(list, value.as<Index>());
        }
        break;
      case DataKind::Pair:
        mend(owner, info, value.first());
        mend(owner, info, value.second());
        break;
      case DataKind::Optional:
      case DataKind::List:
        for (std::size_t i = 0; i < value.size(); ++i) {
          mend(owner, info, value[i]);
        }
        break;
      default:
        break;
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

  bool differ(const OwnerFacts& owner, const FieldInfo& info, DataView x, DataView y) const {
    switch (x.kind()) {
      case DataKind::Ordinal:
        return indices_differ(list_of(owner, info.refers), x.as<Index>(), y.as<Index>());
      case DataKind::Pair:
        return differ(owner, info, x.first(), y.first()) ||
               differ(owner, info, x.second(), y.second());
      case DataKind::Struct:
        return structs_differ(x, y);
      case DataKind::Optional:
      case DataKind::List: {
        bool found = x.size() != y.size();
        for (std::size_t i = 0; !found && i < x.size(); ++i) {
          found = differ(owner, info, x[i], y[i]);
        }
        return found;
      }
      default:
        return !near_data(x, y);
    }
  }

  bool indices_differ(List list, Index x, Index y) const {
    if (list == List::Meshes) {
      return differ_as_meshes(x, y);
    }
    return list == List::None ? x != y : path_of(a, list, x) != path_of(b, list, y);
  }

  bool structs_differ(DataView x, DataView y) const {
    const OwnerFacts facts = facts_of(x);
    return std::any_of(x.type->fields.begin(), x.type->fields.end(), [&](const DataField& field) {
      return (acts(*field.info) || field.info->role == Role::Identity) &&
             differ(facts, *field.info, x.member(field), y.member(field));
    });
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

/// Objects of two lists by path; none where one side alone has it.
struct ObjectPair {
  std::optional<std::size_t> a;
  std::optional<std::size_t> b;
};

std::vector<ObjectPair> pair_objects(DataView a, DataView b) {
  std::map<Path, std::size_t> places;
  for (std::size_t i = 0; i < b.size(); ++i) {
    places.emplace(*path_of(b[i]), i);
  }
  std::vector<ObjectPair> pairs;
  std::vector<char> met(b.size(), 0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    const auto found = places.find(*path_of(a[i]));
    if (found == places.end()) {
      pairs.push_back({i, {}});
    } else {
      met[found->second] = 1;
      pairs.push_back({i, found->second});
    }
  }
  for (std::size_t i = 0; i < b.size(); ++i) {
    if (met[i] == 0) {
      pairs.push_back({{}, i});
    }
  }
  return pairs;
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

/// Leaves are seen as pairs of which the second might be changed; here it is not.
DataRef unchanged(DataView view) { return {view.type, const_cast<void*>(view.at)}; }

void collect_objects(const Compared& sides, DataView a, DataView b, Collected& found) {
  for (const auto& [i, j] : pair_objects(a, b)) {
    const Path path = *path_of(j ? b[*j] : a[*i]);
    if (!i || !j) {
      found.add("", path);
      continue;
    }
    if (!same_identity(a[*i], b[*j])) {
      found.add("", path);
    }
    std::vector<LeafPair> leaves;
    add_leaves(a[*i], unchanged(b[*j]), "", leaves);
    for (const LeafPair& leaf : leaves) {
      if (!says_nothing(leaf.owner, *leaf.info) &&
          sides.differ(leaf.owner, *leaf.info, leaf.from, leaf.to)) {
        found.add(leaf.name, path);
      }
    }
  }
}

/// Tables of the filter are numbered by collider.
bool same_colliders(const PhysicsScene& a, const PhysicsScene& b) {
  return std::equal(a.colliders.begin(), a.colliders.end(), b.colliders.begin(), b.colliders.end(),
                    [](const Collider& x, const Collider& y) { return x.path == y.path; });
}

bool same_articulations(const PhysicsScene& a, const PhysicsScene& b) {
  const Compared sides{a, b};
  if (sides.differ({}, FieldInfo{}, view_of(a.articulations), view_of(b.articulations))) {
    return false;
  }
  FieldInfo refers;
  refers.refers = List::Articulations;
  const auto pairs = pair_objects(view_of(a.joints), view_of(b.joints));
  return std::none_of(pairs.begin(), pairs.end(), [&](const ObjectPair& pair) {
    return pair.a && pair.b &&
           sides.differ({}, refers, view_of(a.joints[*pair.a].articulation),
                        view_of(b.joints[*pair.b].articulation));
  });
}

/// Objects of one side act no more. Bodies cannot be taken out.
bool switch_off(const FieldPatch& patch, DataRef list) {
  for (std::size_t i = 0; i < list.size(); ++i) {
    const bool is_meant = std::find(patch.objects.begin(), patch.objects.end(),
                                    *path_of(DataView(list[i]))) != patch.objects.end();
    Joint* joint = list[i].get_if<Joint>();
    Collider* collider = list[i].get_if<Collider>();
    if (is_meant && joint != nullptr) {
      joint->enabled = false;
    } else if (is_meant && collider != nullptr) {
      collider->enabled = false;
    }
  }
  return list.type->is_a<std::vector<Joint>>() || list.type->is_a<std::vector<Collider>>();
}

bool take_over_objects(const FieldPatch& patch, DataRef a, DataRef b, Translation& translation) {
  if (patch.field.empty()) {
    return switch_off(patch, a) && switch_off(patch, b);
  }
  bool taken = false;
  for (const auto& [i, j] : pair_objects(a, b)) {
    std::vector<LeafPair> leaves;
    if (i && j) {
      add_leaves(a[*i], b[*j], "", leaves);
    }
    for (const LeafPair& leaf : leaves) {
      if (leaf.name == patch.field) {
        leaf.to.assign(leaf.from);
        translation.mend(leaf.owner, *leaf.info, leaf.to);
        taken = true;
      }
    }
  }
  return taken && !translation.failed();
}

/// What follows samples of drives counts them by number, and comes along where drives do.
void take_over_drive_tracks(const FieldPatch& patch, const PhysicsScene& a, PhysicsScene& b,
                            Translation& translation) {
  if (patch.list == "joints" && patch.field == "drives") {
    b.scalar_tracks = a.scalar_tracks;
    translation.mend({}, FieldInfo{}, ref_to(b.scalar_tracks));
  }
}

void take_over_articulations(const PhysicsScene& a, PhysicsScene& b) {
  for (const auto& [i, j] : pair_objects(view_of(a.joints), view_of(b.joints))) {
    if (i && j) {
      b.joints[*j].articulation = a.joints[*i].articulation;
    }
  }
}

bool take_over_in(const FieldPatch& patch, PhysicsScene& a, PhysicsScene& b) {
  Translation translation(a, b);
  bool taken = false;
  const DataRef from = ref_to(a);
  const DataRef to = ref_to(b);
  for (const DataField& field : from.type->fields) {
    if (!is_named(patch, *field.info)) {
      continue;
    }
    const DataRef x = from.member(field);
    const DataRef y = to.member(field);
    const bool is_filter = field.type->is_a<CollisionFilter>();
    if (is_referred_to(*field.type)) {
      taken = take_over_objects(patch, x, y, translation);
    } else if (!is_filter || same_colliders(a, b)) {
      y.assign(x);
      taken = true;
    }
    if (is_struct_list(*field.type) && !is_referred_to(*field.type)) {
      translation.mend({}, *field.info, y);
      taken = !translation.failed();
      if (x.type->is_a<std::vector<Articulation>>()) {
        take_over_articulations(a, b);
      }
    }
  }
  take_over_drive_tracks(patch, a, b, translation);
  return taken && !translation.failed();
}

/// Their filters do, and what of it holds for good or by joints is written alike.
bool keep_the_same_apart(const PhysicsScene& a, const PhysicsScene& b) {
  if (same_fields(a.filter, b.filter)) {
    return true;
  }
  const ColliderPairs pairs = a.disabled_pairs();
  return !pairs.is_cut && pairs == b.disabled_pairs() &&
         same_fields(a.filter.sets_of_collider, b.filter.sets_of_collider) &&
         same_fields(a.filter.permanent_sets_off, b.filter.permanent_sets_off) &&
         same_fields(a.filter.joint_pairs, b.filter.joint_pairs);
}

/// Of a member of the scene.
void collect(const Compared& sides, const FieldInfo& info, DataView x, DataView y,
             Collected& found) {
  const PhysicsScene& a = sides.a;
  const PhysicsScene& b = sides.b;
  if (x.is_a<CollisionFilter>()) {
    if (!same_colliders(a, b) || !keep_the_same_apart(a, b)) {
      found.add("filter", {});
    }
  } else if (is_referred_to(*x.type)) {
    collect_objects(sides, x, y, found);
  } else if (x.is_a<std::vector<Articulation>>() ? !same_articulations(a, b)
                                                 : sides.differ({}, info, x, y)) {
    found.add(std::string(info.name), {});
  }
}

}  // namespace

std::vector<FieldPatch> field_patches(const PhysicsScene& a, const PhysicsScene& b) {
  const Compared sides{a, b};
  const DataView x = view_of(a);
  const DataView y = view_of(b);
  std::vector<FieldPatch> found;
  for (const DataField& field : x.type->fields) {
    if (acts(*field.info)) {
      Collected of_list(field.info->name);
      collect(sides, *field.info, x.member(field), y.member(field), of_list);
      of_list.move_to(found);
    }
  }
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
