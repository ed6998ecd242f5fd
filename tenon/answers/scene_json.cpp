// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// One walk over the tables of fields writes every struct, so a new field needs no code here; values
// computed for readers are added behind the fields. It writes into a sink, which makes a value or
// text: text is handed on in pieces, so that a scene of many bodies takes no memory for it. A
// reference is a path where only one object of its list has that path, which is counted beforehand,
// else an index. Numbers have one form: no negative zero, no negative real part of a quaternion,
// words for values that JSON has no number for. The table also says whether a field with its
// default is written, is null or is omitted (scene::Presence).
#include "tenon/answers/scene_json.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <unordered_map>

#include "tenon/answers/dump/json_sink.h"
#include "tenon/answers/json_form.h"
#include "tenon/answers/scene_json_value.h"
#include "tenon/base/limits/reading_limits.h"
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

std::string hex(std::uint64_t value) {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(value));
  return text;
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

void name_switch(const scene::SwitchTrack& track, Json& row) {
  const List list = facts_of(view_of(track)).switched;
  const Json object = row["object"];
  row = Json::object();
  row[list == List::Bodies ? "body" : list == List::Colliders ? "collider" : "joint"] = object;
  row["value"] = track.what == scene::Switch::BodyKinematic    ? "kinematic"
                 : track.what == scene::Switch::JointCollision ? "collisionEnabled"
                                                               : "enabled";
}

/// A number that JSON cannot express, written as null.
bool is_boundless(DataView value, DataView plain) {
  return value.kind() == DataKind::Real && !std::isfinite(value.as<double>()) &&
         value.as<double>() == plain.as<double>();
}

/// Not where it says no more than its absence or null.
bool is_written(DataView of, const FieldInfo& info, DataView value, DataView plain) {
  return info.presence == scene::Presence::Always || counts(of, info) || !same_data(value, plain);
}

/// By which name an object of a scene is referred to.
class References {
 public:
  explicit References(const PhysicsScene& scene) : scene_(scene) {
    for (const List list : {List::Scenes, List::Bodies, List::Colliders, List::Materials,
                            List::Joints, List::Articulations, List::Tendons, List::Actuators}) {
      for (Index i = 0; i < size_of(scene, list); ++i) {
        ++times_[static_cast<std::size_t>(list)][path_of(scene, list, i)];
      }
    }
  }

  const PhysicsScene& scene() const { return scene_; }

  /// The path, where no other object of the list has it.
  std::optional<Path> path(List list, Index index) const {
    if (list == List::Meshes) {
      return std::nullopt;
    }
    const Path path = path_of(scene_, list, index);
    const auto& times = times_[static_cast<std::size_t>(list)];
    const auto found = times.find(path);
    return found != times.end() && found->second == 1 ? std::optional(path) : std::nullopt;
  }

 private:
  static constexpr std::size_t kLists = static_cast<std::size_t>(List::BySwitch) + 1;

  const PhysicsScene& scene_;
  std::array<std::unordered_map<Path, std::size_t>, kLists> times_;
};

/// A number; what JSON has no number for as a word.
template <class Sink>
void put_number(Sink& sink, double value) {
  if (std::isfinite(value)) {
    return sink.put(value + 0.0);  // without the sign of a zero
  }
  sink.put(std::isnan(value) ? "nan" : value > 0 ? "inf" : "-inf");
}

template <class Sink>
void put_path(Sink& sink, Path path) {
  path.empty() ? sink.put(nullptr) : sink.put(path.str());
}

template <class Sink>
void put_vector(Sink& sink, const Vec3d& v) {
  sink.begin_array();
  for (std::size_t i = 0; i < 3; ++i) {
    put_number(sink, v[i]);
  }
  sink.end_array();
}

/// Real part first and not negative: q and -q are one rotation.
template <class Sink>
void put_rotation(Sink& sink, const Quatd& q) {
  const double sign = q.w < 0 ? -1 : 1;
  sink.begin_array();
  for (const double part : {q.w, q.x, q.y, q.z}) {
    put_number(sink, sign * part);
  }
  sink.end_array();
}

