// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// One walk over the tables of fields writes every struct, so a new field needs no code here; values
// computed for readers are added behind the fields. A reference is a path where only one object of
// its list has that path, which is counted beforehand, else an index. Numbers have one form: no
// negative zero, no negative real part of a quaternion, words for values that JSON has no number
// for. The table also says whether a field with its default is written, is null or is omitted
// (scene::Presence).
#include "tenon/answers/scene_json.h"

#include <cmath>
#include <cstdio>
#include <map>

#include "tenon/answers/json_form.h"
#include "tenon/answers/scene_json_value.h"
#include "tenon/scene/fields/data_type.h"
#include "tenon/scene/fields/list_of.h"
#include "tenon/scene/fields/same_fields.h"
#include "tenon/scene/fields/wire_form.h"

namespace tenon::answers {
namespace {

using scene::DataField;
using scene::DataKind;
using scene::DataView;
using scene::FieldInfo;
using scene::Index;
using scene::List;
using scene::PhysicsScene;

/// A number; what JSON has no number for as a word.
Json number(double value) {
  if (std::isfinite(value)) {
    return value + 0.0;  // without the sign of a zero
  }
  return std::isnan(value) ? "nan" : value > 0 ? "inf" : "-inf";
}

Json numbers(const Vec3d& v) { return {number(v[0]), number(v[1]), number(v[2])}; }

/// Real part first and not negative: q and -q are one rotation.
Json rotation(const Quatd& q) {
  const double sign = q.w < 0 ? -1 : 1;
  return {number(sign * q.w), number(sign * q.x), number(sign * q.y), number(sign * q.z)};
}

std::string hex(std::uint64_t value) {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(value));
  return text;
}

/// A key that the row does not have yet; to look for it first costs a walk over all keys.
void append(Json& row, std::string_view key, Json value) {
  row.get_ref<Json::object_t&>().emplace_back(std::string(key), std::move(value));
}

void add_pose(const Pose& pose, Json& row) {
  append(row, "position", numbers(pose.position));
  append(row, "orientation", rotation(pose.orientation));
}

Json settings(const std::vector<scene::VendorSetting>& all) {
  Json rows = Json::object();
  for (const scene::VendorSetting& setting : all) {
    Json list = Json::array();
    for (const double x : setting.numbers) {
      list.push_back(number(x));
    }
    rows[setting.name] = setting.token.empty() ? list : Json(setting.token);
  }
  return rows;
}

void add_bounds(const scene::TriangleMesh& mesh, Json& row) {
  Vec3d low{{INFINITY, INFINITY, INFINITY}};
  Vec3d high = -low;
  for (const Vec3d& p : mesh.points) {
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] = p[i] < low[i] ? p[i] : low[i];
      high[i] = p[i] > high[i] ? p[i] : high[i];
    }
  }
  const bool empty = mesh.points.empty();
  row["lower"] = empty ? Json(nullptr) : numbers(low);
  row["upper"] = empty ? Json(nullptr) : numbers(high);
}

/// What a track changes, where that is one thing.
std::string_view changing(DataView track) {
  return track.is_a<scene::PoseTrack>()      ? "pose"
         : track.is_a<scene::BoundsTrack>()  ? "limits"
         : track.is_a<scene::GravityTrack>() ? "gravity"
         : track.is_a<scene::ShapesTrack>()  ? "shapes"
         : find_field(*track.type, "states") ? "state"
                                             : "";
}

void name_shapes(const PhysicsScene& scene, const scene::ShapesTrack& track, Json& row) {
  for (const Index i : track.colliders) {
    row["colliders"].push_back(scene.colliders[i].path.str());
  }
  row["lastMass"] = number(track.shapes.back().mass);
  row["lastCenterOfMass"] = numbers(track.shapes.back().center_of_mass);
}

void name_switch(const scene::SwitchTrack& track, Json& row) {
  const List list = facts_of(view_of(track)).switched;
  const Json object = row["object"];
  row = Json::object();
  row[list == List::Bodies ? "body" : list == List::Colliders ? "collider" : "joint"] = object;
  row["value"] = track.what == scene::Switch::BodyKinematic    ? "kinematic"
                 : track.what == scene::Switch::JointCollision ? "collisionEnabled"
                                                               : "enabled";
}

void name_value(const PhysicsScene& scene, DataView track, Json& row) {
  if (const std::string_view what = changing(track); !what.empty()) {
    row["value"] = std::string(what);
  }
  if (const auto* poses = track.get_if<scene::PoseTrack>(); poses != nullptr && !poses->joint) {
    row.erase("side");
  }
  if (const auto* shapes = track.get_if<scene::ShapesTrack>()) {
    name_shapes(scene, *shapes, row);
  }
  if (const auto* switched = track.get_if<scene::SwitchTrack>()) {
    name_switch(*switched, row);
  }
}

