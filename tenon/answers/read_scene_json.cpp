// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The way back: each struct is filled by its table from an object of JSON. A first look at the
// lists finds which path is which index, so that references may point ahead. What the text may cost
// is bounded by its length and depth; what it means is checked by check_scene.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "tenon/answers/scene_json.h"
#include "tenon/base/limits/reading_limits.h"
#include "tenon/scene/check_scene.h"
#include "tenon/scene/fields/data_type.h"
#include "tenon/scene/fields/list_of.h"
#include "tenon/scene/filter_sets.h"

namespace tenon::answers {
namespace {

using Parsed = nlohmann::json;
using scene::DataField;
using scene::DataKind;
using scene::DataRef;
using scene::FieldInfo;
using scene::Index;
using scene::List;
using scene::PhysicsScene;

/// All fit into an int and are whole.
bool are_whole(const std::vector<double>& numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](double x) {
    return std::fabs(x) <= std::numeric_limits<int>::max() && x == std::trunc(x);
  });
}

constexpr int kDepth = 16;  // of the form itself: 7

class Reader {
 public:
  Result<PhysicsScene> read(const Parsed& json) {
    find_paths(json);
    PhysicsScene scene;
    object(json, ref_to(scene), "");
    if (fault_) {
      return *std::move(fault_);
    }
    if (pairs_of_colliders_) {
      make_each_a_set(scene);
    }
    TENON_CHECK(check_scene(scene));
    for (const Index follower : single_mimics_) {
      scene::Joint& joint = scene.joints[follower];
      scene::Mimic& mimic = joint.mimics.front();
      mimic.dof = joint.dof();
      mimic.leader_dof = scene.joints[mimic.leader].dof();
    }
    return scene;
  }

 private:
  void fault(const std::string& at, const std::string& what) {
    if (!fault_) {
      fault_ = Error(ErrorCode::Invalid, "`" + at + "` of a physics scene " + what);
    }
  }

  void find_paths(const Parsed& json) {
    static constexpr std::pair<List, const char*> kLists[] = {
        {List::Scenes, "scenes"},       {List::Bodies, "bodies"},
        {List::Colliders, "colliders"}, {List::Materials, "materials"},
        {List::Joints, "joints"},       {List::Articulations, "articulations"},
        {List::Tendons, "tendons"},     {List::Actuators, "mujocoActuators"}};
    for (const auto& [list, key] : kLists) {
      const auto rows = json.find(key);
      if (rows == json.end() || !rows->is_array()) {
        continue;
      }
      Index index = 0;
      for (const Parsed& row : *rows) {
        const auto path = row.is_object() ? row.find("path") : row.end();
        const bool has_path = row.is_object() && path != row.end() && path->is_string();
        indices_.emplace(std::pair(list, has_path ? path->get<std::string>() : std::string()),
                         index++);
      }
    }
  }

  void object(const Parsed& json, DataRef value, const std::string& at) {
    if (!json.is_object()) {
      fault(at, "is not an object");
      return;
    }
    for (const DataField& of : value.type->fields) {
      if (!fault_) {
        // What an index leads to may hang on fields that have just been read.
        field(json, facts_of(value), *of.info, value.member(of), at);
      }
    }
    if (scene::Joint* joint = value.get_if<scene::Joint>()) {
      older(json, *joint, at);
    }
    if (value.get_if<scene::CollisionFilter>() != nullptr) {
      pairs_of_colliders_ = json.contains("pairsOff") && !json.contains("setsOff");
    }
  }

  /// What version 1.0 says otherwise: a joint of one axis follows one other such joint.
  void older(const Parsed& json, scene::Joint& joint, const std::string& at) {
    const auto mimic = json.find("mimic");
    if (!json.contains("mimics") && mimic != json.end() && mimic->is_object()) {
      object(*mimic, ref_to(joint.mimics.emplace_back()), at + ".mimic");
      single_mimics_.push_back(joints_read_);
    }
    ++joints_read_;
  }

