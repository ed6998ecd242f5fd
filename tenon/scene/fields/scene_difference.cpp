// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Two scenes are walked together by their tables. Objects of a list are paired by what the tables
// call their identity (their path, or for what changes over time the object that it is of), and
// paired structs are walked field by field down to numbers and words. An index is compared by the
// object that it leads to, because lists of two scenes need not be in step; a mesh by its contents.
// The collision filter is the one exception: what counts is which pairs it lets touch, not its
// tables, whose rows are numbered by scene; filter_words.cpp puts it into words.
#include "tenon/scene/fields/scene_difference.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "tenon/base/text/text_number.h"
#include "tenon/scene/fields/scene_fields.h"
#include "tenon/scene/fields/scene_side.h"
#include "tenon/scene/filter_words.h"

namespace tenon::scene {
namespace {

std::string words_of_struct(const FieldInfo& info) {
  return info.inlined ? std::string() : words_of(info);
}

/// `index`: an optional one.
const Material& material_of(const Side& side, DataView index) {
  const auto& at = index.as<std::optional<Index>>();
  return at ? side.scene.materials[*at] : side.scene.unbound;
}

/// Whether a field of two structs says the same kind of thing. Where a view holds several schemas
/// of one law, one of another vendor may be read: what only that vendor has does not count for the
/// motion.
bool are_comparable(DataView a, DataView b, const FieldInfo& info, bool motion_alone) {
  const Mimic* mimic = a.get_if<Mimic>();
  return mimic == nullptr || !info.of_vendor || !motion_alone ||
         mimic->schema == b.as<Mimic>().schema;
}

/// One, or an optional one.
bool is_index(const DataType& type) {
  return type.kind == DataKind::Ordinal ||
         (type.kind == DataKind::Optional && type.item->kind == DataKind::Ordinal);
}

/// Names that one of two sets alone has.
void add_names(std::string_view object, const std::set<std::string>& before,
               const std::set<std::string>& after, std::vector<SceneDifference>& found) {
  for (const auto& [list, other, change] :
       {std::tuple(&before, &after, Change::Removed), std::tuple(&after, &before, Change::Added)}) {
    for (const std::string& name : *list) {
      if (!other->contains(name)) {
        found.push_back({change, std::string(object), name, {}, {}, 0});
      }
    }
  }
}

std::vector<SceneDifference> filter_differences(const Side& before, const Side& after,
                                                bool motion_alone) {
  const CollisionFilter& a = before.scene.filter;
  const CollisionFilter& b = after.scene.filter;
  std::vector<SceneDifference> found;
  const auto pairs_before = disabled_pair_words(before);
  const auto pairs_after = disabled_pair_words(after);
  if (pairs_before && pairs_after) {
    add_names("pair", *pairs_before, *pairs_after, found);
  }
  add_names("pair for good", set_pair_words(before, a.permanent_sets_off),
            set_pair_words(after, b.permanent_sets_off), found);
  add_names("pair while a joint holds", joint_pair_words(before), joint_pair_words(after), found);
  if (!motion_alone || !pairs_before || !pairs_after) {
    add_names("filtered pair", set_pair_words(before, a.sets_off),
              set_pair_words(after, b.sets_off), found);
    add_names("collision group", group_words(before), group_words(after), found);
  }
  return found;
}

/// Of the structs of both scenes that a field is of.
struct Owners {
  OwnerFacts a;
  OwnerFacts b;
};

class Walk {
 public:
  Walk(const PhysicsScene& before, const PhysicsScene& after, const CompareOptions& options)
      : before_{before, options.moved}, after_{after, {}}, options_(options) {}

  std::vector<SceneDifference> run() {
    const DataView a = view_of(before_.scene);
    const DataView b = view_of(after_.scene);
    for (const DataField& field : a.type->fields) {
      member(*field.info, a.member(field), b.member(field));
    }
    return std::move(found_);
  }

 private:
  bool is_full() const { return found_.size() >= options_.max_differences; }
  bool counts(const FieldInfo& info) const {
    return info.role != Role::Shared && !(options_.motion_alone && info.role == Role::Provenance);
  }

  // The lists of the scene, and its own numbers.

  void member(const FieldInfo& info, DataView a, DataView b) {
    const bool by_contents = a.is_a<std::vector<Material>>() || a.is_a<std::vector<Scene>>();
    if (is_full() || !counts(info) || (by_contents && options_.motion_alone)) {
      return;
    }
    if (a.is_a<CollisionFilter>()) {
      for (SceneDifference& one : filter_differences(before_, after_, options_.motion_alone)) {
        if (!is_full()) {
          found_.push_back(std::move(one));
        }
      }
    } else if (a.kind() == DataKind::List) {
      objects(a, b);
    } else {
      object_ = a.kind() == DataKind::Struct ? info.name : Table<PhysicsScene>::kWord;
      path_ = "/";
      field({}, info, a, b, Place{});
    }
  }

