// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What one sees of an asset, as a value: bodies with what is drawn of them, and the physics
// beside it that a viewer can show. Numbers are as in the neutral description (SI and radians);
// bodies, joints and colliders have the indices that they have there, so poses of any run fit.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tenon/base/path.h"
#include "tenon/math/matrix.h"
#include "tenon/math/transform.h"
#include "tenon/math/vector.h"
#include "tenon/scene/physics_scene.h"

namespace tenon::view {

using Index = std::uint32_t;

/// The file of an image, PNG or JPEG, as it is.
struct ViewImage {
  std::string name;       ///< the asset path that it was found at
  std::string mime_type;  ///< "image/png" or "image/jpeg"
  std::string bytes;
};

/// What an image is beyond its edges.
enum class ViewWrap : std::uint8_t { Repeat, Clamp, Mirror, Black };

/// An image of a material. It is read at turn * (scale * (u, v)) + offset; (0, 0) is its lower left
/// corner.
struct ViewTexture {
  Index image = 0;  ///< into ViewScene::images
  Vec2d scale{{1, 1}};
  double turn = 0;  ///< counter-clockwise [rad]
  Vec2d offset;
  ViewWrap wrap_s = ViewWrap::Repeat;
  ViewWrap wrap_t = ViewWrap::Repeat;

  friend bool operator==(const ViewTexture&, const ViewTexture&) = default;
};

/// Opacity of an image: factor * channel + add, clamped between 0 and 1.
struct ViewOpacity {
  ViewTexture texture;
  std::size_t channel = 3;  ///< of red, green, blue, alpha
  double factor = 1;
  double add = 0;
};

/// A surface, metallic and rough as UsdPreviewSurface and glTF have it. Colours are linear. The
/// defaults are those of UsdPreviewSurface: what a shape without material and colour looks like.
struct ViewMaterial {
  Path path;  ///< of the USD material; empty: a display colour, or the default
  Vec3d color{{0.18, 0.18, 0.18}};
  double opacity = 1;
  double roughness = 0.5;
  double metallic = 0;
  Vec3d emission;
  double cutout = 0;  ///< opacityThreshold: above 0 a point is seen or not
  std::optional<ViewTexture> color_texture;
  std::optional<ViewOpacity> opacity_texture;  ///< in place of `opacity`
  std::optional<ViewTexture> emission_texture;
  std::optional<ViewTexture> normal_texture;
  std::optional<ViewTexture> surface_texture;    ///< roughness in green, metallic in blue
  std::optional<ViewTexture> occlusion_texture;  ///< in red
};

/// Triangles to draw; a point stands once for each normal and place in images that it has.
struct ViewMesh {
  std::vector<Vec3f> points;           ///< (point_count)
  std::vector<Vec3f> normals;          ///< (point_count), or empty: every triangle is flat
  std::vector<Vec2f> st;               ///< (point_count), from the lower left; or empty
  std::vector<Vec3f> colors;           ///< (point_count), linear; or empty
  std::vector<std::uint32_t> corners;  ///< (3 triangle_count), counter-clockwise from outside

  std::size_t triangle_count() const { return corners.size() / 3; }
};

/// A mesh at a place: rotation, translation [m] and scale in the frame of its body or the world.
struct ViewShape {
  Path path;                  ///< the prim
  std::optional<Index> body;  ///< into ViewScene::bodies; none: it is fixed to the world
  Pose pose;
  Vec3d scale{{1, 1, 1}};  ///< of the points, before `pose`; negative along one axis: mirrored
  Index mesh = 0;          ///< into ViewScene::meshes, which several shapes may share
  std::optional<Index> material;  ///< into ViewScene::materials; none: a default ViewMaterial
  bool two_sided = false;
};

/// A body and where its mass is.
struct ViewBody {
  Path path;
  Pose pose;  ///< X_WB at the start
  double mass = 0;
  Vec3d center_of_mass;     ///< in the body frame
  Quatd principal_axes;     ///< body <- principal frame
  Vec3d principal_moments;  ///< [kg m^2]
  Vec3d inertia_box;        ///< half extents of the box of even density with mass and moments [m]
  bool kinematic = false;
  bool enabled = true;
  std::optional<Index> articulation;  ///< into ViewScene::articulations
};

inline constexpr std::string_view kSeveralHulls = "convexDecomposition";

/// What a body touches with.
struct ViewCollider {
  Path path;
  std::optional<Index> body;  ///< none: static
  std::string kind;           ///< scene::shape_name, or kSeveralHulls
  std::string approximation;  ///< what the asset asks for; empty: no mesh
  bool enabled = true;
  std::vector<Index> shapes;  ///< into ViewScene::collider_shapes
  double volume = 0;          ///< of all shapes [m^3]; 0: of planes and flat or open ones
  /// Volume of what the collider is made from [m^3], and by what share of it the shapes hold more
  /// (a hull over a hollow): only of meshes that are closed.
  std::optional<double> source_volume;
  std::optional<double> hull_gap;
};

/// A range of one degree of freedom. None: without end.
struct ViewLimit {
  scene::Dof dof = scene::Dof::RotX;
  std::optional<double> lower;
  std::optional<double> upper;
};

struct ViewJoint {
  Path path;
  scene::JointKind kind = scene::JointKind::Fixed;
  std::optional<Index> body0;  ///< none: world
  std::optional<Index> body1;
  Pose frame0;  ///< in body0 or the world [m]
  Pose frame1;
  scene::Axis axis = scene::Axis::X;  ///< of revolute, prismatic and spherical ones
  std::vector<ViewLimit> limits;      ///< of the degrees of freedom that are bounded
  std::vector<scene::Drive> drives;
  std::optional<Index> articulation;
  bool enabled = true;
  bool closes_loop = false;
};

struct ViewArticulation {
  Path path;
  bool fixed_base = false;
  std::vector<Index> links;  ///< bodies, the root first
  std::vector<Index> joints;
};

/// A UsdGeomCamera with perspective, at the start. It looks along its -Z, +Y is up.
struct ViewCamera {
  Path path;
  std::optional<Index> body;  ///< that carries it, into ViewScene::bodies; none: it stands still
  Pose pose;                  ///< in the body's frame or the world [m]
  double half_width = 0;      ///< tangents of half the angles that it sees, sideways
  double half_height = 0;     ///< and upward
};

/// What was skipped so that the whole can be shown, as a sentence.
struct ViewNote {
  Path prim;  ///< empty: of the whole
  std::string what;
};

struct ViewScene {
  Vec3d up{{0, 1, 0}};  ///< of the world
  std::vector<ViewBody> bodies;
  std::vector<ViewShape> shapes;  ///< the visuals
  std::vector<ViewMesh> meshes;
  std::vector<ViewMaterial> materials;
  std::vector<ViewImage> images;
  std::vector<ViewCollider> colliders;
  std::vector<ViewShape> collider_shapes;  ///< what is touched; their meshes are in `meshes`, too
  std::vector<ViewJoint> joints;
  std::vector<ViewArticulation> articulations;
  std::vector<ViewCamera> cameras;
  /// Pairs of bodies none of whose colliders touch, first < second; kWorld for what stands still.
  std::vector<std::pair<Index, Index>> filtered_pairs;
  std::vector<ViewNote> notes;

  /// Triangles as often as they are drawn, colliders not counted.
  std::size_t drawn_triangles() const;
};

/// In `filtered_pairs`: what belongs to no body.
inline constexpr Index kWorld = 0xffffffffu;

}  // namespace tenon::view