  void field(const Parsed& json, const scene::OwnerFacts& owner, const FieldInfo& info,
             DataRef member, const std::string& at) {
    if (info.inlined) {
      member.kind() == DataKind::Pose ? pose(json, member, at) : object(json, member, at);
      return;
    }
    const List refers = list_of(owner, info.refers);
    const bool is_reference = member.kind() == DataKind::Ordinal && refers != List::None;
    if (const Parsed* found = find(json, info, is_reference)) {
      read(*found, refers, info, member, place(at, info));
    }
  }

  /// Null where the field has its default.
  static const Parsed* find(const Parsed& json, const FieldInfo& info, bool is_reference) {
    auto found = json.find(std::string(info.name));
    if (found == json.end() && !info.former.empty()) {
      found = json.find(std::string(info.former));
    }
    const bool has_default = found == json.end() || (found->is_null() && !is_reference);
    return has_default ? nullptr : &*found;
  }

  static std::string place(const std::string& at, const FieldInfo& info) {
    return (at.empty() ? "" : at + ".") + std::string(info.name);
  }

  void pose(const Parsed& json, DataRef pose, const std::string& at) {
    static constexpr FieldInfo kPosition{.name = "position", .meaning = ""};
    static constexpr FieldInfo kOrientation{.name = "orientation", .meaning = ""};
    field(json, {}, kPosition, pose.first(), at);
    field(json, {}, kOrientation, pose.second(), at);
  }

  /// `refers`: into which list an index does.
  void read(const Parsed& json, List refers, const FieldInfo& info, DataRef value,
            const std::string& at) {
    switch (value.kind()) {
      case DataKind::Flag:
        flag(json, info, value.as<bool>(), at);
        break;
      case DataKind::Ordinal:
        refers == List::None ? integer(json, value, at) : reference(json, refers, value, at);
        break;
      case DataKind::Word:
        word(json, value, at);
        break;
      case DataKind::Real:
        number(json, value.as<double>(), at);
        break;
      case DataKind::Integer:
        integer(json, value, at);
        break;
      case DataKind::Text:
        json.is_string() ? void(value.as<std::string>() = json.get<std::string>())
                         : fault(at, "is not a string");
        break;
      case DataKind::Path:
        path(json, value.as<Path>(), at);
        break;
      case DataKind::Optional:
        if (!json.is_null()) {
          value.resize(1);
          read(json, refers, info, value[0], at);
        }
        break;
      case DataKind::Struct:
        object(json, value, at);
        break;
      default:
        several(json, refers, info, value, at);
    }
  }

  void several(const Parsed& json, List refers, const FieldInfo& info, DataRef value,
               const std::string& at) {
    if (auto* all = value.get_if<std::vector<scene::VendorSetting>>()) {
      settings(json, *all, at);
    } else if (value.kind() == DataKind::Pose) {
      json.is_object() ? pose(json, value, at) : fault(at, "is not an object");
    } else if (!json.is_array()) {
      fault(at, "is not an array");
    } else if (value.kind() == DataKind::List) {
      value.resize(json.size());
      for (std::size_t i = 0; i < json.size() && !fault_; ++i) {
        read(json[i], refers, info, value[i], at + "[" + std::to_string(i) + "]");
      }
    } else if (value.kind() != DataKind::Pair) {
      fixed(json, value, at);
    } else if (json.size() != 2) {
      fault(at, "is not a pair");
    } else {
      read(json[0], refers, info, value.first(), at + "[0]");
      read(json[1], refers, info, value.second(), at + "[1]");
    }
  }

  /// Rotations, and numbers in a row.
  void fixed(const Parsed& json, DataRef value, const std::string& at) {
    const bool is_rotation = value.kind() == DataKind::Rotation;
    const std::size_t count = is_rotation ? 4 : value.type->count;
    std::vector<double> numbers(json.size());
    for (std::size_t i = 0; i < json.size() && !fault_; ++i) {
      number(json[i], numbers[i], at);
    }
    const bool takes_reals = is_rotation || value.type->item->kind == DataKind::Real;
    if (!fault_ && !takes_reals && !are_whole(numbers)) {
      fault(at, "is not a whole number");
    }
    if (!fault_ && numbers.size() != count) {
      fault(at, "does not have " + std::to_string(count) + " numbers");
    }
    if (fault_) {
      return;
    }
    if (is_rotation) {
      value.as<Quatd>() = {numbers[1], numbers[2], numbers[3], numbers[0]};
      return;
    }
    for (std::size_t i = 0; i < count; ++i) {
      set_number(value[i], numbers[i]);
    }
  }

