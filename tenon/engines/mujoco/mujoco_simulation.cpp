// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A step writes what the asset says about its time (Timeline, StepInputs), lets MuJoCo advance, and
// breaks joints that carried too much. Bounds and gravity can be changed in the model; for other
// changes of the scene it is rebuilt from the scene as it is now, and poses, velocities and joint
// coordinates are carried over (S-28). Results come from the positions after the last step, from
// which MuJoCo derives poses and velocities only when something is read. Many simulations of one
// model step with data that they lend each other, so that the own data of each has no more than its
// state.
#include "tenon/engines/mujoco/mujoco_simulation.h"

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <string>
#include <utility>

#include "tenon/engines/mujoco/build/build.h"
#include "tenon/engines/mujoco/build/option_fields.h"
#include "tenon/engines/mujoco/contact_filter.h"
#include "tenon/engines/mujoco/error_hook.h"
#include "tenon/engines/mujoco/run/advance.h"
#include "tenon/engines/mujoco/run/carry_over.h"
#include "tenon/engines/mujoco/run/control.h"
#include "tenon/engines/mujoco/run/coupled_drives.h"
#include "tenon/engines/mujoco/run/read_state.h"
#include "tenon/engines/scene_timeline.h"
#include "tenon/engines/watches/passage_watch.h"
#include "tenon/math/angle.h"