class Writer {
 public:
  Writer(const PhysicsScene& scene, Geometry geometry) : scene_(scene), geometry_(geometry) {
    for (const List list : {List::Scenes, List::Bodies, List::Colliders, List::Materials,
                            List::Joints, List::Articulations, List::Tendons, List::Actuators}) {
      for (Index i = 0; i < size_of(scene, list); ++i) {
        ++times_[{list, path_of(scene, list, i)}];
      }
    }
  }

  Json whole() { return object(view_of(scene_)); }

 private:
  Json object(DataView value) {
    Json row = Json::object();
    // A row that grows copies all of its keys; most have a few derived values, too.
    row.get_ref<Json::object_t&>().reserve(value.type->fields.size() + 6);
    if (!value.is_a<scene::TriangleMesh>() || geometry_ == Geometry::Inline) {
      add_fields(value, row);
    }
    add_derived(value, row);
    return row;
  }

  void add_fields(DataView of, Json& row) {
    const DataView plain{of.type, of.type->plain};
    const scene::OwnerFacts owner = facts_of(of);
    for (const DataField& field : of.type->fields) {
      const DataView value = of.member(field);
      if (field.info->inlined) {
        value.kind() == DataKind::Pose ? add_pose(value.as<Pose>(), row) : add_fields(value, row);
      } else if (is_written(of, *field.info, value, plain.member(field))) {
        const List refers = list_of(owner, field.info->refers);
        append(row, field.info->name,
               is_boundless(value, plain.member(field)) ? Json(nullptr)
                                                        : json(refers, *field.info, value));
      } else if (field.info->presence == scene::Presence::Null) {
        append(row, field.info->name, nullptr);
      }
    }
  }

  /// A number that JSON cannot express, written as null.
  static bool is_boundless(DataView value, DataView plain) {
    return value.kind() == DataKind::Real && !std::isfinite(value.as<double>()) &&
           value.as<double>() == plain.as<double>();
  }

  /// Not where it says no more than its absence or null.
  static bool is_written(DataView of, const FieldInfo& info, DataView value, DataView plain) {
    return info.presence == scene::Presence::Always || counts(of, info) || !same_data(value, plain);
  }

  /// `refers`: into which list an index does.
  Json json(List refers, const FieldInfo& info, DataView value) {
    switch (value.kind()) {
      case DataKind::Flag: {
        const bool on = value.as<bool>();
        return info.on.empty() ? Json(on) : Json(std::string(on ? info.on : info.off));
      }
      case DataKind::Ordinal:
        return refers == List::None ? Json(value.as<Index>())
                                    : reference(refers, value.as<Index>());
      case DataKind::Word:
        return std::string(word_of(value));
      case DataKind::Real:
        return number(value.as<double>());
      case DataKind::Integer:
        return static_cast<int>(number_of(value));
      case DataKind::Text:
        return value.as<std::string>();
      case DataKind::Path:
        return value.as<Path>().empty() ? Json(nullptr) : Json(value.as<Path>().str());
      case DataKind::Optional:
        return value.size() != 0 ? json(refers, info, value[0]) : Json(nullptr);
      case DataKind::Rotation:
        return rotation(value.as<Quatd>());
      case DataKind::Struct:
        return object(value);
      default:
        return several(refers, info, value);
    }
  }

  Json several(List refers, const FieldInfo& info, DataView value) {
    if (value.kind() == DataKind::Pose) {
      Json row = Json::object();
      add_pose(value.as<Pose>(), row);
      return row;
    }
    if (value.kind() == DataKind::Pair) {
      return {json(refers, info, value.first()), json(refers, info, value.second())};
    }
    if (const auto* all = value.get_if<std::vector<scene::VendorSetting>>()) {
      return settings(*all);
    }
    Json list = Json::array();
    list.get_ref<Json::array_t&>().reserve(value.size());
    for (std::size_t i = 0; i < value.size(); ++i) {
      list.push_back(json(refers, info, value[i]));
    }
    return list;
  }

  Json reference(List list, Index index) const {
    if (list == List::Meshes) {
      return index;
    }
    const Path path = path_of(scene_, list, index);
    const auto times = times_.find({list, path});
    if (times == times_.end() || times->second != 1) {
      return index;
    }
    return path.empty() ? Json(nullptr) : Json(path.str());
  }

  // What follows from fields.

