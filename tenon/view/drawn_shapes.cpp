// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A walk over the stage with the matrix and the nearest body of each prim. Below a point instancer
// the prims of its prototypes are met once for each instance, under paths as the physics gives
// them. A mesh is kept as it is in its prim's own space; the matrix becomes a pose and a scale, so
// that instances share the mesh. A sheared matrix has no scale: its points are moved instead.
#include "tenon/view/drawn_shapes.h"

#include <cmath>
#include <map>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "tenon/physics/attribute_values.h"
#include "tenon/physics/point_instancers.h"
#include "tenon/stage/transform_at.h"
#include "tenon/view/round_meshes.h"
#include "tenon/view/surfaces.h"
#include "tenon/view/usd_mesh.h"
#include "tenon/view/view_camera.h"

namespace tenon::view {
namespace {

constexpr double kSheared = 1e-5;     // cosine between axes that count as at right angles
constexpr std::size_t kNesting = 32;  // point instancers in prototypes of others
constexpr double kGround = 1000;      // half extents of a plane without end, of its size unit

struct SeenPlace {
  stage::Prim prim;
  Mat4d parent_world = Mat4d::identity();  ///< of the prim above, stage units
  Path path;                               ///< as bodies have it
  std::optional<Index> body;
  bool visible = true;
  Token purpose;
  std::size_t nesting = 0;
};

bool is_seen_purpose(Token purpose) { return !(purpose == "guide") && !(purpose == "proxy"); }

scene::Axis axis_of(const stage::Prim& prim, stage::Time time) {
  const Token axis = prim.attribute("axis").get_as<Token>(time).value_or(Token("Z"));
  return axis == "X" ? scene::Axis::X : axis == "Y" ? scene::Axis::Y : scene::Axis::Z;
}

/// A matrix to metres in a frame as a pose and a scale; no value where it is sheared or has none.
struct Placement {
  Pose pose;
  Vec3d scale;
};
std::optional<Placement> placement_of(const Mat4d& m) {
  const Mat3d linear = upper_left(m);
  Placement result;
  result.pose.position = {{m[3][0], m[3][1], m[3][2]}};
  result.scale = row_scale(m);
  Mat3d rotation;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!(std::fabs(result.scale[i]) > 0) || !is_finite(result.scale[i])) {
      return std::nullopt;
    }
    for (std::size_t j = 0; j < 3; ++j) {
      rotation[i][j] = linear[i][j] / result.scale[i];
    }
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t next = (i + 1) % 3;
    double cosine = 0;
    for (std::size_t j = 0; j < 3; ++j) {
      cosine += rotation[i][j] * rotation[next][j];
    }
    if (!(std::fabs(cosine) < kSheared)) {
      return std::nullopt;
    }
  }
  result.pose.orientation = normalized(rotation_of(rotation));
  return is_finite(result.pose) ? std::optional(result) : std::nullopt;
}

/// The points moved by a matrix, normals by what keeps them at right angles.
ViewMesh moved(ViewMesh mesh, const Mat4d& m) {
  const Mat3d linear = upper_left(m);
  bool invertible = false;
  const Mat3d back = transpose(inverse(linear, &invertible));
  for (Vec3f& point : mesh.points) {
    point = to_float(to_double(point) * linear);
  }
  for (Vec3f& normal : mesh.normals) {
    const Vec3d turned = invertible ? to_double(normal) * back : to_double(normal);
    normal = to_float(normalized(turned, {{0, 0, 1}}));
  }
  if (determinant(linear) < 0) {
    for (std::size_t i = 0; i + 2 < mesh.corners.size(); i += 3) {
      std::swap(mesh.corners[i + 1], mesh.corners[i + 2]);
    }
  }
  return mesh;
}

