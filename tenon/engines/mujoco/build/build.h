// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/engines/mujoco/build/tree_plan.h"
#include "tenon/engines/mujoco/model.h"
#include "tenon/engines/scene_timeline.h"

/// The passes that turn a PhysicsScene into a MuJoCo model. Each fills its part of one Build.
namespace tenon::engines::mujoco {

inline constexpr double kAuxiliaryMassRatio = 1e-3;  ///< mass of an auxiliary body to that of body1

/// What a model is for: tenon's own runs, or text for other readers.
///
/// Text has the frames of the asset, where runs move free bodies by their centre of mass; actuators
/// that every MuJoCo, MJX and MuJoCo Warp know, where runs have one of two inputs; efforts as
/// limits of joints where no drive acts that runs would limit; inertias that compilers take as they
/// are; and nothing of what only a run needs (room for contacts, no restarts).
enum class Purpose : std::uint8_t { Run, Text };

/// The auxiliary body of a loop joint.
struct AuxiliaryBody {
  mjsBody* body = nullptr;
  mjsBody* welded_to = nullptr;
  scene::Index joint = 0;
};

/// A bound of a joint or tendon that gives way as a spring beyond it.
struct SoftBound {
  mjsJoint* joint = nullptr;
  mjsTendon* tendon = nullptr;  ///< where `joint` is none
  double stiffness = 0;
  double damping = 0;
};

/// What one mesh of MuJoCo is made from.
struct MeshKey {
  std::vector<float> points;  ///< (3 x point_count)
  int most_vertices = 0;      ///< of its hull; 0: as many as there are
  auto operator<=>(const MeshKey&) const = default;
};

/// What the passes share until the model is compiled.
struct Build {
  Build(const scene::PhysicsScene& source, Diagnostics& findings)
      : scene(source), diagnostics(findings), spec(mj_makeSpec()) {}

  const scene::PhysicsScene& scene;
  Diagnostics& diagnostics;
  SpecPtr spec;
  double time_step = 0.002;  ///< [s]
  Purpose purpose = Purpose::Run;
  DriveTerms drive_terms = DriveTerms::Engine;
  Methods methods;
  TreePlan plan;
  std::vector<mjsBody*> bodies;              ///< (body_count)
  std::vector<Pose> engine_frames;           ///< X_BE (body_count)
  std::vector<std::vector<mjsGeom*>> geoms;  ///< (collider_count)
  /// Materials of these (collider_count), into PhysicsScene::materials.
  std::vector<std::vector<std::optional<scene::Index>>> geom_materials;
  std::vector<mjsBody*> static_bodies;               ///< (collider_count), nullptr for moving ones
  std::vector<scene::JointDofs> dofs;                ///< (joint_count)
  std::vector<std::vector<mjsJoint*>> joints;        ///< (joint_count), in the order of dofs.free
  std::vector<mjsJoint*> balls;                      ///< (joint_count), nullptr where there is none
  std::vector<std::vector<mjsActuator*>> actuators;  ///< (joint_count), one per drive or nullptr
  /// (joint_count) beside them, for target velocities, of text; one per drive or nullptr.
  std::vector<std::vector<mjsActuator*>> velocity_actuators;
  /// (joint_count) tendons for drives that may be solved with constraints; one per drive or
  /// nullptr.
  std::vector<std::vector<mjsTendon*>> drive_tendons;
  std::vector<AuxiliaryBody> auxiliary_bodies;
  std::vector<SoftBound> soft_bounds;
  std::vector<NotMapped> not_mapped;
  std::map<MeshKey, std::string> mesh_names;  ///< of those that colliders have made
  std::set<std::string> sites;                ///< names of those that site_at made
  std::set<Path> refused;  ///< colliders that are skipped, joints that get no limits
  double driven_mass = 0;  ///< of bodies that follow a pose track [kg]

