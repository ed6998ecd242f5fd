// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/math/matrix.h"
#include "tenon/math/transform.h"
#include "tenon/math/vector.h"
#include "tenon/robot/approximation.h"
#include "tenon/robot/cameras_and_lights.h"
#include "tenon/robot/joint_quantity.h"
#include "tenon/robot/mujoco_parts.h"
#include "tenon/robot/site_sensor.h"

/// A robot as described, before it is a scene: the output of readers of robot formats and the input
/// of writers. Plain structs in metres, kilograms, seconds and radians; knows no format, no USD and
/// no engine. Objects refer to each other by index.
namespace tenon::robot {

using Index = std::uint32_t;

/// Where the description says something; zeros where that is unknown.
struct Place {
  std::uint32_t line = 0;      ///< 1-based
  std::uint32_t column = 0;    ///< 1-based, in bytes
  std::uint32_t end_line = 0;  ///< of the byte behind it
  std::uint32_t end_column = 0;
};

struct Inertial {
  double mass = 0;                 ///< [kg]
  Vec3d center_of_mass;            ///< in the link frame [m]
  Quatd axes = kIdentityRotation;  ///< link <- frame of `inertia`
  Mat3d inertia;  ///< about the centre of mass [kg m^2], symmetric, in the frame `axes`
  Place place;