class DrawnShapes {
 public:
  DrawnShapes(const stage::Stage& stage, const scene::PhysicsScene& scene,
              const ViewOptions& options, ViewScene& view)
      : stage_(stage),
        scene_(scene),
        options_(options),
        view_(view),
        time_(scene.start_time_code),
        values_(time_, physics::layer_contents(stage), physics::ValueTypes::Lenient, unheard_),
        surfaces_(options, time_, view) {
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
      bodies_.emplace(scene.bodies[i].path, static_cast<Index>(i));
    }
  }

  void run() {
    const stage::Prim root = stage_.pseudo_root();
    pending_.push_back({root, Mat4d::identity(), root.path(), {}, true, Token("default"), 0});
    while (!pending_.empty() && !full_) {
      const SeenPlace place = pending_.back();
      pending_.pop_back();
      enter(place);
    }
  }

 private:
  using Pieces = std::vector<std::pair<Index, Path>>;  // meshes and the subsets they are of

  void enter(SeenPlace place) {
    const stage::Prim& prim = place.prim;
    Mat4d world = place.parent_world;
    if (!prim.is_pseudo_root()) {
      if (!prim.is_active() || !prim.is_defined() || prim.is_abstract()) {
        return;
      }
      const stage::LocalTransform local = stage::local_transform(prim, time_);
      world = local.resets_stack && place.nesting == 0 ? local.matrix : local.matrix * world;
      look_at(place);
      if (!place.visible) {
        return;
      }
      if (prim.is_a("PointInstancer")) {
        enter_instances(place, world);
        return;
      }
      if (prim.is_a("Gprim") && is_seen_purpose(place.purpose)) {
        draw(place, world);
      }
      if (prim.is_a("Camera") && place.nesting == 0) {
        add_camera(place, world);
      }
    }
    const std::vector<stage::Prim> children = prim.children();
    for (auto child = children.rbegin(); child != children.rend(); ++child) {
      pending_.push_back({*child, world, place.path.child(child->name()), place.body, true,
                          place.purpose, place.nesting});
    }
  }

  /// Body, purpose and visibility of a prim on the walk.
  void look_at(SeenPlace& place) const {
    if (const auto body = bodies_.find(place.path); body != bodies_.end()) {
      place.body = body->second;
    }
    const stage::Attribute purpose = place.prim.attribute("purpose");
    if (purpose.has_authored_value()) {
      place.purpose = purpose.get_as<Token>(time_).value_or(place.purpose);
    }
    place.visible =
        !(place.prim.attribute("visibility").get_as<Token>(time_) == Token("invisible"));
  }

  void enter_instances(const SeenPlace& place, const Mat4d& world) {
    if (place.nesting >= kNesting) {
      note(place.path, "point instancers are nested too deep; this one is not shown");
      return;
    }
    const physics::InstancerReading reading = physics::read_point_instancer(values_, place.prim);
    if (!reading.fault.empty()) {
      note(place.path, "the instances are not shown: " + reading.fault);
    }
    std::string stem = "instance_";
    for (const stage::Prim& child : place.prim.children()) {
      while (child.name().view().starts_with(stem)) {
        stem = "_" + stem;
      }
    }
    for (std::size_t left = reading.instances.size(); left > 0; --left) {  // the first on top
      const physics::ArrayInstance& instance = reading.instances[left - 1];
      const stage::Prim& prototype = reading.prototypes[instance.prototype];
      if (pending_.size() > options_.limits.shapes) {
        note(place.path, "there are more instances than can be shown");
        return;
      }
      const Path scope = place.path.child(Token(stem + std::to_string(instance.index)));
      pending_.push_back({prototype, instance.local * world, scope.child(prototype.name()),
                          place.body, true, place.purpose, place.nesting + 1});
    }
  }

  /// The matrix to metres in the frame of the body that carries a place, or in the world.
  Mat4d in_frame_of(const SeenPlace& place, const Mat4d& world) const {
    const double unit = scene_.meters_per_unit;
    const Pose frame = place.body ? scene_.bodies[*place.body].pose : Pose{};
    return world * scale_matrix({{unit, unit, unit}}) * inverse(pose_matrix(frame));
  }

  void add_camera(const SeenPlace& place, const Mat4d& world) {
    if (view_.cameras.size() >= options_.limits.cameras) {
      note(place.path, "there are more cameras than can be listed");
      return;
    }
    auto camera = read_camera(place.prim, time_, in_frame_of(place, world), place.body);
    if (camera) {
      view_.cameras.push_back(*std::move(camera));
    } else {
      note(place.path, camera.error().message());
    }
  }

  void draw(const SeenPlace& place, const Mat4d& world) {
    const Mat4d in_frame = in_frame_of(place, world);
    std::optional<Placement> at = placement_of(in_frame);
    Pieces made;
    if (!at) {  // points of its own
      at = {{{{in_frame[3][0], in_frame[3][1], in_frame[3][2]}}, kIdentityRotation}, {{1, 1, 1}}};
      if (!is_finite(at->pose.position)) {
        note(place.path, "the place of the prim is not finite");
        return;
      }
      made = read_pieces(place, &in_frame);
    }
    for (const auto& [mesh, subset] : made.empty() ? pieces_of(place) : made) {
      add_shape(place, *at, mesh, subset);
    }
  }

  void add_shape(const SeenPlace& place, const Placement& at, Index mesh, Path subset) {
    if (view_.shapes.size() >= options_.limits.shapes) {
      note(place.path, "there is more to draw than can be shown");
      full_ = true;
      return;
    }
    ViewShape shape;
    shape.path = place.path;
    shape.body = place.body;
    shape.pose = at.pose;
    shape.scale = at.scale;
    shape.mesh = mesh;
    const stage::Prim owner = subset.empty() ? place.prim : place.prim.child(subset.name());
    shape.material = surfaces_.of(owner ? owner : place.prim);
    shape.two_sided = place.prim.attribute("doubleSided").get_as<bool>(time_).value_or(false);
    view_.shapes.push_back(shape);
  }

  /// The meshes of a gprim, read once for all instances of it.
  const Pieces& pieces_of(const SeenPlace& place) {
    const stage::Prim shared = place.prim.prim_in_prototype();
    const Path key = shared ? shared.path() : place.prim.path();
    const auto [at, is_new] = known_.try_emplace(key);
    if (is_new) {
      at->second = read_pieces(place, nullptr);
    }
    return at->second;
  }

  Pieces read_pieces(const SeenPlace& place, const Mat4d* by) {
    std::vector<MeshPart> parts;
    if (place.prim.is_a("Mesh")) {
      MeshReading reading = read_usd_mesh(place.prim, time_);
      if (!reading.fault.empty()) {
        note(place.path, reading.fault);
      }
      parts = std::move(reading.parts);
    } else if (std::optional<ViewMesh> mesh = shape_by_numbers(place.prim)) {
      parts.push_back({{}, std::move(*mesh)});
    } else {
      note(place.path, "prims of type " + place.prim.type_name().str() + " are not drawn");
    }
    Pieces made;
    for (MeshPart& part : parts) {
      if (part.mesh.corners.size() > options_.limits.corners - kept_corners_) {
        note(place.path, "there are more triangles than can be shown");
        break;
      }
      kept_corners_ += part.mesh.corners.size();
      made.emplace_back(static_cast<Index>(view_.meshes.size()), part.subset);
      view_.meshes.push_back(by == nullptr ? std::move(part.mesh)
                                           : moved(std::move(part.mesh), *by));
    }
    return made;
  }

  double number(const stage::Prim& prim, const char* name) const {
    const double value = prim.attribute(Token(name)).get_as<double>(time_).value_or(0);
    return is_finite(value) ? std::fabs(value) : 0;
  }

  std::optional<ViewMesh> shape_by_numbers(const stage::Prim& prim) const {
    const auto of = [&](const char* name) { return number(prim, name); };
    ViewMesh mesh;
    if (prim.is_a("Cube")) {
      const double half = of("size") / 2;
      return box_mesh({{half, half, half}});
    }
    if (prim.is_a("Sphere")) {
      return ball_mesh(of("radius"));
    }
    if (prim.is_a("Plane")) {
      const bool ends = prim.attribute("width").has_authored_value();
      mesh = ends ? plane_mesh(of("width") / 2, of("length") / 2) : plane_mesh(kGround, kGround);
    } else if (prim.is_a("Cylinder_1")) {
      mesh = frustum_mesh(of("radiusBottom"), of("radiusTop"), of("height") / 2);
    } else if (prim.is_a("Capsule_1")) {
      mesh = capsule_mesh(of("radiusBottom"), of("radiusTop"), of("height") / 2);
    } else if (prim.is_a("Cylinder")) {
      mesh = frustum_mesh(of("radius"), of("radius"), of("height") / 2);
    } else if (prim.is_a("Capsule")) {
      mesh = capsule_mesh(of("radius"), of("radius"), of("height") / 2);
    } else if (prim.is_a("Cone")) {
      mesh = frustum_mesh(of("radius"), 0, of("height") / 2);
    } else {
      return std::nullopt;
    }
    return moved(std::move(mesh), pose_matrix({{}, turn_from_z(axis_of(prim, time_))}));
  }

  void note(Path path, std::string what) { view_.notes.push_back({path, std::move(what)}); }

  const stage::Stage& stage_;
  const scene::PhysicsScene& scene_;
  const ViewOptions& options_;
  ViewScene& view_;
  stage::Time time_;
  Diagnostics unheard_;
  physics::AttributeValues values_;
  Surfaces surfaces_;
  std::unordered_map<Path, Index> bodies_;
  std::unordered_map<Path, Pieces> known_;
  std::vector<SeenPlace> pending_;
  std::size_t kept_corners_ = 0;  // of meshes
  bool full_ = false;
};

}  // namespace

void add_drawn_shapes(const stage::Stage& stage, const scene::PhysicsScene& scene,
                      const ViewOptions& options, ViewScene& view) {
  DrawnShapes(stage, scene, options, view).run();
}

}  // namespace tenon::view
