// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "tenon/engines/mujoco/build/tree_plan.h"
#include "tenon/engines/mujoco/mujoco_library.h"
#include "tenon/engines/simulation.h"
#include "tenon/math/transform.h"
#include "tenon/scene/joint_dofs.h"
#include "tenon/scene/physics_scene.h"

/// A compiled MuJoCo model and what connects its numbers with those of the neutral scene.
namespace tenon::engines::mujoco {

struct SpecDeleter {
  void operator()(mjSpec* spec) const { mj_deleteSpec(spec); }
};
struct ModelDeleter {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
};
struct DataDeleter {
  void operator()(mjData* data) const { mj_deleteData(data); }
};
using SpecPtr = std::unique_ptr<mjSpec, SpecDeleter>;
using ModelPtr = std::unique_ptr<mjModel, ModelDeleter>;
using SharedModel = std::shared_ptr<mjModel>;
using DataPtr = std::unique_ptr<mjData, DataDeleter>;

/// MuJoCo quaternions are real first.
inline void write_quaternion(double* out, const Quatd& q) {
  out[0] = q.w;
  out[1] = q.x;
  out[2] = q.y;
  out[3] = q.z;
}
inline Quatd read_quaternion(const double* in) { return {in[1], in[2], in[3], in[0]}; }
inline void write_vector(double* out, const Vec3d& v) {
  out[0] = v[0];
  out[1] = v[1];
  out[2] = v[2];
}
inline Vec3d read_vector(const double* in) { return {{in[0], in[1], in[2]}}; }

struct BodyMap {
  int id = 0;          ///< MuJoCo body
  Pose engine_frame;   ///< X_BE: MuJoCo's body frame in ours
  int free_qpos = -1;  ///< first coordinate of a free joint, else -1
  int free_dof = -1;
  double mass = 0;  ///< the true one [kg]; 0 for kinematic bodies
};

/// Degrees of freedom of one joint in MuJoCo, in the order of JointDofs::free; a ball comes last.
struct JointMap {
  scene::JointDofs dofs;
  bool in_tree = false;  ///< coordinates are qpos entries; else they come from the poses
  bool reversed = false;
  bool auxiliary = false;  ///< they are of the auxiliary body of a loop
  std::vector<int> qpos;   ///< (free dof count)
  std::vector<int> dof;    ///< (free dof count)
  int ball_qpos = -1;
  int ball_dof = -1;
  Quatd child_frame = kIdentityRotation;  ///< joint frame in the MuJoCo child body
};

struct DriveMap {
  scene::Index joint = 0;
  scene::Index drive = 0;  ///< into Joint::drives
  int actuator = -1;       ///< -1: not expressible
  int control = -1;        ///< first of two controls: position and velocity target
  /// Of a model for other readers (Purpose::Text): `control` is a position target, or a velocity
  /// target where nothing pulls to a position; the velocity target beside a position has an
  /// actuator and a control of its own, else -1.
  bool is_plain = false;
  int velocity_control = -1;
  int dof = -1;
  int tendon = -1;  ///< of the joint alone, whose friction is the drive (run/coupled_drives.h)
};

/// Which geoms may touch, for scenes that bits and excluded body pairs cannot express.
struct ContactFilter {
  bool needed = false;
  std::vector<int> geom_class;  ///< (geom_count)
  std::vector<char> class_off;  ///< (class_count x class_count): 1 where contacts are off
  std::size_t class_count = 0;
  std::vector<std::uint64_t> pairs_off;                 ///< sorted, smaller geom in the upper half
  std::vector<std::vector<scene::Index>> sets_of_geom;  ///< (geom_count), or empty: no pair of sets
  scene::SetPairs sets_off;
};

/// What contacts depend on of a material.
struct SurfaceKind {
  double friction = 0;
  double restitution = 0;
  scene::CombineMode friction_combine = scene::CombineMode::Average;
  scene::CombineMode restitution_combine = scene::CombineMode::Average;
  double stiffness = 0;  ///< of contacts that give way; 0: hard
  double damping = 0;
  bool by_mass = false;  ///< stiffness and damping are by unit of effective mass
  scene::CombineMode damping_combine = scene::CombineMode::Average;
  double patch = 0;      ///< radius of the ball whose patch resists turning [m]
  double min_patch = 0;  ///< least radius of the patch [m]
  bool is_special() const { return stiffness > 0 || patch > 0 || min_patch > 0; }
  auto operator<=>(const SurfaceKind&) const = default;
};

/// A contact whose friction is softened where it slides.
struct SoftContact {
  int contact = 0;  ///< into mjData::contact
  int body0 = 0;    ///< MuJoCo's
  int body1 = 0;
  Vec3d apart;  ///< velocity of body 1 against body 0 there [m/s]
};

/// The surface of each geom; those of pairs are combined when they meet (S-72).
struct Surfaces {
  bool by_contact = false;  ///< numbers are written into made contacts
  std::vector<SurfaceKind> kinds;
  std::vector<int> geom_surface;  ///< (geom_count) into kinds; -1: made contacts are left alone
  /// The same per collider and geom of it, until ids of geoms are known.
  std::vector<std::vector<int>> of_collider;
  double time_step = 0;
  std::map<double, std::array<double, 2>> solref;  ///< by restitution, of those met so far
  /// (geom_count) the collider says how soft its contacts are; until then per collider.
  std::vector<char> keeps_solref;
  std::vector<SoftContact> softened;  ///< of the last step
};

/// What connects the numbers of a model with those of the scene.
struct ModelMaps {
  TreePlan plan;
  std::vector<BodyMap> bodies;   ///< (body_count)
  std::vector<JointMap> joints;  ///< (joint_count)
  std::vector<DriveMap> drives;
  std::vector<std::vector<int>> geoms_of_collider;  ///< (collider_count)
  std::vector<int> collider_of_geom;                ///< (geom_count)
  std::vector<int> mocap_of_collider;  ///< (collider_count); -1: does not move by itself
  ContactFilter filter;
  Surfaces surfaces;
  bool curved_shapes = false;  ///< see build/touching.h
  bool sliding = false;        ///< friction is softened where surfaces slide
  std::vector<NotMapped> not_mapped;
  std::vector<int> auxiliary_bodies;  ///< MuJoCo bodies whose weights compile() has set
  /// (tendon_count) into `drives`, of the tendons that are drives; -1: of others. Empty: none is.
  std::vector<int> drive_of_tendon;
};

struct Model : ModelMaps {
  SharedModel model;
  bool shared = false;  ///< others step `model` too: own_model() before it is written
  DataPtr data;
};

/// The model for writing: a copy of its own where it is shared.
mjModel& own_model(Model& model);
/// A model of the same maps and the same shared mjModel without data.
Model share_model(const ModelMaps& maps, const SharedModel& model);

}  // namespace tenon::engines::mujoco
