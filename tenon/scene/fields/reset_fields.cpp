// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Engines name what they cannot express in words of their own or by the attribute; the last part of
// that is looked for among the fields of the object at the path, however deep they lie.
#include <algorithm>
#include <cctype>
#include <cstddef>

#include "tenon/scene/fields/field_pairs.h"
#include "tenon/scene/fields/scene_patch.h"

namespace tenon::scene {
namespace {

/// The last part of "physxJoint:armature" in small letters.
std::string plain_name(std::string_view name) {
  const std::size_t colon = name.find_last_of(":. ");
  std::string plain(name.substr(colon == std::string_view::npos ? 0 : colon + 1));
  std::transform(plain.begin(), plain.end(), plain.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return plain;
}

/// Calls `visit(name, value of a new object, value)` for each field of an object, those of structs
/// in its lists included; a list is also a field itself.
template <class T, class Visit>
void each_resettable(const T& fresh, T& object, const std::string& around, Visit& visit) {
  each_field_of_pair(fresh, object, [&](const FieldInfo& info, const auto& x, auto& y) {
    using Value = std::remove_cvref_t<decltype(y)>;
    if (!acts(info)) {
      return;
    }
    if constexpr (HasTable<Value>) {
      each_resettable(x, y, joined(around, info), visit);
    } else {
      if constexpr (is_struct_list<Value>()) {
        const typename Value::value_type fresh_item{};
        for (auto& item : y) {
          each_resettable(fresh_item, item, joined(around, info), visit);
        }
      }
      visit(joined(around, info), x, y);
    }
  });
}

/// Fields of one object whose names answer to one that is asked for: of those whose last part is
/// the name the outermost, else all that begin with it.
class Answering {
 public:
  Answering(std::string_view property, Path object)
      : name_(plain_name(property)), object_(object) {}

  template <class T>
  void look(std::string_view list, const T& object) {
    T like = object;
    auto offer_each = [&](const std::string& name, const auto&, const auto&) { offer(list, name); };
    each_resettable(T{}, like, "", offer_each);
  }

  std::vector<FieldPatch> take() {
    return exact_.empty() ? std::move(beginning_) : std::move(exact_);
  }

 private:
  void offer(std::string_view list, const std::string& name) {
    const std::string plain = plain_name(name);
    const auto depth = std::count(name.begin(), name.end(), '.');
    if (plain == name_) {
      if (!exact_.empty() && depth < depth_) {
        exact_.clear();
      }
      if (exact_.empty() || depth == depth_) {
        depth_ = depth;
        add(exact_, list, name);
      }
    } else if (plain.starts_with(name_)) {
      add(beginning_, list, name);
    }
  }

  void add(std::vector<FieldPatch>& to, std::string_view list, const std::string& name) {
    if (std::none_of(to.begin(), to.end(),
                     [&](const FieldPatch& known) { return known.field == name; })) {
      to.push_back({std::string(list), name, {object_}});
    }
  }

  std::string name_;
  Path object_;
  std::ptrdiff_t depth_ = 0;
  std::vector<FieldPatch> exact_;
  std::vector<FieldPatch> beginning_;
};

bool is_of(const FieldPatch& patch, Path path) {
  return std::find(patch.objects.begin(), patch.objects.end(), path) != patch.objects.end();
}

template <class T>
bool stop_acting(T&) {
  return false;
}
bool stop_acting(MujocoActuator& actuator) {
  actuator.kind = MujocoActuator::Target::None;
  actuator.fault = "left out";
  return true;
}
bool stop_acting(Tendon& tendon) {
  tendon.stiffness = tendon.damping = tendon.friction = tendon.armature = 0;
  tendon.range.reset();
  tendon.settings.clear();
  return true;
}

template <class T>
bool reset_object(const FieldPatch& patch, T& object) {
  if (patch.field.empty()) {
    return stop_acting(object);
  }
  bool done = false;
  auto reset_named = [&](const std::string& name, const auto& fresh, auto& value) {
    if (name == patch.field) {
      value = fresh;
      done = true;
    }
  };
  each_resettable(T{}, object, "", reset_named);
  return done;
}

}  // namespace

std::vector<FieldPatch> fields_named(const PhysicsScene& scene, Path path,
                                     std::string_view property) {
  std::vector<FieldPatch> whole;
  Answering answering(property, path);
  each_field(scene, [&](const FieldInfo& info, const auto& list) {
    using T = std::remove_cvref_t<decltype(list)>;
    if constexpr (is_struct_list<T>()) {
      if constexpr (requires(typename T::value_type object) { object.path.str(); }) {
        for (const auto& object : list) {
          if (object.path != path) {
            continue;
          }
          using Object = typename T::value_type;
          constexpr bool kStops =
              std::is_same_v<Object, Tendon> || std::is_same_v<Object, MujocoActuator>;
          if (property.empty() && kStops) {
            whole.push_back({std::string(info.name), "", {path}});
          } else if (!property.empty()) {
            answering.look(info.name, object);
          }
        }
      }
    }
  });
  return property.empty() ? whole : answering.take();
}

bool reset(const FieldPatch& patch, PhysicsScene& scene) {
  bool done = false;
  each_field(scene, [&](const FieldInfo& info, auto& list) {
    using T = std::remove_cvref_t<decltype(list)>;
    if constexpr (is_struct_list<T>()) {
      if constexpr (requires(typename T::value_type object) { object.path.str(); }) {
        for (auto& object : list) {
          if (is_named(patch, info) && is_of(patch, object.path)) {
            done = reset_object(patch, object) || done;
          }
        }
      }
    }
  });
  return done;
}

}  // namespace tenon::scene