  void objects(DataView before, DataView after) {
    for (const auto& [key, a, b] : pair_up(before, after)) {
      if (is_full()) {
        return;
      }
      object_ = before.type->item->word;
      path_ = a ? before_.path_text(*a, key) : after_.path_text(*b, key);
      if (a && b) {
        both(*a, *b, Place{"", facts_of(*a, angular_around(*a)).angular});
      } else {
        report(a ? Change::Removed : Change::Added, {}, {}, 0);
      }
    }
  }

  /// Tracks have the coordinate of their joint.
  bool angular_around(DataView item) const {
    const DataField* joint = find_field(*item.type, "joint");
    if (joint == nullptr || joint->type->kind != DataKind::Ordinal) {
      return true;
    }
    return facts_of(view_of(before_.scene.joints[item.member(*joint).as<Index>()])).angular;
  }

  // Pairs of objects.

  /// What two lists have of one key; none where a side lacks it.
  struct Paired {
    std::string key;
    std::optional<DataView> a;
    std::optional<DataView> b;
  };

  /// In the order of the lists where they are in step, else by key.
  std::vector<Paired> pair_up(DataView before, DataView after) {
    std::vector<std::string> a = before_.keys_of(before);
    std::vector<std::string> b = after_.keys_of(after);
    std::vector<Paired> pairs;
    if (a == b) {
      for (std::size_t i = 0; i < a.size(); ++i) {
        pairs.push_back({std::move(a[i]), before[i], after[i]});
      }
      return pairs;
    }
    std::map<std::string, Paired> by_key;
    for (std::size_t i = 0; i < a.size(); ++i) {
      by_key[a[i]].a = before[i];
    }
    for (std::size_t i = 0; i < b.size(); ++i) {
      by_key[b[i]].b = after[i];
    }
    for (auto& [key, pair] : by_key) {
      pairs.push_back({key, pair.a, pair.b});
    }
    return pairs;
  }

  // Fields of a pair of structs.

  template <class T>
  void both_of(const T& a, const T& b, const Place& place) {
    both(view_of(a), view_of(b), place);
  }

  void both(DataView a, DataView b, const Place& place) {
    const Owners owners{facts_of(a, place.angular), facts_of(b, place.angular)};
    const Place inner{place.words, owners.a.angular};
    for (const DataField& of : a.type->fields) {
      if (counts(*of.info) && of.info->role != Role::Identity &&
          are_comparable(a, b, *of.info, options_.motion_alone)) {
        field(owners, *of.info, a.member(of), b.member(of), inner);
      }
    }
  }

  void field(const Owners& owners, const FieldInfo& info, DataView x, DataView y,
             const Place& place) {
    if (info.refers != List::None && is_index(*x.type)) {
      reference(owners, info, x, y, place);
    } else if (x.kind() == DataKind::Pose) {
      pose(owners, info, x, y, place);
    } else if (x.kind() == DataKind::Optional) {
      optional(owners, info, x, y, place);
    } else if (x.kind() == DataKind::Struct) {
      both(x, y, place.inside(words_of_struct(info)));
    } else if (is_struct_list(*x.type)) {
      nested(info, x, y, place);
    } else {
      leaf(owners, info, x, y, place);
      if (x.is_a<Masses>()) {
        masses(x.as<Masses>(), y.as<Masses>(), place);
      }
    }
  }

  void optional(const Owners& owners, const FieldInfo& info, DataView x, DataView y,
                const Place& place) {
    const bool has_x = x.size() != 0;
    const bool has_y = y.size() != 0;
    if (has_x && has_y) {
      field(owners, info, x[0], y[0], place);
    } else if (has_x) {
      one(before_, owners.a, info, x[0], place, Change::Removed);
    } else if (has_y) {
      one(after_, owners.b, info, y[0], place, Change::Added);
    }
  }

  using Masses = std::vector<std::pair<Index, BodyMass>>;

  void masses(const Masses& x, const Masses& y, const Place& place) {
    for (std::size_t i = 0; i < std::min(x.size(), y.size()); ++i) {
      both_of(x[i].second, y[i].second,
              place.inside("of " + text_of(before_.path(List::Bodies, x[i].first))));
    }
  }

  void nested(const FieldInfo& info, DataView x, DataView y, const Place& place) {
    for (const auto& [key, a, b] : pair_up(x, y)) {
      std::string word(info.words.empty() ? x.type->item->word : info.words);
      word += (word.empty() ? "" : " ") + key;
      const Place inner = place.inside(word);
      if (a && b) {
        both(*a, *b, inner);
      } else if (a) {
        all(before_, *a, inner, Change::Removed);
      } else {
        all(after_, *b, inner, Change::Added);
      }
    }
  }

  void pose(const Owners& owners, const FieldInfo& info, DataView x, DataView y,
            const Place& place) {
    FieldInfo part = info;
    const std::string words(info.words.empty() || info.inlined ? std::string_view() : info.words);
    const std::string position = "position" + (words.empty() ? "" : " " + words);
    const std::string orientation = "orientation" + (words.empty() ? "" : " " + words);
    part.words = position;
    part.unit = Unit::Meter;
    leaf(owners, part, x.first(), y.first(), place);
    part.words = orientation;
    part.unit = Unit::None;
    leaf(owners, part, x.second(), y.second(), place);
  }