  /// The same in the axes of the link.
  Mat3d inertia_in_link() const;
};

enum class GeometryKind : std::uint8_t {
  Box,        ///< half_extents
  Sphere,     ///< radius
  Ellipsoid,  ///< half_extents are the semi-axes
  Cylinder,   ///< radius, half_height along Z
  Capsule,    ///< radius, half_height without the caps, along Z
  Plane,      ///< solid below z = 0; half_extents x, y for display, 0: without end
  Mesh,       ///< mesh, scale
};

/// "box", "sphere", "ellipsoid", "cylinder", "capsule", "plane", "mesh".
std::string_view geometry_name(GeometryKind kind);

struct Geometry {
  GeometryKind kind = GeometryKind::Box;
  Vec3d half_extents;      ///< [m]
  double radius = 0;       ///< [m]
  double half_height = 0;  ///< [m]
  Index mesh = 0;          ///< into RobotModel::meshes
  Vec3d scale{{1, 1, 1}};  ///< of the mesh
};

struct Visual {
  std::string name;  ///< empty: none given
  Pose pose;         ///< in the link frame
  Geometry geometry;
  std::optional<Index> material;  ///< into RobotModel::materials
  Place place;
};

struct Surface {
  std::optional<double> static_friction;
  std::optional<double> dynamic_friction;
  std::optional<double> torsional_friction;  ///< [m]
  std::optional<double> rolling_friction;    ///< [m]
  std::optional<double> restitution;
  std::optional<double> contact_stiffness{};  ///< of contacts as springs [N/m]; none: hard
  std::optional<double> contact_damping{};    ///< beside it [N s/m]
  bool operator==(const Surface&) const = default;
  bool is_default() const { return *this == Surface{}; }
};

struct Collider {
  std::string name;
  Pose pose;  ///< in the link frame
  Geometry geometry;
  Surface surface;
  std::optional<Index> material;       ///< how it looks, where the description says so
  std::optional<Index> contact_class;  ///< into RobotModel::contact_classes; none: touches all
  MujocoContact mujoco;
  Approximation approximation = Approximation::Hull;  ///< of a mesh
  Place place;
};

/// What an image says of a material, beside its colour.
enum class ImageUse : std::uint8_t {
  Occlusion,
  Roughness,
  Metallic,
  Normal,  ///< tangent space, 0 to 1 for -1 to 1
  Opacity,
  Emission,                    ///< light that it gives off, a colour
  RoughnessMetallic,           ///< in green and blue
  OcclusionRoughnessMetallic,  ///< in red, green and blue
};

struct MaterialImage {
  ImageUse use = ImageUse::Normal;
  std::string file;
};

struct Material {
  std::string name;
  std::optional<Vec4d> color;         ///< red, green, blue, opacity as displayed (sRGB), 0 to 1
  std::string texture;                ///< image of the colour, a file; empty: none
  bool tinted = false;                ///< `texture` is multiplied with `color`, else it replaces it
  bool texture_opacity = false;       ///< the opacity is that of `texture`
  bool texture_linear = false;        ///< the numbers in `texture` are linear, not as displayed
  std::vector<MaterialImage> images;  ///< each use once; roughness and metallic are their factors
  // Images are read at scale * (u, v) + offset, where (0, 0) is the corner at the lower left.
  Vec2d texture_scale{{1, 1}};
  Vec2d texture_offset;
  std::optional<double> roughness;  ///< 0 to 1
  std::optional<double> metallic;   ///< 0 to 1
  double emission = 0;              ///< share of its colour that it gives off as light
  Place place;
};

/// A mesh that geometries show: a file, or triangles that came with the description.
struct MeshFile {
  std::string written;  ///< as the description names it
  std::string path;     ///< the file; empty: not found
  Place place;
  std::vector<Vec3f> points;     ///< (point_count) [m], without a file
  std::vector<Vec3i> triangles;  ///< (triangle_count), indices into points
  /// (3 triangle_count), a corner's place in images from the lower left; or empty
  std::vector<Vec2f> texture_coordinates{};
  std::string part{};     ///< the only mesh of the file that is meant, by its name; empty: all
  bool centered = false;  ///< the middle of its box is moved to the origin
};

/// A named frame on a link.
struct Site {
  std::string name;
  Pose pose;                             ///< in the link frame
  std::vector<SiteSensor> sensors{};     ///< one of each kind at most
  std::optional<MujocoVolume> volume{};  ///< that it has in MuJoCo, where not the default
};

struct Link {
  std::string name;
  std::optional<Inertial> inertial;
  std::vector<Visual> visuals;
  std::vector<Collider> colliders;
  std::vector<Site> sites;
  std::vector<Camera> cameras;
  std::vector<Light> lights;
  double gravity_scale = 1;  ///< times gravity
  Place place;
};

enum class JointKind : std::uint8_t {
  Fixed,
  Revolute,    ///< about `axis`, limited
  Continuous,  ///< about `axis`, without limits
  Prismatic,   ///< along `axis`
  Ball,        ///< all rotations
  Planar,      ///< translations in the plane normal to `axis`, rotation about it
  Floating,    ///< free
};

/// "fixed", "revolute", "continuous", "prismatic", "ball", "planar", "floating".
std::string_view joint_kind_name(JointKind kind);

/// Bounds of a joint with one degree of freedom [rad or m], lower <= upper in a valid model.
struct Limit {
  double lower = 0;
  double upper = 0;
};

/// Bounds that a controller must keep (URDF's safety_controller) [rad or m, SI gains].
struct Safety {
  std::optional<double> soft_lower;
  std::optional<double> soft_upper;
  double position_gain = 0;
  double velocity_gain = 0;
};

/// Where edges of a reference switch lie [rad or m] (URDF's calibration).
struct Calibration {
  std::optional<double> rising;
  std::optional<double> falling;
};

/// q = offset + multiplier * leader + higher[0] leader^2 + ... [rad or m].
struct Mimic {
  Index leader = 0;  ///< into RobotModel::joints
  double multiplier = 1;
  double offset = 0;
  std::array<double, 3> higher{};
  Place place;
};

/// effort = stiffness (target - q) + damping (0 - v), clamped to the joint's effort.
struct Drive {
  double stiffness = 0;  ///< [N m/rad or N/m]
  double damping = 0;    ///< [N m s/rad or N s/m]
  double target = 0;     ///< [rad or m]
  /// What a controller may ask for [rad or m; rad/s or m/s without stiffness].
  std::optional<std::array<double, 2>> control_range{};
  std::string name{};  ///< of the actuator; empty: it has none of its own

