// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tenon/base/containers/apart.h"
#include "tenon/base/path.h"
#include "tenon/math/matrix.h"
#include "tenon/math/transform.h"
#include "tenon/math/vector.h"
#include "tenon/scene/mujoco_parts.h"
#include "tenon/scene/object_settings.h"
#include "tenon/scene/sensors.h"
#include "tenon/scene/vendor_parts.h"

/// The neutral description of a physics scene: what every engine receives. Plain structs; metres,
/// kilograms, seconds, radians; world axes as the stage has them. Knows neither USD composition nor
/// any engine. Objects refer to each other by index; every list is sorted by path.
namespace tenon::scene {

inline constexpr double kUnlimited = kInfinity;
using Index = std::uint32_t;

struct Scene {
  Path path;      ///< empty: made up because the stage has none (S-18)
  Vec3d gravity;  ///< [m/s^2]
  std::optional<double>
      time_step;  ///< [s] asked for by the asset (Newton, PhysX or MuJoCo scene API)
  SceneParts parts{};
};

enum class MassSource : std::uint8_t { Authored, Density, Default };

/// "authored", "density" or "default".
std::string_view mass_source_name(MassSource source);

/// The instance of a UsdGeomPointInstancer that a body comes from (S-38). The path of such a body
/// is made up: it names no prim of the stage.
struct InstanceSource {
  Path instancer;
  Path prototype;                   ///< the target of the instancer
  Path prim;                        ///< the body's prim at or below the prototype
  Index index = 0;                  ///< into the instancer's arrays
  Mat4d world = Mat4d::identity();  ///< of the prim at the start, stage units
  bool nested = false;              ///< the instancer itself is in an instance of another
};

struct Body {
  Path path;
  bool kinematic = false;  ///< pose is given, never computed (S-27); so while not `enabled`
  bool enabled = true;     ///< false: stands still, until a SwitchTrack says otherwise (S-28)
  bool starts_asleep = false;
  Index scene = 0;                    ///< into PhysicsScene::scenes
  Pose pose;                          ///< X_WB at the start: world <- body, unscaled
  Vec3d linear_velocity;              ///< of the centre of mass, world axes [m/s]
  Vec3d angular_velocity;             ///< world axes [rad/s]
  double mass = 1;                    ///< [kg]
  Vec3d center_of_mass;               ///< in the body frame [m]
  Mat3d inertia = Mat3d::identity();  ///< about the centre of mass, body axes [kg m^2], symmetric
  MassSource mass_source = MassSource::Default;
  double linear_damping = 0;   ///< [1/s]
  double angular_damping = 0;  ///< [1/s]
  double gravity_scale = 1;
  BodySettings settings{};
  BodyParts parts{};
  Apart<InstanceSource> instance;
};

enum class ShapeKind : std::uint8_t {
  Box,         ///< half_extents
  Sphere,      ///< radius
  Ellipsoid,   ///< half_extents are the semi-axes (a sphere under non-uniform scale, S-53)
  Capsule,     ///< radius, half_height without the caps, along `axis`
  Cylinder,    ///< radius, half_height, along `axis`
  Cone,        ///< radius of the base, half_height; apex at +axis
  Plane,       ///< solid below the plane through the origin with normal +axis
  ConvexHull,  ///< hull of mesh points
  Mesh,        ///< the triangles themselves
  Spheres,     ///< sphere_centers and sphere_radii (UsdGeomPoints)
};

/// "box", "sphere", "ellipsoid", "capsule", "cylinder", "cone", "plane", "convexHull", "mesh",
/// "spheres".
std::string_view shape_name(ShapeKind kind);

enum class Axis : std::uint8_t { X, Y, Z };

/// Triangles in the collider's frame, scale included [m]; outward winding is counter-clockwise.
struct TriangleMesh {
  std::vector<Vec3d> points;     // (point_count)
  std::vector<Vec3i> triangles;  // (triangle_count), indices into points
  bool flat = false;             ///< all points in one plane: no volume, touched from both sides
};

struct Shape {
  ShapeKind kind = ShapeKind::Box;
  Vec3d half_extents;      ///< [m]
  double radius = 0;       ///< [m]
  double half_height = 0;  ///< [m]
  Axis axis = Axis::Z;
  Index mesh = 0;  ///< into PhysicsScene::meshes, of ConvexHull and Mesh
  /// Of ConvexHull: the hulls of its convex decomposition (S-62), into PhysicsScene::meshes; empty:
  /// the one hull of `mesh`.
  std::vector<Index> pieces;
  std::vector<Vec3d> sphere_centers;  ///< [m], in the collider frame
  std::vector<double> sphere_radii;   ///< [m]
};

/// How a mesh asks to collide (S-62). `Collider::shape` is what it does collide as.
enum class Approximation : std::uint8_t {
  None,
  ConvexHull,
  ConvexDecomposition,
  MeshSimplification,
  BoundingSphere,
  BoundingCube,
  Sdf,         ///< PhysX: a field of distances to the surface
  SphereFill,  ///< PhysX: spheres inside
};

/// The schema's token.
std::string_view approximation_name(Approximation approximation);

/// Triangles of a Mesh shape that have another material than the collider (S-70).
struct FaceMaterial {
  Path subset;                    ///< the GeomSubset
  std::optional<Index> material;  ///< into PhysicsScene::materials; none: no physics material
  std::vector<Index> triangles;   ///< into TriangleMesh::triangles, ascending
};

struct Collider {
  Path path;
  std::optional<Index> body;  ///< none: static
  Index scene = 0;
  Shape shape;
  Pose pose;                      ///< X_BC relative to the body, or X_WC for a static one
  std::optional<Index> material;  ///< into PhysicsScene::materials
  std::vector<FaceMaterial> face_materials;    ///< where shape is a Mesh, by subset path
  std::optional<Approximation> approximation;  ///< of meshes: what the asset asks for
  bool enabled = true;
  std::optional<double> contact_offset;  ///< distance at which contacts begin to be made [m]
  std::optional<double> rest_offset;     ///< [m]
  std::optional<int> max_hull_vertices;
  ColliderSettings settings{};
  ColliderParts parts;
};

/// How the coefficients of two materials become that of a contact; of two modes the later one in
/// this list counts, as PhysX has it (S-72).
enum class CombineMode : std::uint8_t { Average, Min, Multiply, Max };

/// The coefficient of a pair.
double combine(double a, CombineMode mode_a, double b, CombineMode mode_b);
/// "average", "min", "multiply" or "max".
std::string_view combine_name(CombineMode mode);

/// Contacts that give way like springs.
struct Compliance {
  double stiffness = 0;       ///< [N/m]; with `acceleration` [1/s^2]
  double damping = 0;         ///< [N s/m]; with `acceleration` [1/s]
  bool acceleration = false;  ///< per unit of the effective mass of the contact
  CombineMode damping_combine = CombineMode::Average;
};

struct Material {
  Path path;
  double static_friction = 0;
  double dynamic_friction = 0;
  double restitution = 0;
  double density = 0;                          ///< [kg/m^3]; 0: none given
  std::optional<double> torsional_friction{};  ///< about the normal of a contact [m]
  std::optional<double> rolling_friction{};    ///< [m]
  CombineMode friction_combine = CombineMode::Average;
  CombineMode restitution_combine = CombineMode::Average;
  Compliance compliance{};  ///< stiffness 0: hard
};

enum class JointKind : std::uint8_t { Revolute, Prismatic, Spherical, Fixed, Distance, D6 };

/// "revolute", "prismatic", "spherical", "fixed", "distance", "d6".
std::string_view joint_kind_name(JointKind kind);

/// Degrees of freedom in the joint frame. Revolute and prismatic joints use the one that their axis
/// names: RotX..RotZ, TransX..TransZ.
enum class Dof : std::uint8_t { TransX, TransY, TransZ, RotX, RotY, RotZ, Distance };

/// "transX" ... "rotZ", "distance".
std::string_view dof_name(Dof dof);
inline bool is_angular(Dof dof) { return dof >= Dof::RotX && dof <= Dof::RotZ; }

/// Bounds of one degree of freedom [m or rad]; lower > upper: locked at zero (S-98).
struct Limit {
  Dof dof = Dof::RotX;
  double lower = -kUnlimited;
  double upper = kUnlimited;
  bool locked() const { return lower > upper; }
};

/// How the bounds of one degree of freedom give way: without stiffness they are hard and rebound,
/// else they are a spring beyond them. [N m/rad or N/m], [N m s/rad or N s/m]
struct LimitSpring {
  Dof dof = Dof::RotX;
  double stiffness = 0;
  double damping = 0;
  double restitution = 0;       ///< of hard bounds: speed after to speed before
  double bounce_threshold = 0;  ///< slower impacts do not rebound [rad/s or m/s]
};

/// force = stiffness (target_position - q) + damping (target_velocity - v), clamped to +-max_force
/// (S-102). [N, m] or [N m, rad]; with `acceleration` the gains are per unit of effective inertia.
struct Drive {
  Path source;  ///< the prim that authors it: the joint, or an actuator prim
  Dof dof = Dof::RotX;
  bool acceleration = false;
  double stiffness = 0;
  double damping = 0;
  double max_force = kUnlimited;
  double target_position = 0;
  double target_velocity = 0;
  DriveEnvelope envelope{};
};

/// One degree of freedom of a joint follows one of another: q = offset + multiplier * leader
/// (+ higher powers) [m or rad]. The compliance is that of a spring of `natural_frequency` [rad/s]
/// and `damping_ratio`; both 0 means rigid.
struct Mimic {
  std::string schema;          ///< the API that says so, for example "NewtonMimicAPI"
  Dof dof = Dof::RotX;         ///< of the joint, which follows
  Index leader = 0;            ///< into PhysicsScene::joints
  Dof leader_dof = Dof::RotX;  ///< of the leader
  double multiplier = 1;
  double offset = 0;
  std::array<double, 3> higher{};  ///< coefficients of leader^2..leader^4
  double natural_frequency = 0;
  double damping_ratio = 0;
  MimicParts parts;
};

struct Joint {
  Path path;
  JointKind kind = JointKind::D6;
  std::optional<Index> body0;  ///< none: world
  std::optional<Index> body1;  ///< none: world
  Path target0;                ///< prim named by the relationship (may be static), empty: world
  Path target1;
  Pose frame0;  ///< X_B0J in body0, or X_WJ [m]
  Pose frame1;  ///< X_B1J in body1, or X_WJ [m]
  Axis axis = Axis::X;
  double lower = -kUnlimited;  ///< of revolute and prismatic; min distance of Distance (S-97)
  double upper = kUnlimited;   ///< max distance of Distance
  double cone_angle0 =
      kUnlimited;  ///< spherical: tilt of the axis toward the next axis [rad] (S-96)
  double cone_angle1 = kUnlimited;           ///< toward the one after
  std::vector<Limit> limits;                 ///< of D6 joints, and LimitAPI on others (S-100)
  std::vector<LimitSpring> limit_springs{};  ///< by degree of freedom, at most one of each
  std::vector<Drive> drives;
  std::vector<Mimic> mimics;  ///< by degree of freedom, at most one of each
  bool enabled = true;
  bool collision_enabled = false;
  bool exclude_from_articulation = false;
  double break_force = kUnlimited;   ///< [N]
  double break_torque = kUnlimited;  ///< [N m]
  std::optional<Index> articulation;
  double armature = 0;                 ///< added to the joint's inertia [kg m^2] or [kg]
  double friction = 0;                 ///< Coulomb friction [N m] or [N]
  double damping = 0;                  ///< passive [N m s/rad] or [N s/m]
  double stiffness = 0;                ///< passive spring [N m/rad] or [N/m]
  double spring_reference = 0;         ///< rest position of the passive spring [rad or m]
  double velocity_limit = kUnlimited;  ///< [rad/s] or [m/s]
  /// Initial coordinate and velocity from the joint state API [rad or m]; none: from the poses.
  std::optional<double> initial_position;
  std::optional<double> initial_velocity;
  JointParts parts;