/// As members.
template <class Sink>
void put_pose(Sink& sink, const Pose& pose) {
  sink.key("position");
  put_vector(sink, pose.position);
  sink.key("orientation");
  put_rotation(sink, pose.orientation);
}

/// As members.
template <class Sink>
void put_bounds(Sink& sink, const scene::TriangleMesh& mesh) {
  Vec3d low{{INFINITY, INFINITY, INFINITY}};
  Vec3d high = -low;
  for (const Vec3d& p : mesh.points) {
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] = p[i] < low[i] ? p[i] : low[i];
      high[i] = p[i] > high[i] ? p[i] : high[i];
    }
  }
  const bool empty = mesh.points.empty();
  sink.key("lower");
  empty ? sink.put(nullptr) : put_vector(sink, low);
  sink.key("upper");
  empty ? sink.put(nullptr) : put_vector(sink, high);
}

/// What `write(sink)` writes, as a value, for what is looked at once more before it goes out.
template <class Write>
Json made(Write write) {
  JsonValueSink sink;
  write(sink);
  return sink.take();
}

template <class Sink>
class Writer {
 public:
  Writer(const References& references, Geometry geometry, Sink& sink)
      : references_(references), scene_(references.scene()), geometry_(geometry), sink_(sink) {}

  void object(DataView value) {
    sink_.begin_object();
    members(value);
    sink_.end_object();
  }

  void members(DataView value) {
    if (!value.is_a<scene::TriangleMesh>() || geometry_ == Geometry::Inline) {
      fields(value);
    }
    derived(value);
  }

 private:
  void fields(DataView of) {
    const DataView plain{of.type, of.type->plain};
    const scene::OwnerFacts owner = facts_of(of);
    for (const DataField& field : of.type->fields) {
      const DataView value = of.member(field);
      if (field.info->inlined) {
        value.kind() == DataKind::Pose ? put_pose(sink_, value.as<Pose>()) : fields(value);
      } else if (is_written(of, *field.info, value, plain.member(field))) {
        sink_.key(field.info->name);
        is_boundless(value, plain.member(field))
            ? sink_.put(nullptr)
            : json(list_of(owner, field.info->refers), *field.info, value);
      } else if (field.info->presence == scene::Presence::Null) {
        sink_.key(field.info->name);
        sink_.put(nullptr);
      }
    }
  }

  /// `refers`: into which list an index does.
  void json(List refers, const FieldInfo& info, DataView value) {
    switch (value.kind()) {
      case DataKind::Flag:
        return info.on.empty() ? sink_.put(value.as<bool>())
                               : sink_.put(value.as<bool>() ? info.on : info.off);
      case DataKind::Ordinal:
        return refers == List::None ? sink_.put(std::uint64_t{value.as<Index>()})
                                    : reference(refers, value.as<Index>());
      case DataKind::Word:
        return sink_.put(std::string_view(word_of(value)));
      case DataKind::Real:
        return put_number(sink_, value.as<double>());
      case DataKind::Integer:
        return sink_.put(std::int64_t{static_cast<int>(number_of(value))});
      case DataKind::Text:
        return sink_.put(value.as<std::string>());
      case DataKind::Path:
        return put_path(sink_, value.as<Path>());
      case DataKind::Optional:
        return value.size() != 0 ? json(refers, info, value[0]) : sink_.put(nullptr);
      case DataKind::Rotation:
        return put_rotation(sink_, value.as<Quatd>());
      case DataKind::Struct:
        return object(value);
      default:
        return several(refers, info, value);
    }
  }

  void several(List refers, const FieldInfo& info, DataView value) {
    if (value.kind() == DataKind::Pose) {
      sink_.begin_object();
      put_pose(sink_, value.as<Pose>());
      return sink_.end_object();
    }
    if (const auto* all = value.get_if<std::vector<scene::VendorSetting>>()) {
      return settings(*all);
    }
    sink_.begin_array();
    if (value.kind() == DataKind::Pair) {
      json(refers, info, value.first());
      json(refers, info, value.second());
    } else {
      const std::size_t count = value.size();
      for (std::size_t i = 0; i < count; ++i) {
        json(refers, info, value[i]);
      }
    }
    sink_.end_array();
  }

