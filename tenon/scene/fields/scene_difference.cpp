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
#include <type_traits>
#include <utility>

#include "tenon/base/text/text_number.h"
#include "tenon/scene/fields/scene_side.h"
#include "tenon/scene/filter_words.h"

namespace tenon::scene {
namespace {

template <class T>
constexpr bool is_list_of_structs() {
  if constexpr (wire::kIsVector<T>) {
    return HasTable<typename T::value_type>;
  } else {
    return false;
  }
}

std::string words_of_struct(const FieldInfo& info) {
  return info.inlined ? std::string() : words_of(info);
}

Material material_of(const Side& side, const std::optional<Index>& index) {
  return index ? side.scene.materials[*index] : side.scene.unbound;
}

/// Whether a field of two structs says the same kind of thing.
template <class T>
bool are_comparable(const T&, const T&, const FieldInfo&, bool) {
  return true;
}
/// Where a view holds several schemas of one law, one of another vendor may be read: what only that
/// vendor has does not count for the motion.
bool are_comparable(const Mimic& a, const Mimic& b, const FieldInfo& info, bool motion_alone) {
  return !info.of_vendor || !motion_alone || a.schema == b.schema;
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
  add_names("pair", pair_words(before, before.scene.disabled_pairs()),
            pair_words(after, after.scene.disabled_pairs()), found);
  add_names("pair for good", pair_words(before, a.permanent_pairs),
            pair_words(after, b.permanent_pairs), found);
  add_names("pair while a joint holds", joint_pair_words(before), joint_pair_words(after), found);
  if (!motion_alone) {
    add_names("filtered pair", pair_words(before, a.pairs_off), pair_words(after, b.pairs_off),
              found);
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
    each_field_of_both(
        before_.scene, after_.scene,
        [this](const FieldInfo& info, const auto& a, const auto& b) { member(info, a, b); });
    return std::move(found_);
  }

 private:
  bool is_full() const { return found_.size() >= options_.max_differences; }
  bool counts(const FieldInfo& info) const {
    return info.role != Role::Shared && !(options_.motion_alone && info.role == Role::Provenance);
  }

  // The lists of the scene, and its own numbers.

  template <class T>
  void member(const FieldInfo& info, const T& a, const T& b) {
    constexpr bool kByContents =
        std::is_same_v<T, std::vector<Material>> || std::is_same_v<T, std::vector<Scene>>;
    if (is_full() || !counts(info) || (kByContents && options_.motion_alone)) {
      return;
    }
    if constexpr (std::is_same_v<T, CollisionFilter>) {
      for (SceneDifference& one : filter_differences(before_, after_, options_.motion_alone)) {
        if (!is_full()) {
          found_.push_back(std::move(one));
        }
      }
    } else if constexpr (wire::kIsVector<T>) {
      objects(a, b);
    } else {
      object_ = HasTable<T> ? info.name : Table<PhysicsScene>::kWord;
      path_ = "/";
      field({}, info, a, b, Place{});
    }
  }

  template <class T>
  void objects(const std::vector<T>& before, const std::vector<T>& after) {
    pair_up<T>(before, after, [this](const T* a, const T* b, const std::string& key) {
      if (is_full()) {
        return;
      }
      object_ = Table<T>::kWord;
      path_ = a != nullptr ? before_.path_text(*a, key) : after_.path_text(*b, key);
      if (a == nullptr || b == nullptr) {
        came_or_went(a == nullptr ? Change::Added : Change::Removed);
      } else {
        both(*a, *b, Place{"", is_angular_in(*a, angular_around(*a))});
      }
    });
  }

  /// Tracks have the coordinate of their joint.
  template <class T>
  bool angular_around(const T& item) const {
    if constexpr (requires { item.joint + Index{0}; }) {
      return is_angular_in(before_.scene.joints[item.joint], true);
    } else {
      return true;
    }
  }

  // Pairs of objects.

  /// Calls `visit(a, b, key)` for each pair, with null for what one side lacks, by key.
  template <class T, class Visit>
  void pair_up(const std::vector<T>& before, const std::vector<T>& after, Visit&& visit) {
    const std::vector<std::string> a = before_.keys_of(before);
    const std::vector<std::string> b = after_.keys_of(after);
    if (a == b) {
      for (std::size_t i = 0; i < a.size(); ++i) {
        visit(&before[i], &after[i], a[i]);
      }
      return;
    }
    std::map<std::string, std::pair<const T*, const T*>> pairs;
    for (std::size_t i = 0; i < a.size(); ++i) {
      pairs[a[i]].first = &before[i];
    }
    for (std::size_t i = 0; i < b.size(); ++i) {
      pairs[b[i]].second = &after[i];
    }
    for (const auto& [key, pair] : pairs) {
      visit(pair.first, pair.second, key);
    }
  }

  // Fields of a pair of structs.

  template <class T>
  void both(const T& a, const T& b, const Place& place) {
    const Owners owners{facts_of(a, place.angular), facts_of(b, place.angular)};
    const Place inner{place.words, owners.a.angular};
    each_field_of_both(a, b, [&](const FieldInfo& info, const auto& x, const auto& y) {
      if (counts(info) && info.role != Role::Identity &&
          are_comparable(a, b, info, options_.motion_alone)) {
        field(owners, info, x, y, inner);
      }
    });
  }

  template <class T>
  void field(const Owners& owners, const FieldInfo& info, const T& x, const T& y,
             const Place& place) {
    if constexpr (std::is_same_v<T, Index> || std::is_same_v<T, std::optional<Index>>) {
      if (info.refers != List::None) {
        reference(owners, info, x, y, place);
        return;
      }
    }
    if constexpr (std::is_same_v<T, Pose>) {
      pose(owners, info, x, y, place);
    } else if constexpr (wire::kIsOptional<T>) {
      if (x && y) {
        field(owners, info, *x, *y, place);
      } else if (x || y) {
        one(x ? before_ : after_, x ? owners.a : owners.b, info, x ? *x : *y, place,
            x ? Change::Removed : Change::Added);
      }
    } else if constexpr (HasTable<T>) {
      both(x, y, place.inside(words_of_struct(info)));
    } else if constexpr (is_list_of_structs<T>()) {
      nested(info, x, y, place);
    } else {
      leaf(owners, info, x, y, place);
      if constexpr (std::is_same_v<T, std::vector<std::pair<Index, BodyMass>>>) {
        masses(x, y, place);
      }
    }
  }

  void masses(const std::vector<std::pair<Index, BodyMass>>& x,
              const std::vector<std::pair<Index, BodyMass>>& y, const Place& place) {
    for (std::size_t i = 0; i < std::min(x.size(), y.size()); ++i) {
      both(x[i].second, y[i].second,
           place.inside("of " + text_of(before_.path(List::Bodies, x[i].first))));
    }
  }

  template <class T>
  void nested(const FieldInfo& info, const std::vector<T>& x, const std::vector<T>& y,
              const Place& place) {
    pair_up<T>(x, y, [&](const T* a, const T* b, const std::string& key) {
      std::string word(info.words.empty() ? Table<T>::kWord : info.words);
      word += (word.empty() ? "" : " ") + key;
      const Place inner = place.inside(word);
      if (a != nullptr && b != nullptr) {
        both(*a, *b, inner);
      } else if (a != nullptr) {
        all(before_, *a, inner, Change::Removed);
      } else {
        all(after_, *b, inner, Change::Added);
      }
    });
  }

  void pose(const Owners& owners, const FieldInfo& info, const Pose& x, const Pose& y,
            const Place& place) {
    FieldInfo part = info;
    const std::string words(info.words.empty() || info.inlined ? std::string_view() : info.words);
    const std::string position = "position" + (words.empty() ? "" : " " + words);
    const std::string orientation = "orientation" + (words.empty() ? "" : " " + words);
    part.words = position;
    part.unit = Unit::Meter;
    leaf(owners, part, x.position, y.position, place);
    part.words = orientation;
    part.unit = Unit::None;
    leaf(owners, part, x.orientation, y.orientation, place);
  }

  template <class T>
  void reference(const Owners& owners, const FieldInfo& info, const T& x, const T& y,
                 const Place& place) {
    if (info.refers == List::Meshes) {
      if constexpr (std::is_same_v<T, Index>) {
        mesh(owners, x, y, place);
      }
      return;
    }
    if (options_.motion_alone && info.refers == List::Materials) {
      both(material_of(before_, x), material_of(after_, y), place.inside("material"));
      return;
    }
    if (options_.motion_alone && info.refers == List::Scenes) {
      if constexpr (std::is_same_v<T, Index>) {
        both(before_.scene.scenes[x], after_.scene.scenes[y], place);
      }
      return;
    }
    leaf(owners, info, x, y, place);
  }

  /// Meshes count where the shape is of one.
  void mesh(const Owners& owners, Index x, Index y, const Place& place) {
    if (owners.a.has_mesh && owners.b.has_mesh) {
      both(before_.scene.meshes[x], after_.scene.meshes[y], place.inside("mesh"));
    }
  }

  // Numbers and words.

  double tolerance(const FieldInfo& info) const {
    return options_.motion_alone ? info.tolerance : options_.tolerance;
  }

  template <class T>
  void leaf(const Owners& owners, const FieldInfo& info, const T& x, const T& y,
            const Place& place) {
    if constexpr (kHasNumbers<T>) {
      if (info.refers == List::None && info.on.empty()) {
        const double apart = distance(x, y, {tolerance(info), options_.smallest_size});
        if (apart > 0) {
          report(Change::Changed, before_.fact(owners.a, info, x, place),
                 after_.fact(owners.b, info, y, place), apart);
        }
        return;
      }
    }
    if (info.refers == List::Meshes) {
      hulls(info, x, y, place);
      return;
    }
    Fact before = before_.fact(owners.a, info, x, place);
    Fact after = after_.fact(owners.b, info, y, place);
    if (before.word != after.word) {
      report(Change::Changed, std::move(before), std::move(after), kNoMeasure);
    }
  }

  /// Lists of meshes.
  template <class T>
  void hulls(const FieldInfo& info, const T& x, const T& y, const Place& place) {
    if constexpr (std::is_same_v<T, std::vector<Index>>) {
      if (x.size() != y.size()) {
        report(Change::Changed, {place.words + words_of(info), "", {double(x.size())}, "", false},
               {place.words + words_of(info), "", {double(y.size())}, "", false}, kNoMeasure);
        return;
      }
      for (std::size_t i = 0; i < x.size(); ++i) {
        both(before_.scene.meshes[x[i]], after_.scene.meshes[y[i]],
             place.inside("hull " + std::to_string(i + 1)));
      }
    }
  }

  // What one side lacks.

  template <class T>
  void all(const Side& side, const T& item, const Place& place, Change change) {
    const OwnerFacts owner = facts_of(item, place.angular);
    const Place inner{place.words, owner.angular};
    each_field(item, [&](const FieldInfo& info, const auto& value) {
      if (counts(info) && info.role != Role::Identity) {
        one(side, owner, info, value, inner, change);
      }
    });
  }

  template <class T>
  void one(const Side& side, const OwnerFacts& owner, const FieldInfo& info, const T& value,
           const Place& place, Change change) {
    if constexpr (HasTable<T>) {
      all(side, value, place.inside(words_of_struct(info)), change);
    } else if constexpr (is_list_of_structs<T>()) {
      for (const auto& item : value) {
        all(side, item, place.inside(words_of(info) + " " + side.key_of(item)), change);
      }
    } else {
      Fact only = side.fact(owner, info, value, place);
      const bool added = change == Change::Added;
      report(change, added ? Fact{} : only, added ? only : Fact{}, kNoMeasure);
    }
  }

  void came_or_went(Change change) { report(change, {}, {}, 0); }

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
