// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Prims that move or grow inside a body (S-37), and numbers of its mass that vary: its shapes and
// its mass are read again at sample times as they are in the body then.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "tenon/base/limits/physics_limits.h"
#include "tenon/physics/read_state.h"
#include "tenon/physics/sample_codes.h"
#include "tenon/stage/transform_at.h"

namespace tenon::physics {
namespace {

/// Sample times of the prim's own transform ops.
std::vector<double> own_samples(const stage::Prim& prim) {
  std::vector<double> codes;
  const auto order = prim.attribute("xformOpOrder").get_as<layer::Array<Token>>();
  for (const Token& op : order.value_or(layer::Array<Token>())) {
    std::string name = op.str();
    if (name.starts_with("!invert!")) {
      name.erase(0, std::string("!invert!").size());
    }
    const stage::Attribute attribute = prim.attribute(Token(name));
    if (attribute.is_animated()) {
      const std::vector<double> samples = attribute.time_samples();
      codes.insert(codes.end(), samples.begin(), samples.end());
    }
  }
  return codes;
}

/// What masses are read from, of a body, its colliders and the prims between.
const std::vector<Token>& mass_names() {
  static const std::vector<Token> names{
      Token("physics:mass"),          Token("physics:density"),
      Token("physics:centerOfMass"),  Token("physics:diagonalInertia"),
      Token("physics:principalAxes"), Token("newton:inertia")};
  return names;
}

bool same_shape(const Shape& a, const Shape& b) {
  return a.kind == b.kind && a.half_extents == b.half_extents && a.radius == b.radius &&
         a.half_height == b.half_height && a.axis == b.axis && a.sphere_radii == b.sphere_radii &&
         a.sphere_centers == b.sphere_centers;
}

class MovingShapes {
 public:
  explicit MovingShapes(ReadState& state) : state_(state) {}

  void run() {
    for (Index body = 0; body < state_.scene.bodies.size(); ++body) {
      if (state_.prim_of_body(body).instance == kNone) {
        add_body(body);
      }
    }
  }

 private:
  /// Colliders that move in the body, and when.
  void add_body(Index body) {
    ShapesTrack track;
    track.body = body;
    std::vector<double> codes;
    for (const Index i : state_.colliders_of_body[body]) {
      const stage::Prim& prim = state_.prim_of_collider(i).prim;
      std::vector<double> samples = samples_below(body, prim);
      const std::vector<double> sizes = follow_names(prim, size_names_of(prim));
      samples.insert(samples.end(), sizes.begin(), sizes.end());
      if (samples.size() > 1) {
        track.colliders.push_back(i);
        codes.insert(codes.end(), samples.begin(), samples.end());
      }
      add_mass_codes(body, prim, codes);
    }
    add_mass_codes(body, state_.prim_of_body(body).prim, codes);
    if (codes.size() < 2) {
      return;
    }
    read_samples(dense_codes(state_, ascending_codes(std::move(codes)), limits::kShapeSamples),
                 track);
    state_.scene.shapes_tracks.push_back(std::move(track));
  }

  /// The attributes that vary and that the shape of a collider was read from.
  std::vector<Token> size_names_of(const stage::Prim& prim) const {
    std::vector<Token> names;
    for (const Token name : prim.authored_property_names()) {
      if (state_.sizes.contains(prim.path().property(name).str())) {
        names.push_back(name);
      }
    }
    return names;
  }

  /// Sample times of those that vary, which are followed from here on.
  std::vector<double> follow_names(const stage::Prim& prim, const std::vector<Token>& names) {
    std::vector<double> codes;
    for (const Token name : names) {
      const stage::Attribute attribute = prim.attribute(name);
      if (attribute.is_animated()) {
        state_.follow(prim, name);
        const std::vector<double> samples = attribute.time_samples();
        codes.insert(codes.end(), samples.begin(), samples.end());
      }
    }
    return codes;
  }

  /// From a prim of the body up to the body's own.
  void add_mass_codes(Index body, const stage::Prim& prim, std::vector<double>& codes) {
    const Path top = state_.prim_of_body(body).path;
    for (stage::Prim at = prim; at.is_valid(); at = at.parent()) {
      const std::vector<double> own = follow_names(at, mass_names());
      codes.insert(codes.end(), own.begin(), own.end());
      if (at.path() == top) {
        break;
      }
    }
  }

