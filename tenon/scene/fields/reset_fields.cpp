// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Engines name what they cannot express in words of their own or by the attribute; the last part of
// that is looked for among the fields of the object at the path, however deep they lie.
#include <algorithm>
#include <cctype>
#include <cstddef>

#include "tenon/scene/fields/patched_fields.h"
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

struct Resettable {
  std::string name;
  DataView plain;  ///< of a new object
  DataRef value;
};

/// All fields of an object, those of structs in its lists included; a list is also a field itself.
void add_resettable(DataView plain, DataRef object, const std::string& around,
                    std::vector<Resettable>& found) {
  for (const DataField& field : plain.type->fields) {
    if (!acts(*field.info)) {
      continue;
    }
    const std::string name = joined(around, *field.info);
    const DataRef value = object.member(field);
    if (value.kind() == DataKind::Struct) {
      add_resettable(plain.member(field), value, name, found);
      continue;
    }
    for (std::size_t i = 0; is_struct_list(*value.type) && i < value.size(); ++i) {
      add_resettable({value.type->item, value.type->item->plain}, value[i], name, found);
    }
    found.push_back({name, plain.member(field), value});
  }
}

std::vector<Resettable> resettable(DataRef object) {
  std::vector<Resettable> found;
  add_resettable({object.type, object.type->plain}, object, "", found);
  return found;
}

/// Fields of one object whose names answer to one that is asked for: of those whose last part is
/// the name the outermost, else all that begin with it.
class Answering {
 public:
  Answering(std::string_view property, Path object)
      : name_(plain_name(property)), object_(object) {}

  void look(std::string_view list, DataView object) {
    // Names alone are asked for; nothing is changed.
    for (const Resettable& field : resettable({object.type, const_cast<void*>(object.at)})) {
      offer(list, field.name);
    }
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

bool stops(const DataType& type) { return type.is_a<MujocoActuator>() || type.is_a<Tendon>(); }

bool stop_acting(DataRef object) {
  if (MujocoActuator* actuator = object.get_if<MujocoActuator>()) {
    actuator->kind = MujocoActuator::Target::None;
    actuator->fault = "skipped";
  } else if (Tendon* tendon = object.get_if<Tendon>()) {
    tendon->stiffness = tendon->damping = tendon->friction = tendon->armature = 0;
    tendon->range.reset();
    tendon->settings.clear();
  }
  return stops(*object.type);
}

bool reset_object(const FieldPatch& patch, DataRef object) {
  if (patch.field.empty()) {
    return stop_acting(object);
  }
  bool done = false;
  for (const Resettable& field : resettable(object)) {
    if (field.name == patch.field) {
      field.value.assign(field.plain);
      done = true;
    }
  }
  return done;
}

/// Lists of objects that have paths.
bool has_paths(const DataType& list) {
  return is_struct_list(list) && find_field(*list.item, "path") != nullptr;
}

}  // namespace

std::vector<FieldPatch> fields_named(const PhysicsScene& scene, Path path,
                                     std::string_view property) {
  std::vector<FieldPatch> whole;
  Answering answering(property, path);
  const DataView lists = view_of(scene);
  for (const DataField& field : lists.type->fields) {
    const DataView list = lists.member(field);
    for (std::size_t i = 0; has_paths(*field.type) && i < list.size(); ++i) {
      if (*path_of(list[i]) != path) {
        continue;
      }
      if (property.empty() && stops(*list.type->item)) {
        whole.push_back({std::string(field.info->name), "", {path}});
      } else if (!property.empty()) {
        answering.look(field.info->name, list[i]);
      }
    }
  }
  return property.empty() ? whole : answering.take();
}

bool reset(const FieldPatch& patch, PhysicsScene& scene) {
  bool done = false;
  const DataRef lists = ref_to(scene);
  for (const DataField& field : lists.type->fields) {
    const DataRef list = lists.member(field);
    for (std::size_t i = 0; has_paths(*field.type) && i < list.size(); ++i) {
      if (is_named(patch, *field.info) && is_of(patch, *path_of(list[i]))) {
        done = reset_object(patch, list[i]) || done;
      }
    }
  }
  return done;
}

}  // namespace tenon::scene