  void report(const Path& prim, std::string property, std::string why) {
    not_mapped.push_back({prim, std::move(property), std::move(why)});
  }
};

/// Options of the solver.
void add_options(Build& build);
/// MuJoCo bodies along the plan, with explicit inertia; free joints of roots.
void add_bodies(Build& build);
/// Joints of the tree: hinges, slides and balls with limits, springs and friction.
void add_joints(Build& build);
/// Loop joints, distance bounds, cones and mimics.
void add_equalities(Build& build);
/// Tendons that the asset has. After add_geoms.
void add_tendons(Build& build);
/// Colliders. Errors: Limit for more than a model may have.
Result<void> add_geoms(Build& build);
/// A second geom that touches nothing for bodies with one mesh. MuJoCo looks at boxes around shapes
/// before it looks for contacts, but not between two bodies of one geom each: the convex search
/// then runs for each two spheres that meet. Contacts are the same. After add_tendons.
void add_box_tests(Build& build);
/// Drives.
void add_actuators(Build& build);
/// Actuators of MuJoCo that are no drives. After add_tendons.
void add_mujoco_actuators(Build& build);
/// Body pairs that never touch and classes of the others. After add_geoms.
ContactFilter add_filters(Build& build);
/// What no pass maps: break forces, velocity limits and the like.
void report_unmapped(Build& build);

/// Compiles the spec; ids of everything are known from here on. Errors: Invalid with MuJoCo's
/// words.
Result<Model> compile(Build& build);
/// Turns what the passes noted per collider into tables per geom.
void connect_geoms(Model& model, ContactFilter filter, Surfaces surfaces);
/// qpos, qvel, controls and constant forces at time 0.
Result<void> set_initial_state(const scene::PhysicsScene& scene, Begin begin, Model& model,
                               Diagnostics& diagnostics);
/// The model has the gravity of the first scene: what a body of another one feels beyond it [N].
/// `mass` is the true one; `gravity` that of each scene [m/s^2].
Vec3d other_gravity(const scene::Body& body, double mass, std::span<const Vec3d> gravity);
/// Colliders that overlap at the start and may touch: MuJoCo pushes them apart.
void report_overlaps(const scene::PhysicsScene& scene, const Model& model,
                     Diagnostics& diagnostics);

/// A model and what it was compiled from.
struct SpecAndModel {
  SpecPtr spec;
  Model model;
};

/// All passes. A part that MuJoCo refuses is skipped with a warning.
Result<SpecAndModel> build_spec(const scene::PhysicsScene& scene, const SimulationOptions& options,
                                Diagnostics& diagnostics, Begin begin = Begin::Start,
                                Purpose purpose = Purpose::Run);
/// The same where only the model is wanted.
Result<Model> build_model(const scene::PhysicsScene& scene, const SimulationOptions& options,
                          Diagnostics& diagnostics, Begin begin = Begin::Start);

// ---- shared by the passes

/// Makes an equality or a tendon's bound as hard as the time step allows.
void make_hard(double time_step, mjtNum* solref, mjtNum* solimp);
/// Gives the limit of a joint the softness that the asset says, else one that robots survive; see
/// softness.cpp.
void soften_limit(double time_step, const scene::MujocoSoftness& authored, mjtNum* solref,
                  mjtNum* solimp);
/// Lets friction of a joint act as the asset says, else within a time step; see softness.cpp.
void harden_friction(double time_step, const scene::MujocoSoftness& authored, mjtNum* solref,
                     mjtNum* solimp);
/// MuJoCo's numbers of a constraint that is a spring-damper; see softness.cpp.
struct SpringReference {
  double stiffness = 0;  ///< -solref[0]
  double damping = 0;    ///< -solref[1]
  double impedance = 0;  ///< solimp[0] and [1]
};
/// `stiffness` [1/s^2] and `damping` [1/s] by unit of mass.
SpringReference spring_reference(double stiffness, double damping, double time_step);
/// Gives the bounds that are springs their numbers, once the inertias before them are known.
void soften_bounds(const Build& build, mjModel& model);
/// The spring of a degree of freedom of a joint; nullptr where there is none.
const scene::LimitSpring* limit_spring(const scene::Joint& joint, scene::Dof dof);
/// How far from the anchor the two points of a loop hinge stand: the size of what hangs on it [m].
double hinge_arm(const scene::PhysicsScene& scene, const scene::Joint& joint);
/// Joints that carry `dofs` between MuJoCo body `child` and its parent; see joints.cpp.
void add_chain(Build& build, scene::Index joint, mjsBody* child, const Pose& joint_in_child,
               bool reversed);
/// The MuJoCo body of a joint side; the world for none.
mjsBody* side_body(Build& build, const std::optional<scene::Index>& body);
/// A joint frame seen from the MuJoCo body of that side.
Pose side_frame(const Build& build, const std::optional<scene::Index>& body, const Pose& frame);
/// The name of the site at a place, made when first asked for.
std::string site_at(Build& build, const scene::TendonWrap::Attachment& place);
/// Sets name, position and orientation.
void place(mjsBody* body, const std::string& name, const Pose& pose);
/// The scene's coordinate of a dof is this MuJoCo joint; nullptr when it has none.
mjsJoint* scalar_joint(const Build& build, scene::Index joint, scene::Dof dof);

}  // namespace tenon::engines::mujoco