  /// The one degree of freedom of revolute and prismatic joints.
  Dof dof() const;
};

struct Articulation {
  Path path;  ///< prim with the articulation root API
  Path root;  ///< root body, or the joint that fixes it to the world
  bool fixed_base = false;
  std::vector<Index> links;  ///< bodies, root first, then in path order
  std::vector<Index> joints;
  std::vector<Index> loop_joints;  ///< closed by constraints, not part of the tree
  bool self_collision = true;
  ArticulationParts parts{};
};

/// Pairs of sets of colliders, first <= second, sorted, unique: no collider of one touches any of
/// the other. A set may be paired with itself.
using SetPairs = std::vector<std::pair<Index, Index>>;

/// What one joint keeps apart while it is enabled (S-91, S-92).
struct JointPairs {
  Index joint = 0;
  SetPairs sets;
};

/// Which colliders may touch. Only ever removes pairs.
struct CollisionFilter {
  /// Groups of each collider (indices into `group_paths`); empty for ungrouped ones.
  /// (collider_count)
  std::vector<std::vector<Index>> groups_of_collider;
  std::vector<Path> group_paths;
  /// (group_count x group_count) row-major: 1 where contacts between the groups are off.
  std::vector<char> group_pair_off;
  /// (group_count): 1 where the group does not touch ungrouped colliders (S-78).
  std::vector<char> ungrouped_off;
  /// Sets of colliders that filtered pairs, joints and articulations mean: those of a body, of an
  /// articulation, below a prim. For each collider the sets that it is in, ascending; may end
  /// early. (at most collider_count)
  std::vector<std::vector<Index>> sets_of_collider;
  /// What filtered pairs, joints and articulations keep apart now (S-81, S-92, S-115).
  SetPairs sets_off;
  /// Those of them that hold whatever becomes of the joints below.
  SetPairs permanent_sets_off;
  /// What single joints keep apart: of those that may break or be switched.
  std::vector<JointPairs> joint_pairs;