  /// Of two with one name the last counts.
  void settings(const std::vector<scene::VendorSetting>& all) {
    Json rows = Json::object();
    for (const scene::VendorSetting& setting : all) {
      const auto numbers = [&](auto& sink) {
        sink.begin_array();
        for (const double x : setting.numbers) {
          put_number(sink, x);
        }
        sink.end_array();
      };
      rows[setting.name] = setting.token.empty() ? made(numbers) : Json(setting.token);
    }
    sink_.put(rows);
  }

  void reference(List list, Index index) {
    const std::optional<Path> unique = references_.path(list, index);
    unique ? put_path(sink_, *unique) : sink_.put(std::uint64_t{index});
  }

  /// The same for a value.
  Writer<JsonValueSink> into(JsonValueSink& sink) const { return {references_, geometry_, sink}; }

  // What follows from fields.

  void derived(DataView value) {
    if (const auto* mesh = value.get_if<scene::TriangleMesh>()) {
      derived(*mesh);
    } else if (const auto* collider = value.get_if<scene::Collider>()) {
      derived(*collider);
    } else if (const auto* limit = value.get_if<scene::Limit>()) {
      member("locked", limit->locked());
    } else if (const auto* joint = value.get_if<scene::Joint>()) {
      derived(*joint);
    } else if (const auto* scene = value.get_if<PhysicsScene>()) {
      derived(*scene);
    }
  }

  template <class T>
  void member(std::string_view key, const T& value) {
    sink_.key(key);
    sink_.put(value);
  }
  void count(std::string_view key, std::size_t value) { member(key, std::uint64_t{value}); }

  void derived(const scene::TriangleMesh& mesh) {
    member("hash", hex(mesh_hash(mesh)));
    count("pointCount", mesh.points.size());
    count("triangleCount", mesh.triangles.size());
    put_bounds(sink_, mesh);
  }
  void derived(const scene::Collider& collider) {
    const scene::Shape& shape = collider.shape;
    if (shape.kind != scene::ShapeKind::ConvexHull && shape.kind != scene::ShapeKind::Mesh) {
      return;
    }
    const scene::TriangleMesh& mesh = scene_.meshes[shape.mesh];
    count("points", mesh.points.size());
    count("triangles", mesh.triangles.size());
    put_bounds(sink_, mesh);
    member("flat", mesh.flat);
    if (!shape.pieces.empty()) {
      count("pieces", shape.pieces.size());
    }
  }
  void derived(const scene::Joint& joint) {
    member("locked", joint.lower > joint.upper);
    sink_.key("mimic");
    joint.mimics.empty() ? sink_.put(nullptr) : object(view_of(joint.mimics.front()));
  }
  void derived(const PhysicsScene& scene) {
    member("schemaVersion", std::string(kSceneSchemaVersion));
    const scene::ColliderPairs apart = scene.disabled_pairs();
    sink_.key("disabledPairs");
    sink_.begin_array();
    for (const auto& [a, b] : apart.pairs) {
      sink_.begin_array();
      sink_.put(scene.colliders[a].path.str());
      sink_.put(scene.colliders[b].path.str());
      sink_.end_array();
    }
    sink_.end_array();
    member("disabledPairsCut", apart.is_cut);
    sink_.key("animated");
    animated();
  }

  /// A row for each track: of what, how many samples.
  void animated() {
    sink_.begin_array();
    const DataView scene = view_of(scene_);
    for (const DataField& field : scene.type->fields) {
      const bool are_tracks =
          is_struct_list(*field.type) && find_field(*field.type->item, "times") != nullptr;
      const DataView list = scene.member(field);
      for (std::size_t i = 0; are_tracks && i < list.size(); ++i) {
        sink_.put(track_row(list[i]));
      }
    }
    if (!scene_.nesting_states.empty()) {
      sink_.put(Json{{"value", "nesting"},
                     {"states", nesting()},
                     {"samples", scene_.nesting_states.size()},
                     {"held", true}});
    }
    if (!scene_.group_states.empty()) {
      sink_.put(Json{
          {"value", "collisionGroups"}, {"samples", scene_.group_states.size()}, {"held", true}});
    }
    sink_.end_array();
  }

