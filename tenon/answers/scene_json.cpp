// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// One walk over the tables of fields writes every struct, so a new field needs no code here; what
// is worked out for readers is added behind the fields. A reference is a path where only one object
// of its list has that path, which is counted beforehand, else an index. Numbers have one form: no
// negative zero, no negative real part of a quaternion, words for what JSON has no number for. The
// table also says whether a field with its default is written, is null or is left out
// (scene::Presence).
#include "tenon/answers/scene_json.h"

#include <cmath>
#include <cstdio>
#include <map>
#include <optional>
#include <type_traits>

#include "tenon/answers/json_form.h"
#include "tenon/answers/scene_json_value.h"
#include "tenon/base/wire.h"
#include "tenon/scene/fields/enum_names.h"
#include "tenon/scene/fields/list_of.h"
#include "tenon/scene/fields/same_fields.h"
#include "tenon/scene/fields/wire_form.h"

namespace tenon::answers {
namespace {

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

template <class Track>
bool is_held(const Track& track) {
  if constexpr (requires { track.held; }) {
    return track.held;
  } else {
    return true;
  }
}

template <class Track>
void name_value(const PhysicsScene&, const Track&, Json&) {}
void name_value(const PhysicsScene&, const scene::PoseTrack& track, Json& row) {
  row["value"] = "pose";
  if (!track.joint) {
    row.erase("side");
  }
}
void name_value(const PhysicsScene&, const scene::BoundsTrack&, Json& row) {
  row["value"] = "limits";
}
void name_value(const PhysicsScene&, const scene::GravityTrack&, Json& row) {
  row["value"] = "gravity";
}
template <class Object>
void name_value(const PhysicsScene&, const scene::ObjectTrack<Object>&, Json& row) {
  row["value"] = "state";
}
void name_value(const PhysicsScene& scene, const scene::ShapesTrack& track, Json& row) {
  row["value"] = "shapes";
  for (const Index i : track.colliders) {
    row["colliders"].push_back(scene.colliders[i].path.str());
  }
  row["lastMass"] = number(track.shapes.back().mass);
  row["lastCenterOfMass"] = numbers(track.shapes.back().center_of_mass);
}
void name_value(const PhysicsScene&, const scene::SwitchTrack& track, Json& row) {
  const List list = list_of(track, List::BySwitch);
  const Json object = row["object"];
  row = Json::object();
  row[list == List::Bodies ? "body" : list == List::Colliders ? "collider" : "joint"] = object;
  row["value"] = track.what == scene::Switch::BodyKinematic    ? "kinematic"
                 : track.what == scene::Switch::JointCollision ? "collisionEnabled"
                                                               : "enabled";
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

  Json whole() { return object(scene_); }

 private:
  template <class T>
  Json object(const T& value) {
    Json row = Json::object();
    if constexpr (scene::HasTable<T>) {
      // A row that grows copies all of its keys; most have a few derived values, too.
      row.get_ref<Json::object_t&>().reserve(scene::kFieldCount<T> + 6);
    }
    if constexpr (std::is_same_v<T, scene::TriangleMesh>) {
      if (geometry_ == Geometry::Hash) {
        add_derived(value, row);
        return row;
      }
    }
    add_fields(value, row);
    add_derived(value, row);
    return row;
  }

  template <class T>
  void add_fields(const T& of, Json& row) {
    static const T kDefault{};
    each_field_of_both(of, kDefault,
                       [&](const FieldInfo& info, const auto& value, const auto& plain) {
                         add_field(of, info, value, plain, row);
                       });
  }

  template <class Owner, class T>
  void add_field(const Owner& of, const FieldInfo& info, const T& value, const T& plain,
                 Json& row) {
    if constexpr (std::is_same_v<T, Pose>) {
      if (info.inlined) {
        add_pose(value, row);
        return;
      }
    } else if constexpr (scene::HasTable<T>) {
      if (info.inlined) {
        add_fields(value, row);
        return;
      }
    }
    if (info.presence != scene::Presence::Always && !counts(of, info) &&
        scene::same_fields(value, plain)) {
      if (info.presence == scene::Presence::Null) {
        append(row, info.name, nullptr);
      }
      return;
    }
    Json written = json(list_of(of, info.refers), info, value);
    if constexpr (std::is_same_v<T, double>) {
      written = !std::isfinite(value) && value == plain ? Json(nullptr) : written;
    }
    append(row, info.name, std::move(written));
  }

  /// `refers`: into which list an index does.
  template <class T>
  Json json(List refers, const FieldInfo& info, const T& value) {
    if constexpr (std::is_same_v<T, bool>) {
      return info.on.empty() ? Json(value) : Json(std::string(value ? info.on : info.off));
    } else if constexpr (std::is_same_v<T, Index>) {
      return refers == List::None ? Json(value) : reference(refers, value);
    } else if constexpr (std::is_enum_v<T>) {
      return std::string(name_of(value));
    } else if constexpr (std::is_same_v<T, double>) {
      return number(value);
    } else if constexpr (std::is_arithmetic_v<T>) {
      return static_cast<int>(value);
    } else if constexpr (std::is_same_v<T, std::string>) {
      return value;
    } else if constexpr (std::is_same_v<T, Path>) {
      return value.empty() ? Json(nullptr) : Json(value.str());
    } else if constexpr (wire::kIsOptional<T>) {
      return value ? json(refers, info, *value) : Json(nullptr);
    } else if constexpr (std::is_same_v<T, std::vector<scene::VendorSetting>>) {
      return settings(value);
    } else if constexpr (wire::kIsPair<T>) {
      return {json(refers, info, value.first), json(refers, info, value.second)};
    } else if constexpr (wire::kIsVector<T> || wire::kIsArray<T>) {
      Json list = Json::array();
      for (const auto& item : value) {
        list.push_back(json(refers, info, item));
      }
      return list;
    } else {
      return composite(refers, info, value);
    }
  }

  template <class T>
  Json composite(List refers, const FieldInfo& info, const T& value) {
    if constexpr (scene::HasTable<T>) {
      return object(value);
    } else if constexpr (std::is_same_v<T, Quatd>) {
      return rotation(value);
    } else if constexpr (std::is_same_v<T, Pose>) {
      Json row = Json::object();
      add_pose(value, row);
      return row;
    } else if constexpr (requires { value.v; }) {
      return json(refers, info, value.v);
    } else {
      Json list = Json::array();  // matrices, by rows
      for (const auto& row : value.m) {
        for (const double x : row) {
          list.push_back(number(x));
        }
      }
      return list;
    }
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

  template <class T>
  void add_derived(const T&, Json&) {}

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
  void add_derived(const scene::Limit& limit, Json& row) { row["locked"] = limit.locked(); }
  void add_derived(const scene::Joint& joint, Json& row) {
    row["locked"] = joint.lower > joint.upper;
    append(row, "mimic", joint.mimics.empty() ? Json(nullptr) : object(joint.mimics.front()));
  }
  void add_derived(const PhysicsScene& scene, Json& row) {
    row["schemaVersion"] = std::string(kSceneSchemaVersion);
    row["disabledPairs"] = Json::array();
    for (const auto& [a, b] : scene.disabled_pairs()) {
      row["disabledPairs"].push_back(
          {scene.colliders[a].path.str(), scene.colliders[b].path.str()});
    }
    row["animated"] = animated();
  }

  /// A row for each track: of what, how many samples.
  Json animated() {
    Json rows = Json::array();
    each_field(scene_, [&](const FieldInfo&, const auto& list) {
      using T = std::remove_cvref_t<decltype(list)>;
      if constexpr (wire::kIsVector<T>) {
        if constexpr (requires { list.front().times.size(); }) {
          for (const auto& track : list) {
            rows.push_back(track_row(track));
          }
        }
      }
    });
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
      Json row = object(state);
      row["masses"] = Json::array();
      for (const auto& [body, mass] : state.masses) {
        Json entry = {{"body", reference(List::Bodies, body)}};
        entry.update(object(mass));
        row["masses"].push_back(std::move(entry));
      }
      states.push_back(std::move(row));
    }
    return states;
  }

  template <class Track>
  Json track_row(const Track& track) {
    Json row = Json::object();
    each_field(track, [&](const FieldInfo& info, const auto& value) {
      using T = std::remove_cvref_t<decltype(value)>;
      if constexpr (!wire::kIsVector<T>) {
        if (!wire::kIsOptional<T> || !scene::same_fields(value, T{})) {
          row[std::string(info.name)] = json(list_of(track, info.refers), info, value);
        }
      }
    });
    name_value(scene_, track, row);
    row["samples"] = track.times.size();
    row["held"] = is_held(track);
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
  return scene_json_value(scene, geometry).dump();
}

}  // namespace tenon::answers
