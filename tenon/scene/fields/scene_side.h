// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "tenon/base/function.h"
#include "tenon/base/text/text_number.h"
#include "tenon/scene/fields/enum_names.h"
#include "tenon/scene/fields/fact.h"
#include "tenon/scene/fields/list_of.h"
#include "tenon/scene/fields/scene_difference.h"
#include "tenon/scene/fields/scene_fields.h"

/// One of two scenes that are compared: what its objects are told apart by, and what its fields say
/// in numbers and words. Internal to tenon/scene.
namespace tenon::scene {

inline std::string text_of(Path path) { return path.empty() ? std::string("none") : path.str(); }

inline std::string words_of(const FieldInfo& info) {
  return info.words.empty() ? in_words(info.name) : std::string(info.words);
}

/// Where in an object a walk is: the words around a field, and whether its coordinate turns.
struct Place {
  std::string words;
  bool angular = true;

  Place inside(const std::string& more) const {
    return {more.empty() ? words : words + more + " ", angular};
  }
};

/// Numbers say all of it.
template <class T>
constexpr bool has_numbers() {
  if constexpr (std::is_same_v<T, bool>) {
    return false;
  } else if constexpr (std::is_arithmetic_v<T> || std::is_same_v<T, Pose> || kIsQuat<T>) {
    return true;
  } else if constexpr (wire::kIsVector<T> || wire::kIsArray<T>) {
    return has_numbers<typename T::value_type>();
  } else if constexpr (wire::kIsPair<T>) {
    return has_numbers<typename T::first_type>() && has_numbers<typename T::second_type>();
  } else {
    return requires(T t) { t.v; } || requires(T t) { t.m; };
  }
}
template <class T>
inline constexpr bool kHasNumbers = has_numbers<T>();

struct Side {
  const PhysicsScene& scene;
  Function<Path(Path)> moved;  ///< of colliders; none: where they are

  /// Of the object that an index leads to.
  Path path(List list, Index index) const {
    const Path path = path_of(scene, list, index);
    return list == List::Colliders && moved ? moved(path) : path;
  }

  /// The path of an object, or of what a track is of.
  template <class T>
  std::string path_text(const T& item, const std::string& key) const {
    if constexpr (requires { item.path.str(); }) {
      return item.path.empty() ? key : item.path.str();
    } else {
      std::string path;
      each_field(item, [&](const FieldInfo& info, const auto& value) {
        if constexpr (std::is_same_v<std::remove_cvref_t<decltype(value)>, Index>) {
          if (path.empty() && info.role == Role::Identity && info.refers != List::None) {
            path = text_of(path_of(scene, list_of(item, info.refers), value));
          }
        } else if constexpr (std::is_same_v<std::remove_cvref_t<decltype(value)>,
                                            std::optional<Index>>) {
          if (value && path.empty()) {
            path = text_of(path_of(scene, info.refers, *value));
          }
        }
      });
      return path.empty() ? key : path;
    }
  }

  /// What tells an object from others of its list, as text.
  template <class T>
  std::string key_of(const T& item) const {
    std::string key;
    const OwnerFacts owner = facts_of(item);
    each_field(item, [&](const FieldInfo& info, const auto& value) {
      if (info.role == Role::Identity) {
        const std::string word = identity_text(owner, info, value);
        key += (key.empty() || word.empty() ? "" : " ") + word;
      }
    });
    return key;
  }

  template <class T>
  std::string identity_text(const OwnerFacts& owner, const FieldInfo& info, const T& value) const {
    if constexpr (std::is_same_v<T, Path>) {
      const bool moves = owner.is_collider && moved;
      return text_of(moves ? moved(value) : value);
    } else if constexpr (wire::kIsOptional<T>) {
      return value ? identity_text(owner, info, *value) : std::string();
    } else if constexpr (std::is_enum_v<T>) {
      return std::string(name_of(value));
    } else if constexpr (std::is_same_v<T, std::string>) {
      return value;
    } else if constexpr (std::is_same_v<T, Index>) {
      const List list = list_of(owner, info.refers);
      return list == List::None ? std::to_string(value) : text_of(path(list, value));
    } else if constexpr (std::is_arithmetic_v<T>) {
      return shortest(static_cast<double>(value));
    } else {
      return "";
    }
  }

  /// Keys of a list; the second one of a key is told from the first by a number, and so are objects
  /// without identity.
  template <class T>
  std::vector<std::string> keys_of(const std::vector<T>& list) const {
    std::vector<std::string> keys;
    std::map<std::string, std::size_t> times;
    keys.reserve(list.size());
    for (const T& item : list) {
      std::string key = key_of(item);
      const std::size_t time = ++times[key];
      if (time > 1 || key.empty()) {
        key += (key.empty() ? "" : " ") + std::to_string(time);
      }
      keys.push_back(std::move(key));
    }
    return keys;
  }

  /// What a field says; by numbers where they say all of it, else by a word.
  template <class T>
  Fact fact(const OwnerFacts& owner, const FieldInfo& info, const T& value,
            const Place& place) const {
    Fact fact;
    fact.name = place.words + words_of(info);
    fact.rotation = kIsQuat<T>;
    if constexpr (kHasNumbers<T>) {
      if (info.refers == List::None && info.on.empty()) {
        fact.unit = unit_text(info.unit, place.angular);
        add_numbers(value, fact.numbers);
        return fact;
      }
    }
    fact.word = word(owner, info, value);
    return fact;
  }

  template <class T>
  std::string word(const OwnerFacts& owner, const FieldInfo& info, const T& value) const {
    if constexpr (std::is_same_v<T, bool>) {
      return info.on.empty() ? (value ? "yes" : "no") : std::string(value ? info.on : info.off);
    } else if constexpr (std::is_same_v<T, Path>) {
      return text_of(value);
    } else if constexpr (std::is_enum_v<T>) {
      return std::string(name_of(value));
    } else if constexpr (std::is_same_v<T, std::string>) {
      return value;
    } else if constexpr (std::is_same_v<T, Index>) {
      return text_of(path(list_of(owner, info.refers), value));
    } else if constexpr (wire::kIsOptional<T>) {
      const bool world = info.refers == List::Bodies;
      return value ? word(owner, info, *value) : world ? "world" : "none";
    } else if constexpr (wire::kIsPair<T>) {
      return word(owner, info, value.first);
    } else if constexpr (wire::kIsVector<T>) {
      std::vector<std::string> each;
      each.reserve(value.size());
      for (const auto& item : value) {
        each.push_back(word(owner, info, item));
      }
      if (info.unordered) {
        std::sort(each.begin(), each.end());
      }
      std::string words;
      for (const std::string& one : each) {
        words += (words.empty() ? "" : ", ") + one;
      }
      return words;
    } else {
      return "";
    }
  }
};

}  // namespace tenon::scene