  /// Whether groups let colliders touch that are in these groups (S-77, S-78).
  bool groups_allow(const std::vector<Index>& a, const std::vector<Index>& b) const;
};

/// A scalar that follows authored time samples during the simulation.
enum class Animated : std::uint8_t {
  DriveTargetPosition,
  DriveTargetVelocity,
  DriveStiffness,
  DriveDamping,
  DriveMaxForce,
};

struct ScalarTrack {
  Animated what = Animated::DriveTargetPosition;
  Index joint = 0;
  Index drive = 0;             ///< into Joint::drives
  std::vector<double> times;   ///< [s] from the start, ascending (sample_count)
  std::vector<double> values;  ///< SI (sample_count)
  bool held = false;           ///< stage interpolation: held instead of linear
  double at(double seconds) const;
};

/// What can be switched on and off while a simulation runs.
enum class Switch : std::uint8_t {
  BodyEnabled,
  BodyKinematic,
  ColliderEnabled,
  JointEnabled,
  JointCollision,  ///< `collision_enabled` of a joint
};

/// A switch that follows authored samples; each holds until the next (S-28, S-91).
struct SwitchTrack {
  Switch what = Switch::BodyKinematic;
  Index object = 0;           ///< into bodies, colliders or joints
  std::vector<double> times;  ///< [s] from the start, ascending (sample_count)
  std::vector<char> values;   ///< 1: on (sample_count)
  bool at(double seconds) const;
};

/// The bounds of one joint, as in Joint.
struct JointBounds {
  double lower = -kUnlimited;
  double upper = kUnlimited;
  double cone_angle0 = kUnlimited;
  double cone_angle1 = kUnlimited;
  std::vector<Limit> limits;
};

/// Bounds that follow authored samples; open ends are not interpolated.
struct BoundsTrack {
  Index joint = 0;
  std::vector<double> times;        ///< [s], ascending (sample_count)
  std::vector<JointBounds> bounds;  ///< (sample_count)
  bool held = false;
  JointBounds at(double seconds) const;
};

/// Gravity of one scene over time.
struct GravityTrack {
  Index scene = 0;
  std::vector<double> times;   ///< [s], ascending (sample_count)
  std::vector<Vec3d> gravity;  ///< [m/s^2] (sample_count)
  bool held = false;
  Vec3d at(double seconds) const;
};

/// The tables of CollisionFilter from a time on, where collision groups are animated.
struct GroupState {
  double time = 0;  ///< [s] from the start
  std::vector<char> group_pair_off;
  std::vector<char> ungrouped_off;
};

/// World pose of a kinematic body, or of a static collider that is animated, over time. With
/// `joint`: the world frame of that side of a joint, whose target is animated and no body (S-86).
struct PoseTrack {
  std::optional<Index> body;      ///< a kinematic body
  std::optional<Index> collider;  ///< else a static collider
  std::vector<double> times;      ///< [s], ascending (sample_count)
  std::vector<Pose> poses;        ///< (sample_count)
  bool held = false;
  std::optional<Index> joint{};  ///< else a side of a joint
  int side = 0;                  ///< of `joint`: 0 or 1
  /// Linear in position, slerp in orientation; the first and last pose outside.
  Pose at(double seconds) const;
};

/// The shapes of one body that move in it, and what that makes of its mass, at one time.
struct BodyShapes {
  std::vector<Pose> poses;            ///< in the body frame (collider_count of the track) [m]
  std::vector<Shape> shapes;          ///< (collider_count of the track)
  double mass = 1;                    ///< [kg]
  Vec3d center_of_mass;               ///< in the body frame [m]
  Mat3d inertia = Mat3d::identity();  ///< as Body::inertia [kg m^2]
};

/// Animation of prims inside a body (S-37). Each sample holds until the next; the change itself
/// gives the body neither velocity nor momentum.
struct ShapesTrack {
  Index body = 0;
  std::vector<Index> colliders;    ///< those that move, ascending
  std::vector<double> times;       ///< [s] from the start, ascending (sample_count)
  std::vector<BodyShapes> shapes;  ///< (sample_count)
  /// The sample in force; the first one before all of them.
  std::size_t at(double seconds) const;
};

/// One object of a list as its samples make it from some times on; before the first it is as in the
/// list. What other tracks and the run decide on is in the states as at the start, and does not
/// count (keep_followed of timeline/object_states.h).
template <class Object>
struct ObjectTrack {
  Index object = 0;
  std::vector<double> times;   ///< [s] from the start, ascending (state_count)
  std::vector<Object> states;  ///< each holds until the next (state_count)
};

/// Mass, centre of mass and inertia of a body, as in Body.
struct BodyMass {
  double mass = 1;                    ///< [kg]
  Vec3d center_of_mass;               ///< in the body frame [m]
  Mat3d inertia = Mat3d::identity();  ///< [kg m^2]
};

/// A body that samples switch off inside another one: while it is off it moves as a part of that.
struct MergedBody {
  Index body = 0;
  Index into = 0;  ///< the nearest body around it that is on
};

/// Which bodies are parts of others from a time on (S-23).
struct NestingState {
  double time = 0;                 ///< [s] from the start; the first one holds before, too
  std::vector<MergedBody> merged;  ///< ascending
  /// The masses of merged bodies and of those they are merged into in that state, ascending by
  /// body: what a merged body adds, or nothing where the outer body's own mass API speaks for all.
  std::vector<std::pair<Index, BodyMass>> masses;
};

/// A property of the stage that this description does not support; never silent.
struct NotRead {
  Path prim;
  std::string property;
  std::string why;
};

/// What a PhysicsScene holds: an aggregate, whose members the compiler counts (fields/field.h).
struct SceneContents {
  std::vector<Scene> scenes;  ///< at least one
  std::vector<Body> bodies;
  std::vector<Collider> colliders;
  std::vector<TriangleMesh> meshes;
  std::vector<Material> materials;
  Material unbound{{}, 0.5, 0.5, 0, 0};  ///< of colliders without a material (S-71)
  std::vector<Joint> joints;
  std::vector<Articulation> articulations;
  std::vector<Tendon> tendons;
  /// Actuators of MuJoCo that are no drives of joints.
  std::vector<MujocoActuator> actuators;
  std::vector<Sensor> sensors;
  CollisionFilter filter;
  std::vector<ScalarTrack> scalar_tracks;
  std::vector<PoseTrack> pose_tracks;
  std::vector<SwitchTrack> switch_tracks;
  std::vector<BoundsTrack> bounds_tracks;
  std::vector<GravityTrack> gravity_tracks;
  std::vector<ShapesTrack> shapes_tracks;
  std::vector<ObjectTrack<Scene>> scene_tracks;
  std::vector<ObjectTrack<Body>> body_tracks;
  std::vector<ObjectTrack<Collider>> collider_tracks;
  std::vector<ObjectTrack<Material>> material_tracks;
  std::vector<ObjectTrack<Joint>> joint_tracks;
  std::vector<ObjectTrack<Tendon>> tendon_tracks;
  std::vector<ObjectTrack<MujocoActuator>> actuator_tracks;
  std::vector<GroupState> group_states;  ///< ascending in time; empty: `filter` holds throughout
  std::vector<NestingState> nesting_states;  ///< ascending in time; empty: no body is ever merged
  std::vector<NotRead> not_read;