namespace tenon::engines::mujoco {
namespace {

using scene::PhysicsScene;

constexpr std::size_t kMemoryOfMany = std::size_t{2} << 20u;  // [bytes]
constexpr std::size_t kMemoryOfManyPerBody = std::size_t{128} << 10u;

}  // namespace

Result<std::unique_ptr<MujocoSimulation>> MujocoSimulation::make(const PhysicsScene& scene,
                                                                 const SimulationOptions& options,
                                                                 Diagnostics& diagnostics,
                                                                 std::size_t how_many) {
  auto timeline = timeline_where_needed(scene);
  const PhysicsScene& now = timeline == nullptr ? scene : timeline->scene();
  TENON_TRY(Model model, build_model(now, options, diagnostics));
  if (steps_by_euler_instead(model)) {
    model.not_mapped.push_back({scene.scenes.front().path, "mjc:option:integrator",
                                "steps are those of Euler's method: with actuation off, bodies "
                                "that start asleep and several materials MuJoCo has no other"});
  }
  auto start = std::make_shared<Start>();
  start->scene = &scene;
  start->options = options;
  start->maps = model;
  start->model = model.model;
  start->state = integration_state(*model.model, *model.data);
  start->asleep = sleeping_trees(*model.model, *model.data);
  model.shared = true;
  if (how_many > 1) {  // room for contacts and constraints of each further one
    start->lender = std::make_unique<DataLender>();
    model.model->narena = std::min<mjtSize>(
        model.model->narena, kMemoryOfMany + kMemoryOfManyPerBody * scene.bodies.size());
  }
  return at_start(std::move(start), std::move(timeline), std::move(model));
}

Result<std::unique_ptr<MujocoSimulation>> MujocoSimulation::at_start(
    std::shared_ptr<const Start> start, std::unique_ptr<scene::Timeline> timeline, Model model) {
  std::unique_ptr<MujocoSimulation> made(
      new MujocoSimulation(std::move(start), std::move(timeline), std::move(model)));
  if (made->outputs_) {
    TENON_CHECK(made->outputs_->at_rest(*made->scene_, made->model_));
  }
  return made;
}

Result<std::unique_ptr<MujocoSimulation>> MujocoSimulation::from_start(
    std::shared_ptr<const Start> start, DataPtr data) {
  Model model = share_model(start->maps, start->model);
  model.data = std::move(data);
  mjData* made_data = nullptr;
  TENON_CHECK(guarded([&] {
    if (model.data != nullptr) {
      mj_resetData(model.model.get(), model.data.get());
    } else {
      made_data = mj_makeData(model.model.get());
    }
  }));
  if (made_data != nullptr) {
    model.data.reset(made_data);
  }
  if (model.data == nullptr) {
    return Error(ErrorCode::Limit, "MuJoCo has no memory for the simulation");
  }
  TENON_CHECK(write_state(model, start->state, start->asleep));
  auto timeline = timeline_where_needed(*start->scene);
  return at_start(std::move(start), std::move(timeline), std::move(model));
}

MujocoSimulation::MujocoSimulation(std::shared_ptr<const Start> start,
                                   std::unique_ptr<scene::Timeline> timeline, Model model)
    : SteeredSimulation(timeline == nullptr ? *start->scene : timeline->scene()),
      start_(std::move(start)),
      timeline_(std::move(timeline)),
      model_(std::move(model)),
      triggers_(*scene_) {
  connect();
}

// What the simulation remembers about the model that it steps.
void MujocoSimulation::connect() {
  inputs_ = StepInputs(*scene_, model_);
  caps_ = VelocityCaps(*scene_, model_);
  energy_watch_ = EnergyWatch(*scene_, model_);
  passages_ = PassageWatch(*scene_, model_);
  limits_ = LimitWatch(*scene_, model_);
  if (timeline_ != nullptr) {
    bounds_ = MovingBounds(*scene_, model_);
    breaking_ = Breaking(*scene_, model_);
  }
  if (outputs().any()) {
    const Work work = outputs_ ? outputs_->work : Work{};
    outputs_.emplace(outputs(), *scene_, model_);
    outputs_->work = work;
  }
  contact_count_.reset();
  stale_ = true;
}

Result<void> MujocoSimulation::step() {
  if (may_borrow()) {
    if (DataPtr lent = start_->lender->take(*model_.model); lent != nullptr) {
      return take_step_with(std::move(lent));
    }
  }
  contact_count_.reset();
  return take_step();
}

// Whether a step begins with the state of integration alone, and nothing but that is read after it.
bool MujocoSimulation::may_borrow() const {
  return start_->lender != nullptr && timeline_ == nullptr && !outputs_ && triggers_.empty() &&
         !inputs_.has_acceleration_drives() && (model_.model->opt.enableflags & mjENBL_SLEEP) == 0;
}

Result<void> MujocoSimulation::take_step_with(DataPtr lent) {
  mj_copyState(model_.model.get(), model_.data.get(), lent.get(), mjSTATE_INTEGRATION);
  stale_ = true;
  std::swap(model_.data, lent);
  Result<void> done = take_step();
  contact_count_ = read_contact_count(model_);
  std::swap(model_.data, lent);
  mj_copyState(model_.model.get(), lent.get(), model_.data.get(), mjSTATE_INTEGRATION);
  stale_ = true;
  if (done) {
    start_->lender->give_back(std::move(lent));
  } else {
    std::copy(std::begin(lent->warning), std::end(lent->warning), model_.data->warning);
  }
  return done;
}

Result<void> MujocoSimulation::take_step() {
  if (timeline_ != nullptr) {
    TENON_CHECK(follow_changes());
  }
  if (inputs_.needs_motion() || outputs_) {
    bring_up_to_date();
  }
  if (!steering_.efforts.empty()) {
    bring_up_to_date();
    write_efforts(*scene_, steering_, model_);
  }
  inputs_.before_step(model_);
  energy_watch_.begin(model_, inputs_.has_forces() || !steering_.efforts.empty());
  if (outputs_) {
    outputs_->begin(*scene_, model_);
  }
  if (!caps_.empty()) {
    caps_.begin(model_);
  }
  stale_ = true;
  {
    const FilterScope filter(model_.filter);
    const FinishScope finish(model_);
    TENON_CHECK(guarded_where_open([this] { advance(model_); }));
  }
  TENON_CHECK(check_step(model_));
  if (!caps_.empty()) {
    caps_.apply(model_);
  }
  if (outputs_) {
    TENON_CHECK(outputs_->end(*scene_, steering_, model_));
  }
  TENON_CHECK(watch());
  inputs_.after_step(model_);
  if (!triggers_.empty()) {
    bring_up_to_date();
    triggers_.update(*scene_, model_, &events_);
  }
  return breaking_.empty() ? Result<void>() : break_joints();
}

Result<void> MujocoSimulation::follow_changes() {
  const double now = time();
  scene::SceneChange changed;
  TENON_CHECK(accounted([&]() -> Result<void> {
    changed = timeline_->advance(now);
    return changed.gravity ? write_gravity() : Result<void>();
  }));
  const bool fits = !changed.bounds || bounds_.write(*scene_, model_);
  if (changed.structure || !fits) {
    return rebuild({now, now, {}, {}, {}});
  }
  advanced_to_ = now;
  return {};
}

Result<void> MujocoSimulation::write_gravity() {
  mujoco::write_gravity(*scene_, steering_, model_);
  energy_watch_.restart();
  inputs_.take_constant_forces(model_);
  return {};
}

// From where the last model has brought the bodies.
Result<void> MujocoSimulation::rebuild(Restart restart) {
  return accounted([&]() -> Result<void> {
    for (std::size_t b = 0; b < scene_->bodies.size(); ++b) {
      restart.states.push_back(body_state(static_cast<scene::Index>(b)));
    }
    timeline_->restart(restart.states);
    TENON_TRY(Model next, model_in_the_middle(*scene_, start_->options, time_step()));
    carry_joints_over(model_, next);
    next.data->time = model_.data->time;
    model_ = std::move(next);
    advanced_to_ = restart.advanced_to;
    history_.push_back(std::move(restart));
    connect();
    TENON_CHECK(apply_steering());
    const FilterScope filter(model_.filter);
    return guarded([&] { forward(model_); });
  });
}

Result<void> MujocoSimulation::break_joints() {
  TENON_TRY(const std::vector<Breaking::Broken> broken, breaking_.broken(*scene_, model_));
  if (broken.empty()) {
    return {};
  }
  Restart restart{time(), advanced_to_, {}, {}, {}};
  for (const Breaking::Broken& part : broken) {
    restart.broken.push_back({part.joint, part.force, part.torque});
  }
  note_broken(restart);
  return rebuild(std::move(restart));
}

void MujocoSimulation::note_broken(const Restart& restart) {
  for (const BrokenJoint& part : restart.broken) {
    char what[96];
    std::snprintf(what, sizeof what, "broke under %.4g N and %.4g N m", part.force, part.torque);
    events_.push_back({restart.time, scene_->joints[part.joint].path, what});
    timeline_->break_joint(part.joint);
  }
}

void MujocoSimulation::note_rebounds() {
  for (const LimitWatch::Rebound& rebound : limits_.look(model_)) {
    const double unit = rebound.angular ? kDegreesPerRadian : 1;
    const char* const name = rebound.angular ? "degrees/s" : "m/s";
    char what[96];
    std::snprintf(what, sizeof what, "was thrown back by its limit with %.3g of %.3g %s",
                  rebound.after * unit, rebound.before * unit, name);
    events_.push_back({time(), scene_->joints[rebound.joint].path, what, EventKind::ThrownBack});
  }
}

// Computed quantities are of the beginning of the step, coordinates and velocities of its end.
Result<void> MujocoSimulation::watch() {
  for (const PassageWatch::Passage& passage : passages_.look(model_)) {
    events_.push_back(passage_event(*scene_, time(), passage.body, passage.collider, passage.step));
  }
  if (model_.data->nl > 0) {
    note_rebounds();
  }
  const std::optional<EnergyWatch::Growth> growth = energy_watch_.end(model_);
  if (!growth) {
    return {};
  }
  const char* name = mj_id2name(model_.model.get(), mjOBJ_BODY, growth->body);
  char text[200];
  std::snprintf(text, sizeof text,
                "the simulation became unstable at %.6g s: bodies move with %.4g J, and neither "
                "drives nor contacts nor forces explain %.4g J that were gained",
                time(), growth->energy, growth->unexplained);
  return Error(ErrorCode::Unstable, text)
      .with_rule("mujoco.unstable")
      .with_prim(name == nullptr ? "" : name)
      .with_fix(
          "start within the limits of joints, where one begins outside; else take a smaller "
          "time step or softer drives");
}

void MujocoSimulation::bring_up_to_date() const {
  if (stale_) {
    derive_motion(model_);
    stale_ = false;
  }
}

double MujocoSimulation::time() const { return model_.data->time; }
double MujocoSimulation::time_step() const { return model_.model->opt.timestep; }
std::vector<scene::VendorSetting> MujocoSimulation::settings() const {
  return run_settings(model_.model->opt);
}
std::size_t MujocoSimulation::dof_count() const {
  return static_cast<std::size_t>(model_.model->nv);
}
std::size_t MujocoSimulation::contact_count() const {
  return contact_count_ ? *contact_count_ : read_contact_count(model_);
}

BodyState MujocoSimulation::body_state(scene::Index body) const {
  bring_up_to_date();
  return read_body_state(*scene_, model_, body);
}

JointState MujocoSimulation::joint_state(scene::Index joint) const {
  if (!model_.joints[joint].in_tree) {
    bring_up_to_date();
  }
  return read_joint_state(*scene_, model_, joint);
}

Vec3d MujocoSimulation::center_of_mass(scene::Index body) const {
  bring_up_to_date();
  return read_center_of_mass(model_, body);
}

Energy MujocoSimulation::energy() const {
  bring_up_to_date();
  return read_energy(*scene_, model_, steering_.gravity_of(*scene_));
}

}  // namespace tenon::engines::mujoco
