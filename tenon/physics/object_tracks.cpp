// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Attributes that vary and that no other track follows: of materials, joints, static colliders, and
// vendors' settings of any prim. The stage is read again as it is at each of their samples, and an
// object that is another one then gets a state of its own (S-116). So whatever the passes read is
// followed, without a list of it. What such a state cannot say (a time step, the links of an
// articulation) leaves the attributes of its prim named as not followed, or all of them where it is
// of no one prim.
#include <algorithm>
#include <map>
#include <string>
#include <type_traits>
#include <unordered_set>
#include <utility>

#include "tenon/base/limits/physics_limits.h"
#include "tenon/physics/frozen_samples.h"
#include "tenon/physics/joints/joint_checks.h"
#include "tenon/physics/read_state.h"
#include "tenon/physics/sample_codes.h"
#include "tenon/scene/fields/near_fields.h"
#include "tenon/scene/fields/same_fields.h"
#include "tenon/scene/timeline/object_states.h"

namespace tenon::physics {
namespace {

using scene::ObjectTrack;

bool is_meshed(const Shape& shape) {
  return shape.kind == ShapeKind::Mesh || shape.kind == ShapeKind::ConvexHull;
}

class ObjectTracks {
 public:
  explicit ObjectTracks(ReadState& state) : state_(state), frozen_(frozen_samples(state)) {}

  void run() {
    const std::vector<double> codes = codes_of_samples();
    if (codes.empty()) {
      return;
    }
    for (const double code : codes) {
      read_at(code);
    }
    PhysicsScene& scene = state_.scene;
    if (is_lost_) {
      scene::each_tracked_list([&](auto, auto tracks) { (scene.*tracks).clear(); });
      return;
    }
    scene::each_tracked_list([&](auto list, auto tracks) {
      std::erase_if(scene.*tracks, [&](const auto& track) {
        return lost_.contains((scene.*list)[track.object].path);
      });
      note_followed(scene.*list, scene.*tracks);
    });
    for (const FrozenSample& sample : frozen_) {
      if (followed_.contains(sample.prim.path())) {
        state_.follow(sample.prim, sample.name);
      }
    }
  }

 private:
  /// After the start, no more than may be read.
  std::vector<double> codes_of_samples() {
    std::vector<stage::Attribute> attributes;
    for (const FrozenSample& sample : frozen_) {
      attributes.push_back(sample.prim.attribute(sample.name));
    }
    std::vector<double> codes = sample_codes(attributes);
    if (codes.empty() && !frozen_.empty()) {  // splines
      codes = {state_.scene.start_time_code, state_.scene.end_time_code};
    }
    const std::size_t most = std::clamp<std::size_t>(
        limits::kObjectReadings / std::max<std::size_t>(1, state_.walk.prims.size()), 1,
        limits::kShapeSamples);
    const std::size_t authored = codes.size();
    codes = dense_codes(state_, std::move(codes), most);
    std::erase_if(codes, [this](double code) { return code <= state_.scene.start_time_code; });
    if (codes.size() > most + authored || authored > most) {
      state_.scene.not_read.push_back(
          {Path::absolute_root(), "timeSamples",
           "samples of settings, materials, joints and sizes are thinned: of " +
               std::to_string(codes.size()) + " times " + std::to_string(most) +
               " are read (kObjectReadings)"});
      thin_out(codes, most);
    }
    return codes;
  }

  static void thin_out(std::vector<double>& codes, std::size_t most) {
    std::vector<double> kept;
    for (std::size_t i = 0; i < most && !codes.empty(); ++i) {
      kept.push_back(codes[(i + 1) * codes.size() / most - 1]);
    }
    codes = ascending_codes(std::move(kept));
  }

  void read_at(double code) {
    Diagnostics silent;
    ReadState later = state_.at(code, silent);
    later.mesh_tools = state_.mesh_tools;
    later.integrals = state_.integrals;
    later.mesh_cache = state_.mesh_cache == nullptr ? &meshes_ : state_.mesh_cache;
    later.scene.meters_per_unit = state_.scene.meters_per_unit;
    later.scene.kilograms_per_unit = state_.scene.kilograms_per_unit;
    later.scene.up = state_.scene.up;
    later.scene.time_codes_per_second = state_.scene.time_codes_per_second;
    later.scene.unbound = state_.scene.unbound;
    later.walk = walk_stage(state_.stage, later.values, state_.readings);
    read_objects(later);
    if (later.scene.bodies.size() == state_.scene.bodies.size()) {
      for (std::size_t b = 0; b < state_.scene.bodies.size(); ++b) {
        later.scene.bodies[b].pose = state_.scene.bodies[b].pose;  // where roots stay
      }
      let_fixed_roots_stay(later);
    }
    time_ = state_.seconds(code);
    scene_ = &later.scene;
    scene::each_tracked_list([&](auto list, auto tracks) {
      take(later.scene.*list, state_.scene.*list, state_.scene.*tracks);
    });
    compare(later.scene.articulations);
  }