  /// Of the prims from a collider up to the body's, without that one.
  std::vector<double> samples_below(Index body, const stage::Prim& collider) const {
    std::vector<double> codes;
    const Path top = state_.prim_of_body(body).path;
    for (stage::Prim at = collider; at.is_valid() && !(at.path() == top); at = at.parent()) {
      const std::vector<double> own = own_samples(at);
      codes.insert(codes.end(), own.begin(), own.end());
    }
    return codes;
  }

  /// Reads the colliders and weighs the body at each time, then puts everything back.
  void read_samples(const std::vector<double>& codes, ShapesTrack& track) {
    const AttributeValues values = state_.values;
    const Diagnostics said = state_.diagnostics;
    const auto integrals = state_.integrals_of_collider;
    const std::size_t not_read = state_.scene.not_read.size();
    Provenance* const provenance = std::exchange(state_.provenance, nullptr);
    const Body body = state_.scene.bodies[track.body];
    std::vector<Collider> colliders;
    std::vector<Mat4d> worlds;
    for (const Index i : track.colliders) {
      colliders.push_back(state_.scene.colliders[i]);
      worlds.push_back(state_.prim_of_collider(i).world);
    }
    for (const double code : codes) {
      Diagnostics silent;
      state_.values = state_.at(code, silent).values;
      place_colliders(code, track);
      add_sample(code, colliders, track);
    }
    for (std::size_t k = 0; k < colliders.size(); ++k) {
      const Index i = track.colliders[k];
      state_.walk.prims[state_.collider_prims[i]].world = worlds[k];
      state_.scene.colliders[i] = colliders[k];
    }
    state_.scene.bodies[track.body] = body;
    state_.provenance = provenance;
    state_.scene.not_read.resize(not_read);
    state_.integrals_of_collider = integrals;
    state_.diagnostics = said;
    state_.values = values;
  }

  /// World matrices as if the body stood where it was at the start.
  void place_colliders(double code, const ShapesTrack& track) {
    const PhysicsPrim& body = state_.prim_of_body(track.body);
    const Mat4d back = inverse(stage::local_to_world(body.prim, stage::Time(code))) * body.world;
    for (const Index i : track.colliders) {
      PhysicsPrim& found = state_.walk.prims[state_.collider_prims[i]];
      found.world = stage::local_to_world(found.prim, stage::Time(code)) * back;
    }
  }

  void add_sample(double code, const std::vector<Collider>& start, ShapesTrack& track) {
    BodyShapes shapes;
    for (std::size_t k = 0; k < start.size(); ++k) {
      const Index i = track.colliders[k];
      const std::size_t mesh_count = state_.scene.meshes.size();
      std::optional<SolidIntegrals> integrals;
      std::optional<Collider> now = read_collider(state_, state_.prim_of_collider(i), integrals);
      Collider& collider = state_.scene.colliders[i];
      collider = start[k];
      if (now) {  // else it is scaled to nothing for a while: it stays as it was
        collider.pose = now->pose;
        keep_shape(std::move(now->shape), mesh_count, collider);
        if (integrals) {
          state_.integrals_of_collider.insert_or_assign(i, *integrals);
        }
      }
      shapes.poses.push_back(collider.pose);
      shapes.shapes.push_back(collider.shape);
    }
    compute_body_mass(state_, track.body);
    const Body& body = state_.scene.bodies[track.body];
    shapes.mass = body.mass;
    shapes.center_of_mass = body.center_of_mass;
    shapes.inertia = body.inertia;
    track.times.push_back(state_.seconds(code));
    track.shapes.push_back(std::move(shapes));
  }

  /// The shape of a collider; a mesh that is as at the start is kept once.
  void keep_shape(Shape now, std::size_t mesh_count, Collider& collider) {
    const bool mesh = now.kind == ShapeKind::Mesh || now.kind == ShapeKind::ConvexHull;
    const bool same = same_shape(now, collider.shape) &&
                      (!mesh || state_.scene.meshes[now.mesh].points ==
                                    state_.scene.meshes[collider.shape.mesh].points);
    if (same) {
      state_.scene.meshes.resize(mesh_count);
      state_.shared_meshes.forget_from(static_cast<Index>(mesh_count));
    } else {
      collider.shape = std::move(now);
    }
  }

  ReadState& state_;
};

}  // namespace

void read_moving_shapes(ReadState& state) {
  if (state.values.stage_is_animated()) {
    MovingShapes(state).run();
  }
}

}  // namespace tenon::physics