  /// Effort for one unit of what a controller asks for.
  double control_gain() const { return stiffness != 0 ? stiffness : damping; }
};

struct Joint {
  std::string name;
  JointKind kind = JointKind::Fixed;
  Index parent = 0;  ///< into RobotModel::links
  Index child = 0;
  Pose origin;            ///< of the child link's frame in the parent's, where the coordinate is 0
  Pose frame;             ///< of the joint in the child link; the joint turns about its origin
  Vec3d axis{{1, 0, 0}};  ///< unit vector in the joint frame
  std::optional<Limit> limit;          ///< none: without end
  double effort_limit = kUnlimited;    ///< [N m or N]
  double velocity_limit = kUnlimited;  ///< [rad/s or m/s]
  double damping = 0;                  ///< passive [N m s/rad or N s/m]
  double friction = 0;                 ///< Coulomb [N m or N]
  double armature = 0;                 ///< [kg m^2 or kg]
  double stiffness = 0;                ///< passive spring [N m/rad or N/m]
  double spring_reference = 0;         ///< its rest position [rad or m]
  std::optional<Safety> safety;
  std::optional<Calibration> calibration;
  std::optional<Mimic> mimic;
  std::optional<Drive> drive;
  bool measured = false;  ///< a sensor reads its coordinate, velocity and effort
  MujocoSoftness mujoco;
  Place place;

  /// One degree of freedom about or along `axis`.
  bool has_one_axis() const {
    return kind == JointKind::Revolute || kind == JointKind::Continuous ||
           kind == JointKind::Prismatic;
  }
  Motion motion() const { return kind == JointKind::Prismatic ? Motion::Linear : Motion::Angular; }
};

/// A joint between two links beside the tree, which closes a loop.
struct LoopJoint {
  std::string name;
  /// Ball: one point of each coincides; Fixed; Revolute, Continuous, Prismatic.
  JointKind kind = JointKind::Ball;
  std::array<Index, 2> links{};  ///< into RobotModel::links
  std::array<Pose, 2> frames;    ///< of the joint in the links
  Vec3d axis{{1, 0, 0}};         ///< unit vector in the frames
  double torque_scale = 1;       ///< of Fixed, as MuJoCo weighs rotation [m]
  std::vector<double> solref;    ///< MuJoCo's softness; empty: its default
  std::vector<double> solimp;
};

/// Colliders that touch the same others.
struct ContactClass {
  /// Classes whose colliders do not touch those of this one, perhaps itself too: ascending, into
  /// RobotModel::contact_classes, and the same seen from there.
  std::vector<Index> untouched;
};

struct RobotModel {
  std::string name;
  std::string file;  ///< the description; places are places in it
  std::vector<Link> links;
  Pose root_pose{};  ///< of the link without a parent, where the robot is put
  std::vector<Joint> joints;
  std::vector<Material> materials;
  std::vector<MeshFile> meshes;  ///< each file once
  /// Its links touch each other, except excluded pairs. URDF does not say; its simulators have it
  /// off.
  bool self_collision = true;
  /// Pairs of links whose colliders do not touch each other.
  std::vector<std::array<Index, 2>> excluded_pairs;
  std::vector<ContactClass> contact_classes;
  std::vector<LoopJoint> loops;
  MujocoParts mujoco;
  /// Folders that its files were found in, beside that of the description: ROS packages, folders
  /// of meshes and textures.
  std::vector<std::string> parts_folders;
};

Diagnostic at_place(Diagnostic finding, const Place& place);
/// A finding about a place in the description of `model`.
Diagnostic model_finding(const RobotModel& model, const Place& place, Severity severity,
                         std::string rule, std::string message, std::string fix);

}  // namespace tenon::robot