  /// Of an Index, or an optional one.
  void reference(const Owners& owners, const FieldInfo& info, DataView x, DataView y,
                 const Place& place) {
    if (info.refers == List::Meshes) {
      if (x.kind() == DataKind::Ordinal) {
        mesh(owners, x.as<Index>(), y.as<Index>(), place);
      }
    } else if (options_.motion_alone && info.refers == List::Materials &&
               x.kind() == DataKind::Optional) {
      both_of(material_of(before_, x), material_of(after_, y), place.inside("material"));
    } else if (options_.motion_alone && info.refers == List::Scenes &&
               x.kind() == DataKind::Ordinal) {
      both_of(before_.scene.scenes[x.as<Index>()], after_.scene.scenes[y.as<Index>()], place);
    } else {
      leaf(owners, info, x, y, place);
    }
  }

  /// Meshes count where the shape is of one.
  void mesh(const Owners& owners, Index x, Index y, const Place& place) {
    if (owners.a.has_mesh && owners.b.has_mesh) {
      both_of(before_.scene.meshes[x], after_.scene.meshes[y], place.inside("mesh"));
    }
  }

  // Numbers and words.

  void leaf(const Owners& owners, const FieldInfo& info, DataView x, DataView y,
            const Place& place) {
    if (is_numeric(info, *x.type)) {
      const double tolerance = options_.motion_alone ? info.tolerance : options_.tolerance;
      const double apart = distance(x, y, {tolerance, options_.smallest_size});
      if (apart > 0) {
        report(Change::Changed, before_.fact(owners.a, info, x, place),
               after_.fact(owners.b, info, y, place), apart);
      }
      return;
    }
    if (info.refers == List::Meshes) {
      if (x.is_a<std::vector<Index>>()) {
        hulls(info, x.as<std::vector<Index>>(), y.as<std::vector<Index>>(), place);
      }
      return;
    }
    Fact before = before_.fact(owners.a, info, x, place);
    Fact after = after_.fact(owners.b, info, y, place);
    if (before.word != after.word) {
      report(Change::Changed, std::move(before), std::move(after), kNoMeasure);
    }
  }

  void hulls(const FieldInfo& info, const std::vector<Index>& x, const std::vector<Index>& y,
             const Place& place) {
    if (x.size() != y.size()) {
      report(Change::Changed, {place.words + words_of(info), "", {double(x.size())}, "", false},
             {place.words + words_of(info), "", {double(y.size())}, "", false}, kNoMeasure);
      return;
    }
    for (std::size_t i = 0; i < x.size(); ++i) {
      both_of(before_.scene.meshes[x[i]], after_.scene.meshes[y[i]],
              place.inside("hull " + std::to_string(i + 1)));
    }
  }

  // What one side lacks.

  void all(const Side& side, DataView item, const Place& place, Change change) {
    const OwnerFacts owner = facts_of(item, place.angular);
    const Place inner{place.words, owner.angular};
    for (const DataField& field : item.type->fields) {
      if (counts(*field.info) && field.info->role != Role::Identity) {
        one(side, owner, *field.info, item.member(field), inner, change);
      }
    }
  }

  void one(const Side& side, const OwnerFacts& owner, const FieldInfo& info, DataView value,
           const Place& place, Change change) {
    if (value.kind() == DataKind::Struct) {
      all(side, value, place.inside(words_of_struct(info)), change);
    } else if (is_struct_list(*value.type)) {
      for (std::size_t i = 0; i < value.size(); ++i) {
        all(side, value[i], place.inside(words_of(info) + " " + side.key_of(value[i])), change);
      }
    } else {
      Fact only = side.fact(owner, info, value, place);
      const bool added = change == Change::Added;
      report(change, added ? Fact{} : only, added ? only : Fact{}, kNoMeasure);
    }
  }

  void report(Change change, Fact before, Fact after, double largest) {
    if (!is_full()) {
      found_.push_back(
          {change, std::string(object_), path_, std::move(before), std::move(after), largest});
    }
  }

  Side before_;
  Side after_;
  const CompareOptions& options_;
  std::string_view object_;
  std::string path_;
  std::vector<SceneDifference> found_;
};

}  // namespace

std::string fact_text(const Fact& fact) {
  constexpr std::size_t kShown = 9;
  std::string text = fact.name + (fact.word.empty() ? "" : " " + fact.word);
  for (std::size_t i = 0; i < std::min(kShown, fact.numbers.size()); ++i) {
    text += " " + shortest(fact.numbers[i]);
  }
  return text + (fact.numbers.size() > kShown ? " ..." : "") +
         (fact.unit.empty() ? "" : " " + fact.unit);
}

std::vector<SceneDifference> scene_differences(const PhysicsScene& before,
                                               const PhysicsScene& after,
                                               const CompareOptions& options) {
  return Walk(before, after, options).run();
}

}  // namespace tenon::scene