  void add_derived(DataView value, Json& row) {
    if (const auto* mesh = value.get_if<scene::TriangleMesh>()) {
      add_derived(*mesh, row);
    } else if (const auto* collider = value.get_if<scene::Collider>()) {
      add_derived(*collider, row);
    } else if (const auto* limit = value.get_if<scene::Limit>()) {
      row["locked"] = limit->locked();
    } else if (const auto* joint = value.get_if<scene::Joint>()) {
      add_derived(*joint, row);
    } else if (const auto* scene = value.get_if<PhysicsScene>()) {
      add_derived(*scene, row);
    }
  }

  void add_derived(const scene::TriangleMesh& mesh, Json& row) {
    row["hash"] = hex(mesh_hash(mesh));
    row["pointCount"] = mesh.points.size();
    row["triangleCount"] = mesh.triangles.size();
    add_bounds(mesh, row);
  }
  void add_derived(const scene::Collider& collider, Json& row) {
    const scene::Shape& shape = collider.shape;
    if (shape.kind != scene::ShapeKind::ConvexHull && shape.kind != scene::ShapeKind::Mesh) {
      return;
    }
    const scene::TriangleMesh& mesh = scene_.meshes[shape.mesh];
    row["points"] = mesh.points.size();
    row["triangles"] = mesh.triangles.size();
    add_bounds(mesh, row);
    row["flat"] = mesh.flat;
    if (!shape.pieces.empty()) {
      row["pieces"] = shape.pieces.size();
    }
  }
  void add_derived(const scene::Joint& joint, Json& row) {
    row["locked"] = joint.lower > joint.upper;
    append(row, "mimic",
           joint.mimics.empty() ? Json(nullptr) : object(view_of(joint.mimics.front())));
  }
  void add_derived(const PhysicsScene& scene, Json& row) {
    row["schemaVersion"] = std::string(kSceneSchemaVersion);
    const scene::ColliderPairs apart = scene.disabled_pairs();
    row["disabledPairs"] = Json::array();
    for (const auto& [a, b] : apart.pairs) {
      row["disabledPairs"].push_back(
          {scene.colliders[a].path.str(), scene.colliders[b].path.str()});
    }
    row["disabledPairsCut"] = apart.is_cut;
    row["animated"] = animated();
  }

  /// A row for each track: of what, how many samples.
  Json animated() {
    Json rows = Json::array();
    const DataView scene = view_of(scene_);
    for (const DataField& field : scene.type->fields) {
      const bool are_tracks =
          is_struct_list(*field.type) && find_field(*field.type->item, "times") != nullptr;
      const DataView list = scene.member(field);
      for (std::size_t i = 0; are_tracks && i < list.size(); ++i) {
        rows.push_back(track_row(list[i]));
      }
    }
    if (!scene_.nesting_states.empty()) {
      rows.push_back({{"value", "nesting"},
                      {"states", nesting()},
                      {"samples", scene_.nesting_states.size()},
                      {"held", true}});
    }
    if (!scene_.group_states.empty()) {
      rows.push_back(
          {{"value", "collisionGroups"}, {"samples", scene_.group_states.size()}, {"held", true}});
    }
    return rows;
  }

  Json nesting() {
    Json states = Json::array();
    for (const scene::NestingState& state : scene_.nesting_states) {
      Json row = object(view_of(state));
      row["masses"] = Json::array();
      for (const auto& [body, mass] : state.masses) {
        Json entry = {{"body", reference(List::Bodies, body)}};
        entry.update(object(view_of(mass)));
        row["masses"].push_back(std::move(entry));
      }
      states.push_back(std::move(row));
    }
    return states;
  }

  Json track_row(DataView track) {
    Json row = Json::object();
    const scene::OwnerFacts owner = facts_of(track);
    for (const DataField& field : track.type->fields) {
      const DataView value = track.member(field);
      const bool is_there = value.kind() != DataKind::Optional || value.size() != 0;
      if (value.kind() != DataKind::List && is_there) {
        row[std::string(field.info->name)] =
            json(list_of(owner, field.info->refers), *field.info, value);
      }
    }
    name_value(scene_, track, row);
    const DataField* held = find_field(*track.type, "held");
    row["samples"] = track.member(*find_field(*track.type, "times")).size();
    row["held"] = held == nullptr || track.member(*held).as<bool>();
    return row;
  }

  const PhysicsScene& scene_;
  Geometry geometry_;
  std::map<std::pair<List, Path>, std::size_t> times_;
};

}  // namespace

Json scene_json_value(const PhysicsScene& scene, Geometry geometry) {
  return Writer(scene, geometry).whole();
}

std::string scene_json(const PhysicsScene& scene, Geometry geometry) {
  return on_one_line(scene_json_value(scene, geometry));
}

}  // namespace tenon::answers