  Json nesting() const {
    Json states = Json::array();
    for (const scene::NestingState& state : scene_.nesting_states) {
      Json row = made([&](auto& sink) { into(sink).object(view_of(state)); });
      row["masses"] = Json::array();
      for (const auto& [body, mass] : state.masses) {
        Json entry = Json::object();
        entry["body"] =
            made([&, body = body](auto& sink) { into(sink).reference(List::Bodies, body); });
        entry.update(made([&, &mass = mass](auto& sink) { into(sink).object(view_of(mass)); }));
        row["masses"].push_back(std::move(entry));
      }
      states.push_back(std::move(row));
    }
    return states;
  }

  Json track_row(DataView track) const {
    Json row = Json::object();
    const scene::OwnerFacts owner = facts_of(track);
    for (const DataField& field : track.type->fields) {
      const DataView value = track.member(field);
      const bool is_there = value.kind() != DataKind::Optional || value.size() != 0;
      if (value.kind() != DataKind::List && is_there) {
        row[std::string(field.info->name)] = made([&](auto& sink) {
          into(sink).json(list_of(owner, field.info->refers), *field.info, value);
        });
      }
    }
    name_value(track, row);
    const DataField* held = find_field(*track.type, "held");
    row["samples"] = track.member(*find_field(*track.type, "times")).size();
    row["held"] = held == nullptr || track.member(*held).template as<bool>();
    return row;
  }

  void name_value(DataView track, Json& row) const {
    if (const std::string_view what = changing(track); !what.empty()) {
      row["value"] = std::string(what);
    }
    if (const auto* poses = track.get_if<scene::PoseTrack>(); poses != nullptr && !poses->joint) {
      row.erase("side");
    }
    if (const auto* shapes = track.get_if<scene::ShapesTrack>()) {
      name_shapes(*shapes, row);
    }
    if (const auto* switched = track.get_if<scene::SwitchTrack>()) {
      name_switch(*switched, row);
    }
  }

  void name_shapes(const scene::ShapesTrack& track, Json& row) const {
    for (const Index i : track.colliders) {
      row["colliders"].push_back(scene_.colliders[i].path.str());
    }
    const auto& last = track.shapes.back();
    row["lastMass"] = made([&](auto& sink) { put_number(sink, last.mass); });
    row["lastCenterOfMass"] = made([&](auto& sink) { put_vector(sink, last.center_of_mass); });
  }

  template <class Other>
  friend class Writer;

  const References& references_;
  const PhysicsScene& scene_;
  Geometry geometry_;
  Sink& sink_;
};

}  // namespace

Json scene_json_value(const PhysicsScene& scene, Geometry geometry) {
  JsonValueSink sink;
  const References references(scene);
  Writer(references, geometry, sink).object(view_of(scene));
  return sink.take();
}

Json scene_row_json(const PhysicsScene& scene, Geometry geometry, DataView row) {
  JsonValueSink sink;
  const References references(scene);
  Writer(references, geometry, sink).object(row);
  return sink.take();
}

std::string scene_json(const PhysicsScene& scene, Geometry geometry) {
  const References references(scene);
  std::string text;
  {
    JsonTextSink sink(-1, false, [&](std::string_view piece) { text += piece; });
    Writer(references, geometry, sink).object(view_of(scene));
  }
  return text;
}

Result<void> check_inline_json(const PhysicsScene& scene) {
  std::size_t bytes = 0;
  {
    JsonTextSink sink(2, false, [&](std::string_view piece) { bytes += piece.size(); });
    sink.begin_object();
    write_scene_members(scene, Geometry::Inline, sink);
    sink.end_object();
  }
  if (bytes > limits::kSceneJson) {
    return Error(ErrorCode::Limit, "with the points of its meshes the physics as JSON has " +
                                       std::to_string(bytes) + " bytes; only " +
                                       std::to_string(limits::kSceneJson) + " can be read back")
        .with_rule("physics.json")
        .with_fix("without inline geometry meshes are hashes");
  }
  return {};
}

void write_scene_members(const PhysicsScene& scene, Geometry geometry, JsonTextSink& sink) {
  const References references(scene);
  Writer(references, geometry, sink).members(view_of(scene));
}

}  // namespace tenon::answers