  void compare(const std::vector<Articulation>& now) {
    const std::vector<Articulation>& start = state_.scene.articulations;
    for (std::size_t i = 0; i < std::max(now.size(), start.size()); ++i) {
      if (i >= now.size() || i >= start.size() || now[i].path != start[i].path) {
        is_lost_ = true;
      } else if (!scene::same_fields(now[i], start[i])) {
        lost_.insert({start[i].path, start[i].root});
      }
    }
  }

  /// What the objects are now, where they are other ones than before.
  template <class Object>
  void take(std::vector<Object>& now, const std::vector<Object>& start,
            std::vector<ObjectTrack<Object>>& tracks) {
    if (now.size() != start.size()) {
      is_lost_ = true;  // some object is none at this time
      return;
    }
    for (Index i = 0; i < start.size(); ++i) {
      if (now[i].path != start[i].path) {
        is_lost_ = true;
        return;
      }
      add_state(std::move(now[i]), start[i], i, tracks);
    }
  }

  template <class Object>
  void add_state(Object now, const Object& start, Index i,
                 std::vector<ObjectTrack<Object>>& tracks) {
    const auto known = places_.find({&tracks, i});
    const Object& last = known == places_.end() ? start : tracks[known->second].states.back();
    note_lost(now, start, i);
    keep_followed(state_.scene, i, start, now);
    share_meshes(now, last);
    if (scene::near_fields(now, last)) {
      return;
    }
    if (known == places_.end()) {
      places_.emplace(std::pair<const void*, Index>(&tracks, i), tracks.size());
      tracks.push_back({i, {}, {}});
    }
    ObjectTrack<Object>& track = tracks[places_.at({&tracks, i})];
    track.times.push_back(time_);
    track.states.push_back(std::move(now));
  }

  /// What keep_followed() takes back though nothing follows it.
  template <class Object>
  void note_lost(const Object&, const Object&, Index) {}
  void note_lost(const Scene& now, const Scene& start, Index) {
    if (now.time_step != start.time_step) {
      lost_.insert(start.path);
    }
  }
  void note_lost(const Body& now, const Body&, Index i) {  // its material may say so
    const scene::ShapesTrack* shapes = scene::shapes_track_of(state_.scene, i);
    is_lost_ = is_lost_ || (shapes != nullptr &&
                            !scene::near_fields(now.mass, shapes->shapes[shapes->at(time_)].mass));
  }
  void note_lost(const Joint& now, const Joint& start, Index) {  // an actuator's drive
    is_lost_ = is_lost_ || now.drives.size() != start.drives.size();
  }

  /// Meshes of a shape are those of its last state, or new ones of this scene.
  template <class Object>
  void share_meshes(Object&, const Object&) {}
  void share_meshes(Collider& now, const Collider& last) {
    if (!is_meshed(now.shape)) {
      now.shape.mesh = last.shape.mesh;
      return;
    }
    now.shape.mesh = mesh_of(now.shape.mesh, is_meshed(last.shape) ? &last.shape.mesh : nullptr);
    for (std::size_t k = 0; k < now.shape.pieces.size(); ++k) {
      now.shape.pieces[k] = mesh_of(now.shape.pieces[k],
                                    k < last.shape.pieces.size() ? &last.shape.pieces[k] : nullptr);
    }
  }

  Index mesh_of(Index theirs, const Index* last) {
    std::vector<scene::TriangleMesh>& meshes = state_.scene.meshes;
    if (last != nullptr && scene::near_fields(meshes[*last], scene_->meshes[theirs])) {
      return *last;
    }
    meshes.push_back(scene_->meshes[theirs]);
    return static_cast<Index>(meshes.size() - 1);
  }

  /// The prims of which an object has states, and those that give a joint its drives.
  template <class Object>
  void note_followed(const std::vector<Object>& objects,
                     const std::vector<ObjectTrack<Object>>& tracks) {
    for (const ObjectTrack<Object>& track : tracks) {
      followed_.insert(objects[track.object].path);
      if constexpr (std::is_same_v<Object, Joint>) {
        for (const Drive& drive : objects[track.object].drives) {
          followed_.insert(drive.source);
        }
      }
    }
  }

  ReadState& state_;
  std::vector<FrozenSample> frozen_;
  MeshCache meshes_;
  std::map<std::pair<const void*, Index>, std::size_t> places_;  ///< of an object in its tracks
  double time_ = 0;                                              ///< [s] of the reading
  const PhysicsScene* scene_ = nullptr;                          ///< that is read
  bool is_lost_ = false;           ///< states do not say all, of whatever prim
  std::unordered_set<Path> lost_;  ///< prims of whose objects they do not
  std::unordered_set<Path> followed_;
};

}  // namespace

void read_object_tracks(ReadState& state) {
  if (state.values.stage_is_animated()) {
    ObjectTracks(state).run();
  }
}

}  // namespace tenon::physics
