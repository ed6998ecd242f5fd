// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// An object is named by its path, or by what it is of: the fields that the tables call its identity
// are put into words, indices as the paths that they lead to. What numbers say all of is told in
// numbers, which have a distance; all else in words, which are equal or not.
#include "tenon/scene/fields/scene_side.h"

#include <algorithm>
#include <map>
#include <utility>

#include "tenon/base/text/comma_list.h"
#include "tenon/base/text/text_number.h"
#include "tenon/math/quaternion.h"

namespace tenon::scene {

Path Side::path(List list, Index index) const {
  const Path path = path_of(scene, list, index);
  return list == List::Colliders && moved ? moved(path) : path;
}

std::string Side::path_text(DataView item, const std::string& key) const {
  if (const Path* own = path_of(item)) {
    return own->empty() ? key : own->str();
  }
  const OwnerFacts owner = facts_of(item);
  for (const DataField& field : item.type->fields) {
    const FieldInfo& info = *field.info;
    const DataView value = item.member(field);
    const bool is_optional = value.kind() == DataKind::Optional;
    if (value.kind() == DataKind::Ordinal && info.role == Role::Identity &&
        info.refers != List::None) {
      return text_of(path_of(scene, list_of(owner, info.refers), value.as<Index>()));
    }
    if (is_optional && value.type->item->kind == DataKind::Ordinal && value.size() != 0) {
      return text_of(path_of(scene, info.refers, value[0].as<Index>()));
    }
  }
  return key;
}

std::string Side::key_of(DataView item) const {
  std::string key;
  const OwnerFacts owner = facts_of(item);
  for (const DataField& field : item.type->fields) {
    if (field.info->role == Role::Identity) {
      const std::string word = identity_text(owner, *field.info, item.member(field));
      key += (key.empty() || word.empty() ? "" : " ") + word;
    }
  }
  return key;
}

std::string Side::identity_text(const OwnerFacts& owner, const FieldInfo& info,
                                DataView value) const {
  switch (value.kind()) {
    case DataKind::Path: {
      const Path path = value.as<Path>();
      return text_of(owner.is_collider && moved ? moved(path) : path);
    }
    case DataKind::Optional:
      return value.size() == 0 ? std::string() : identity_text(owner, info, value[0]);
    case DataKind::Word:
      return std::string(word_of(value));
    case DataKind::Text:
      return value.as<std::string>();
    case DataKind::Ordinal: {
      const List list = list_of(owner, info.refers);
      const Index index = value.as<Index>();
      return list == List::None ? std::to_string(index) : text_of(path(list, index));
    }
    case DataKind::Integer:
    case DataKind::Real:
      return shortest(number_of(value));
    case DataKind::Flag:
      return value.as<bool>() ? "1" : "0";
    default:
      return "";
  }
}

std::vector<std::string> Side::keys_of(DataView list) const {
  std::vector<std::string> keys;
  std::map<std::string, std::size_t> times;
  const std::size_t count = list.size();
  keys.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    std::string key = key_of(list[i]);
    const std::size_t time = ++times[key];
    if (time > 1 || key.empty()) {
      key += (key.empty() ? "" : " ") + std::to_string(time);
    }
    keys.push_back(std::move(key));
  }
  return keys;
}

Fact Side::fact(const OwnerFacts& owner, const FieldInfo& info, DataView value,
                const Place& place) const {
  Fact fact;
  fact.name = place.words + words_of(info);
  fact.rotation = value.kind() == DataKind::Rotation;
  if (is_numeric(info, *value.type)) {
    fact.unit = unit_text(info.unit, place.angular);
    add_numbers(value, fact.numbers);
  } else {
    fact.word = word(owner, info, value);
  }
  return fact;
}

std::string Side::word(const OwnerFacts& owner, const FieldInfo& info, DataView value) const {
  switch (value.kind()) {
    case DataKind::Flag: {
      const bool on = value.as<bool>();
      return info.on.empty() ? (on ? "yes" : "no") : std::string(on ? info.on : info.off);
    }
    case DataKind::Path:
      return text_of(value.as<Path>());
    case DataKind::Word:
      return std::string(word_of(value));
    case DataKind::Text:
      return value.as<std::string>();
    case DataKind::Ordinal:
      return text_of(path(list_of(owner, info.refers), value.as<Index>()));
    case DataKind::Optional:
      if (value.size() == 0) {
        return info.refers == List::Bodies ? "world" : "none";
      }
      return word(owner, info, value[0]);
    case DataKind::Pair:
      return word(owner, info, value.first());
    case DataKind::List:
      return list_word(owner, info, value);
    default:
      return "";
  }
}

std::string Side::list_word(const OwnerFacts& owner, const FieldInfo& info, DataView list) const {
  std::vector<std::string> each;
  for (std::size_t i = 0; i < list.size(); ++i) {
    each.push_back(word(owner, info, list[i]));
  }
  if (info.unordered) {
    std::sort(each.begin(), each.end());
  }
  return comma_list(each);
}

}  // namespace tenon::scene
