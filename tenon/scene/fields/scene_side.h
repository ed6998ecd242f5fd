// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tenon/base/function.h"
#include "tenon/scene/fields/fact.h"
#include "tenon/scene/fields/list_of.h"
#include "tenon/scene/fields/scene_difference.h"

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

struct Side {
  const PhysicsScene& scene;
  Function<Path(Path)> moved;  ///< of colliders; none: where they are

  /// Of the object that an index leads to.
  Path path(List list, Index index) const;

  /// The path of an object, or of what a track is of.
  std::string path_text(DataView item, const std::string& key) const;

  /// What tells an object from others of its list, as text.
  std::string key_of(DataView item) const;

  /// Keys of a list; the second one of a key is told from the first by a number, and so are objects
  /// without identity.
  std::vector<std::string> keys_of(DataView list) const;

  /// What a field says; by numbers where they say all of it, else by a word.
  Fact fact(const OwnerFacts& owner, const FieldInfo& info, DataView value,
            const Place& place) const;

 private:
  std::string identity_text(const OwnerFacts& owner, const FieldInfo& info, DataView value) const;
  std::string word(const OwnerFacts& owner, const FieldInfo& info, DataView value) const;
  std::string list_word(const OwnerFacts& owner, const FieldInfo& info, DataView list) const;
};

/// Numbers say all of a field.
inline bool is_numeric(const FieldInfo& info, const DataType& type) {
  return info.refers == List::None && info.on.empty() && has_numbers(type);
}

}  // namespace tenon::scene