  double meters_per_unit = 0.01;  ///< of the stage, to go back to its units
  double kilograms_per_unit = 1;
  Vec3d up{{0, 1, 0}};
  double start_time_code = 0;  ///< stage time of the start of the simulation
  double time_codes_per_second = 24;
  double end_time_code = 0;  ///< authored end, or the start when none is authored
};

/// Pairs of colliders, first < second, sorted, unique.
struct ColliderPairs {
  std::vector<std::pair<Index, Index>> pairs;
  bool is_cut = false;  ///< there are more

  bool operator==(const ColliderPairs&) const = default;
};

struct PhysicsScene : SceneContents {
  // Compiled once: each goes through all lists.
  PhysicsScene();
  PhysicsScene(const PhysicsScene&);
  PhysicsScene(PhysicsScene&&) noexcept;
  PhysicsScene& operator=(const PhysicsScene&);
  PhysicsScene& operator=(PhysicsScene&&) noexcept;
  ~PhysicsScene();

  /// Brings filter.sets_off up to date with what the joints are now (enabled, collision_enabled).
  void update_joint_pairs();
  /// Whether forces move the body: it is not the world (none) and not kinematic.
  bool is_dynamic(const std::optional<Index>& body) const {
    return body && !bodies[*body].kinematic;
  }
  /// Contacts between two colliders are possible: different bodies, enabled, same scene, not
  /// filtered, no triggers.
  bool may_collide(Index collider_a, Index collider_b) const;
  /// The same, also of triggers and of bodies whose contacts exert nothing.
  bool may_meet(Index collider_a, Index collider_b) const;
  /// The pairs of colliders that filters keep apart, of sets and of groups; for reports. They are
  /// cut at limits::kDisabledPairs, or where finding them takes too long.
  ColliderPairs disabled_pairs() const;
  /// The same of groups and of these pairs of sets alone.
  ColliderPairs pairs_apart(const SetPairs& off) const;
};

}  // namespace tenon::scene