  void word(const Parsed& json, DataRef value, const std::string& at) {
    const std::string name = json.is_string() ? json.get<std::string>() : std::string();
    const auto& words = value.type->words;
    const auto found = std::find(words.begin(), words.end(), name);
    if (found == words.end()) {
      fault(at, "is not one of its words");
      return;
    }
    set_integer(value, found - words.begin());
  }

  void flag(const Parsed& json, const FieldInfo& info, bool& value, const std::string& at) {
    if (info.on.empty()) {
      json.is_boolean() ? value = json.get<bool>()
                        : (fault(at, "is neither true nor false"), false);
      return;
    }
    const std::string word = json.is_string() ? json.get<std::string>() : std::string();
    if (word != info.on && word != info.off) {
      fault(at, "is not one of its words");
    }
    value = word == info.on;
  }

  void number(const Parsed& json, double& value, const std::string& at) {
    const std::string word = json.is_string() ? json.get<std::string>() : std::string();
    if (json.is_number()) {
      value = json.get<double>();
    } else if (word == "inf" || word == "-inf") {
      value = word == "inf" ? INFINITY : -INFINITY;
    } else if (word == "nan") {
      value = NAN;
    } else {
      fault(at, "is not a number");
    }
  }

  void integer(const Parsed& json, DataRef value, const std::string& at) {
    const bool whole = json.is_number_integer() || json.is_number_unsigned();
    const auto [lowest, highest] = integer_range(*value.type);
    if (!whole || json.get<double>() < lowest || json.get<double>() > highest) {
      fault(at, "is not a whole number of its range");
      return;
    }
    set_integer(value, json.get<std::int64_t>());
  }

  void path(const Parsed& json, Path& value, const std::string& at) {
    if (!json.is_string()) {
      fault(at, "is not a path");
      return;
    }
    const Result<Path> read = Path::parse(json.get<std::string>());
    if (!read) {
      fault(at, "is not a path");
      return;
    }
    value = *read;
  }

  void reference(const Parsed& json, List list, DataRef value, const std::string& at) {
    if (json.is_number()) {
      integer(json, value, at);
      return;
    }
    const auto found = indices_.find({list, json.is_string() ? json.get<std::string>() : ""});
    if (found == indices_.end()) {
      fault(at, "leads to nothing in the scene");
      return;
    }
    value.as<Index>() = found->second;
  }

  void settings(const Parsed& json, std::vector<scene::VendorSetting>& all, const std::string& at) {
    if (!json.is_object()) {
      fault(at, "is not an object");
      return;
    }
    for (const auto& [name, setting] : json.items()) {
      scene::VendorSetting& made = all.emplace_back();
      made.name = name;
      if (setting.is_string()) {
        made.token = setting.get<std::string>();
        continue;
      }
      made.numbers.resize(setting.is_array() ? setting.size() : 0);
      for (std::size_t i = 0; i < made.numbers.size(); ++i) {
        number(setting[i], made.numbers[i], at + "." + name);
      }
    }
  }

  std::map<std::pair<List, std::string>, Index> indices_;
  Index joints_read_ = 0;
  bool pairs_of_colliders_ = false;   ///< up to version 2.4 filters name them one by one
  std::vector<Index> single_mimics_;  ///< joints of version 1.0 that follow another one
  std::optional<Error> fault_;
};

}  // namespace

Result<PhysicsScene> read_scene_json(std::string_view text) {
  if (text.size() > limits::kSceneJson) {
    return Error(ErrorCode::Limit, "the JSON of a physics scene is longer than " +
                                       std::to_string(limits::kSceneJson) + " bytes");
  }
  bool too_deep = false;
  const auto shallow = [&](int depth, Parsed::parse_event_t, Parsed&) {
    too_deep = too_deep || depth > kDepth;
    return depth <= kDepth;
  };
  const Parsed json = Parsed::parse(text.begin(), text.end(), shallow, false);
  if (json.is_discarded() || too_deep) {
    return Error(ErrorCode::Parse, "this is not JSON of a physics scene");
  }
  return Reader().read(json);
}

}  // namespace tenon::answers
