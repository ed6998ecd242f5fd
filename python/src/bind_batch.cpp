// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What tenon_usd/world.py stands on: arrays of doubles (environment, ...) go in and out, row by row
// in the order of the environments, so that no result depends on threads. Each call lets other
// threads of Python run, and then waits for its turn with the batch.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "batch.h"
#include "batch_calls.h"
#include "batch_outputs.h"
#include "batch_record.h"
#include "failure.h"
#include "json.h"
#include "numbers.h"
#include "opened_stage.h"
#include "options.h"
#include "physics.h"
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/unique_ptr.h>
#include <nanobind/stl/vector.h>

#include "tenon/scene/fields/enum_names.h"
#include "tenon/scene/joint_dofs.h"

namespace tenon::python {
namespace {

using namespace nb::literals;
using engines::World;

using Numbers = nb::ndarray<const double, nb::c_contig, nb::device::cpu>;

std::span<const double> span_of(const Numbers& array) { return {array.data(), array.size()}; }

/// The array has to have so many numbers; tenon_usd/world.py gives it its shape.
std::span<const double> span_of(const Numbers& array, std::size_t count) {
  if (array.size() != count) {
    throw nb::value_error("the array has another number of values");
  }
  return span_of(array);
}

/// Calls with each environment until one fails.
template <class Call>
Result<void> each(Batch& batch, const Call& call) {
  for (std::size_t i = 0; i < batch.size(); ++i) {
    TENON_CHECK(call(i, batch.world(i)));
  }
  return {};
}

Vec3d vector_at(const double* from) { return {{from[0], from[1], from[2]}}; }
Pose pose_at(const double* from) {
  return {vector_at(from), normalized(Quatd{from[4], from[5], from[6], from[3]})};
}

// ---- what there is

nb::list names_of(const Batch& batch, const std::vector<Coordinate>& parts, bool drives) {
  nb::list names;
  for (const Coordinate& part : parts) {
    const scene::Joint& joint = batch.scene->joints[part.joint];
    std::string name = joint.path.str();
    if (drives && joint.drives.size() > 1) {
      name += ":" + std::string(scene::dof_name(joint.drives[part.part].dof));
    }
    names.append(text(name));
  }
  return names;
}

/// "/hand/joint"; with several degrees of freedom "/hand/joint:rotX", of a ball ":ball0" to 2.
nb::list coordinate_names(const Batch& batch) {
  const auto wanted = scene::wanted_rotations(*batch.scene);
  nb::list names;
  for (const Coordinate& part : batch.coordinates) {
    const scene::Joint& joint = batch.scene->joints[part.joint];
    const auto count = static_cast<std::size_t>(
        std::count_if(batch.coordinates.begin(), batch.coordinates.end(),
                      [&](const Coordinate& other) { return other.joint == part.joint; }));
    std::string name = joint.path.str();
    if (count > 1) {
      const scene::JointDofs dofs = scene::joint_dofs(joint, wanted[part.joint]);
      name += part.part < dofs.free.size()
                  ? ":" + std::string(scene::dof_name(dofs.free[part.part].dof))
                  : ":ball" + std::to_string(part.part - dofs.free.size());
    }
    names.append(text(name));
  }
  return names;
}

template <class Object>
nb::list paths_of(const std::vector<Object>& objects) {
  nb::list paths;
  for (const Object& object : objects) {
    paths.append(text(object.path.str()));
  }
  return paths;
}

// ---- steps

std::size_t step(Batch& batch, std::size_t count) {
  return with(batch, [&] { return batch.stepper.step(*batch.environments, count); });
}

void reset(Batch& batch, const std::vector<std::size_t>& which) {
  for (const std::size_t i : which) {
    check_environment(batch, i);
  }
  or_raise(with(batch, [&]() -> Result<void> {
    for (const std::size_t i : which) {
      TENON_CHECK(batch.reset(i));
    }
    return {};
  }));
}

nb::list failures(Batch& batch) {
  const auto found = with(batch, [&] {
    std::vector<std::optional<Error>> copied;
    for (std::size_t i = 0; i < batch.size(); ++i) {
      const Error* failure = batch.environments->failure(i);
      copied.push_back(failure == nullptr ? std::nullopt : std::optional(*failure));
    }
    return copied;
  });
  nb::list rows;
  for (const std::optional<Error>& failure : found) {
    rows.append(failure ? nb::cast(failure->diagnostic()) : nb::none());
  }
  return rows;
}

nb::object times(Batch& batch) {
  NewArray<> made({batch.size()});
  with(batch, [&] {
    for (std::size_t i = 0; i < batch.size(); ++i) {
      made.numbers[i] = batch.world(i).time();
    }
    return true;
  });
  return made.take();
}

// ---- joints

nb::object joints(Batch& batch) {
  NewArray<> positions({batch.size(), batch.coordinates.size()});
  NewArray<> velocities({batch.size(), batch.coordinates.size()});
  or_raise(with(batch, [&] {
    return batch.environments->read_joints(positions.numbers, velocities.numbers);
  }));
  return nb::make_tuple(positions.take(), velocities.take());
}

/// Positions and velocities of all coordinates; joints whose numbers are those that they had before
/// the call are left alone. What closes a loop moves with the others and cannot be put anywhere.
void set_joints(Batch& batch, const Numbers& positions, const Numbers& velocities) {
  const std::size_t width = batch.coordinates.size();
  const auto p = span_of(positions, batch.size() * width);
  const auto v = span_of(velocities, batch.size() * width);
  or_raise(with(batch, [&] {
    return each(batch, [&](std::size_t i, World& world) -> Result<void> {
      std::vector<std::pair<scene::Index, engines::JointState>> changed;
      for (std::size_t at = 0; at < width;) {
        const scene::Index joint = batch.coordinates[at].joint;
        const engines::JointState now = world.joint_state(joint);
        engines::JointState wanted = now;
        for (std::size_t part = 0; part < now.position.size(); ++part, ++at) {
          wanted.position[part] = p[i * width + at];
          wanted.velocity[part] = v[i * width + at];
        }
        if (wanted.position != now.position || wanted.velocity != now.velocity) {
          changed.emplace_back(joint, std::move(wanted));
        }
      }
      for (const auto& [joint, wanted] : changed) {
        TENON_CHECK(world.set_joint_state(joint, wanted));
      }
      return {};
    });
  }));
}

/// A position that is no number leaves its drive, and what moves its target, alone.
void set_targets(Batch& batch, const Numbers& positions, const Numbers& velocities) {
  const std::size_t width = batch.drives.size();
  const auto p = span_of(positions, batch.size() * width);
  const auto v = span_of(velocities, batch.size() * width);
  or_raise(with(batch, [&] {
    return each(batch, [&](std::size_t i, World& world) -> Result<void> {
      for (std::size_t at = 0; at < width; ++at) {
        const Coordinate& drive = batch.drives[at];
        if (std::isnan(p[i * width + at])) {
          continue;
        }
        const Result<void> done =
            world.set_drive_target(drive.joint, static_cast<scene::Index>(drive.part),
                                   {p[i * width + at], v[i * width + at]});
        // A drive that exerts no force has no target.
        if (!done && done.error().code() != ErrorCode::Unsupported) {
          return done;
        }
      }
      return {};
    });
  }));
}

void set_efforts(Batch& batch, const Numbers& efforts) {
  const std::size_t width = batch.coordinates.size();
  const auto e = span_of(efforts, batch.size() * width);
  or_raise(with(batch, [&] {
    return each(batch, [&](std::size_t i, World& world) -> Result<void> {
      for (std::size_t at = 0; at < width;) {
        const scene::Index joint = batch.coordinates[at].joint;
        std::size_t end = at;
        while (end < width && batch.coordinates[end].joint == joint) {
          ++end;
        }
        TENON_CHECK(world.set_joint_efforts(joint, e.subspan(i * width + at, end - at)));
        at = end;
      }
      return {};
    });
  }));
}

nb::object drive_efforts(Batch& batch) {
  NewArray<> made({batch.size(), batch.drives.size()});
  or_raise(with(batch, [&] {
    return each(batch, [&](std::size_t i, World& world) -> Result<void> {
      double* to = made.numbers.data() + i * batch.drives.size();
      for (std::size_t at = 0; at < batch.drives.size();) {
        TENON_TRY(const std::vector<double> efforts, world.drive_efforts(batch.drives[at].joint));
        to = std::copy(efforts.begin(), efforts.end(), to);
        at += std::max<std::size_t>(efforts.size(), 1);
      }
      return {};
    });
  }));
  return made.take();
}

// ---- bodies

nb::object body_states(Batch& batch) {
  const std::size_t bodies = batch.scene->bodies.size();
  NewArray<> poses({batch.size(), bodies, 7});
  NewArray<> velocities({batch.size(), bodies, 6});
  with(batch, [&] {
    double* pose = poses.numbers.data();
    double* velocity = velocities.numbers.data();
    for (std::size_t i = 0; i < batch.size(); ++i) {
      for (scene::Index b = 0; b < bodies; ++b) {
        const engines::BodyState state = batch.world(i).body_state(b);
        put(state.pose.position, pose);
        put(state.pose.orientation, pose);
        put(state.linear_velocity, velocity);
        put(state.angular_velocity, velocity);
      }
    }
    return true;
  });
  return nb::make_tuple(poses.take(), velocities.take());
}

nb::object body_poses(Batch& batch) {
  const std::size_t bodies = batch.scene->bodies.size();
  NewArray<> poses({batch.size(), bodies, 7});
  with(batch, [&] {
    double* pose = poses.numbers.data();
    for (std::size_t i = 0; i < batch.size(); ++i) {
      for (scene::Index b = 0; b < bodies; ++b) {
        const engines::BodyState state = batch.world(i).body_state(b);
        put(state.pose.position, pose);
        put(state.pose.orientation, pose);
      }
    }
    return true;
  });
  return poses.take();
}

/// (size, 7) and (size, 6) of one body.
/// Whether a state reads as these numbers.
bool is_at(const engines::BodyState& state, const double* pose, const double* velocity) {
  std::array<double, 13> held{};
  double* to = held.data();
  put(state.pose.position, to);
  put(state.pose.orientation, to);
  put(state.linear_velocity, to);
  put(state.angular_velocity, to);
  return std::equal(held.begin(), held.begin() + 7, pose) &&
         std::equal(held.begin() + 7, held.end(), velocity);
}

/// Where nothing changes nothing is set: engines begin the contacts of a body that is set again.
void set_body(Batch& batch, scene::Index body, const Numbers& poses, const Numbers& velocities) {
  const auto p = span_of(poses, batch.size() * 7);
  const auto v = span_of(velocities, batch.size() * 6);
  or_raise(with(batch, [&] {
    return each(batch, [&](std::size_t i, World& world) -> Result<void> {
      if (body < batch.scene->bodies.size() &&
          is_at(world.body_state(body), p.data() + 7 * i, v.data() + 6 * i)) {
        return {};
      }
      return world.set_body_state(body, {pose_at(p.data() + 7 * i), vector_at(v.data() + 6 * i),
                                         vector_at(v.data() + 6 * i + 3)});
    });
  }));
}

void move_kinematic(Batch& batch, scene::Index body, const Numbers& poses) {
  const auto p = span_of(poses, batch.size() * 7);
  or_raise(with(batch, [&] {
    return each(batch, [&](std::size_t i, World& world) {
      return world.move_kinematic(body, pose_at(p.data() + 7 * i));
    });
  }));
}

void set_wrench(Batch& batch, scene::Index body, const Numbers& wrenches) {
  const auto w = span_of(wrenches, batch.size() * 6);
  or_raise(with(batch, [&] {
    return each(batch, [&](std::size_t i, World& world) {
      return world.set_body_wrench(body,
                                   {vector_at(w.data() + 6 * i), vector_at(w.data() + 6 * i + 3)});
    });
  }));
}

// ---- numbers of each environment

std::optional<engines::Parameter> parameter_named(const std::string& name) {
  for (const engines::Parameter parameter :
       {engines::Parameter::BodyMass, engines::Parameter::ColliderFriction,
        engines::Parameter::DriveStiffness, engines::Parameter::DriveDamping,
        engines::Parameter::DriveMaxForce, engines::Parameter::JointDamping,
        engines::Parameter::JointFriction, engines::Parameter::JointArmature}) {
    if (engines::parameter_name(parameter) == name) {
      return parameter;
    }
  }
  return std::nullopt;
}

void set_parameter(Batch& batch, const std::string& name, scene::Index object, scene::Index part,
                   const Numbers& values) {
  const auto numbers = span_of(values, batch.size());
  const auto parameter = parameter_named(name);
  if (!parameter) {
    raise(Error(ErrorCode::NotFound, "there is no parameter \"" + name + "\"")
              .with_fix("bodyMass, colliderFriction, driveStiffness, driveDamping, driveMaxForce, "
                        "jointDamping, jointFriction and jointArmature can be set"));
  }
  or_raise(with(batch, [&] {
    return each(batch, [&](std::size_t i, World& world) {
      return world.set_parameter({*parameter, object, part}, numbers[i]);
    });
  }));
}

nb::object gravity(Batch& batch) {
  NewArray<> made({batch.size(), 3});
  with(batch, [&] {
    double* to = made.numbers.data();
    for (std::size_t i = 0; i < batch.size(); ++i) {
      put(batch.world(i).gravity(0), to);
    }
    return true;
  });
  return made.take();
}

void set_gravity(Batch& batch, const Numbers& values) {
  const auto numbers = span_of(values, batch.size() * 3);
  or_raise(with(batch, [&] {
    return each(batch, [&](std::size_t i, World& world) -> Result<void> {
      for (scene::Index scene = 0; scene < batch.scene->scenes.size(); ++scene) {
        TENON_CHECK(world.set_gravity(scene, vector_at(numbers.data() + 3 * i)));
      }
      return {};
    });
  }));
}

nb::object energies(Batch& batch) {
  NewArray<> made({batch.size(), 2});
  with(batch, [&] {
    for (std::size_t i = 0; i < batch.size(); ++i) {
      const engines::Energy energy = batch.world(i).energy();
      made.numbers[2 * i] = energy.kinetic;
      made.numbers[2 * i + 1] = energy.potential;
    }
    return true;
  });
  return made.take();
}

nb::list not_mapped(Batch& batch) {
  const auto found = with(batch, [&] { return batch.world(0).not_mapped(); });
  nb::list rows;
  for (const engines::NotMapped& one : found) {
    nb::dict row;
    row["prim"] = text(one.prim.str());
    row["property"] = text(one.property);
    row["why"] = message(one.why);
    rows.append(row);
  }
  return rows;
}

std::shared_ptr<ReadScene> scene_of(const Batch& batch) {
  auto read = std::make_shared<ReadScene>();
  read->scene = *batch.scene;
  return read;
}

engines::Outputs outputs_named(const std::vector<std::string>& names) {
  const std::map<std::string, bool engines::Outputs::*> known{
      {"contacts", &engines::Outputs::contacts},
      {"efforts", &engines::Outputs::efforts},
      {"reactions", &engines::Outputs::reactions},
      {"accelerations", &engines::Outputs::accelerations},
      {"work", &engines::Outputs::work},
      {"sensors", &engines::Outputs::sensors}};
  engines::Outputs outputs;
  for (const std::string& name : names) {
    const auto found = known.find(name);
    if (found == known.end()) {
      raise(Error(ErrorCode::Invalid, "there is no output \"" + name + "\"")
                .with_fix("contacts, efforts, reactions, accelerations, work and sensors can be "
                          "asked for"));
    }
    outputs.*(found->second) = true;
  }
  return outputs;
}

BatchOptions batch_options(const std::string& engine, std::size_t count, std::size_t threads,
                           std::uint64_t seed, double time_step,
                           const std::vector<std::string>& outputs,
                           const std::vector<std::string>& variations,
                           const std::string& integrator, dynamics::Masks masks) {
  BatchOptions options;
  options.masks = std::move(masks);
  options.engine = engine;
  options.count = count;
  options.threads = threads;
  options.seed = seed;
  options.variations = variations;
  options.simulation.time_step = time_step;
  options.simulation.outputs = outputs_named(outputs);
  const auto chosen = engines::integrator_named(integrator);
  if (!chosen) {
    raise(Error(ErrorCode::Invalid, "there is no integrator \"" + integrator + "\"")
              .with_fix("euler, implicitfast, implicit and rk4 can be asked for"));
  }
  options.simulation.methods.integrator = *chosen;
  return options;
}

/// Large scenes take long: on a thread that Ctrl-C leaves.
std::unique_ptr<Batch> made_batch(const std::string& path, const OpenOptions& open,
                                  const physics::Readings& readings, const BatchOptions& options) {
  using Call = LeavableCall<std::unique_ptr<Batch>>;
  const auto call = std::make_shared<Call>();
  return or_raise(unlocked([&] {
    return (*call)([=](Leavable&) { return Batch::make(path, open, readings, options); });
  }));
}

std::unique_ptr<Batch> make_batch(const std::filesystem::path& path, const OpenArguments& arguments,
                                  const BatchOptions& options) {
  return made_batch(path.string(), arguments.open, readings_of(arguments), options);
}

/// Of the scene as it is edited now; later edits change nothing of it.
std::unique_ptr<Batch> make_batch_of(OpenedStage& stage, const BatchOptions& options) {
  OpenOptions open;
  {
    const auto access = stage.access();
    open = or_raise(unlocked([&] { return stage.options_as_edited(); }));
  }
  return made_batch(stage.path(), open, stage.readings(), options);
}

void bind_facts(nb::class_<Batch>& batch) {
  batch.def_prop_ro("size", &Batch::size);
  batch.def_prop_ro("engine", [](const Batch& self) { return self.engine; });
  batch.def_prop_ro("engine_version", [](const Batch& self) { return self.engine_version; });
  batch.def_prop_ro("time_step", [](Batch& self) { return self.world(0).time_step(); });
  batch.def_prop_ro("dof_count", [](Batch& self) { return self.world(0).dof_count(); });
  batch.def("coordinate_names", &coordinate_names,
            nb::sig("def coordinate_names(self) -> list[str]"));
  batch.def(
      "drive_names", [](const Batch& self) { return names_of(self, self.drives, true); },
      nb::sig("def drive_names(self) -> list[str]"));
  batch.def(
      "body_names", [](const Batch& self) { return paths_of(self.scene->bodies); },
      nb::sig("def body_names(self) -> list[str]"));
  batch.def(
      "joint_paths", [](const Batch& self) { return paths_of(self.scene->joints); },
      nb::sig("def joint_paths(self) -> list[str]"));
  batch.def(
      "collider_names", [](const Batch& self) { return paths_of(self.scene->colliders); },
      nb::sig("def collider_names(self) -> list[str]"));
  batch.def(
      "diagnostics", [](const Batch& self) { return to_list(self.diagnostics); },
      nb::sig("def diagnostics(self) -> list[Diagnostic]"));
  batch.def("not_mapped", &not_mapped, nb::sig("def not_mapped(self) -> list[dict[str, Any]]"));
  batch.def("scene", &scene_of);
  batch.def(
      "drawn", [](const Batch& self) { return self.drawn; },
      "What each environment drew for each variation.");
  batch.def(
      "set_drawn",
      [](Batch& self, std::size_t i, const std::vector<std::vector<double>>& numbers) {
        check_environment(self, i);
        or_raise(with(self, [&] { return self.set_drawn(i, numbers); }));
      },
      "environment"_a, "numbers"_a);
  batch.def(
      "variations",
      [](const Batch& self) {
        nb::list names;
        for (const Variation& variation : self.variations) {
          names.append(text(variation.text));
        }
        return names;
      },
      nb::sig("def variations(self) -> list[str]"), "What is varied, without its range.");
}

}  // namespace

void bind_batch(nb::module_& module) {
  nb::class_<Batch> batch(module, "Batch", "What World stands on.");
  nb::class_<dynamics::Masks>(module, "Masks", "Links and joints that a world skips or holds.")
      .def(nb::new_([](std::vector<std::string> deactivate, std::vector<std::string> bypass,
                       std::vector<std::string> anchor) {
             return dynamics::Masks{std::move(deactivate), std::move(bypass), std::move(anchor)};
           }),
           "deactivate"_a, "bypass"_a, "anchor"_a);
  nb::class_<BatchOptions>(module, "BatchOptions", "How many environments are made, and of what.")
      .def(nb::new_(&batch_options), "engine"_a, "count"_a, "threads"_a, "seed"_a, "time_step"_a,
           "outputs"_a, "variations"_a, "integrator"_a, "masks"_a);
  module.def("make_batch", &make_batch, "path"_a, "arguments"_a, "options"_a,
             nb::sig("def make_batch(path: str | os.PathLike[str], arguments: OpenArguments, "
                     "options: BatchOptions) -> Batch"));
  module.def("make_batch_of", &make_batch_of, "stage"_a, "options"_a);
  bind_facts(batch);
  batch.def("step", &step, "count"_a);
  batch.def("reset", &reset, "which"_a);
  batch.def("failures", &failures, nb::sig("def failures(self) -> list[Diagnostic | None]"));
  batch.def("times", &times, nb::sig("def times(self) -> NDArray[Any]"));
  batch.def("joints", &joints, nb::sig("def joints(self) -> tuple[NDArray[Any], NDArray[Any]]"));
  batch.def("set_joints", &set_joints, "positions"_a, "velocities"_a);
  batch.def("set_targets", &set_targets, "positions"_a, "velocities"_a);
  batch.def("set_efforts", &set_efforts, "efforts"_a);
  batch.def("drive_efforts", &drive_efforts, nb::sig("def drive_efforts(self) -> NDArray[Any]"));
  batch.def("body_states", &body_states,
            nb::sig("def body_states(self) -> tuple[NDArray[Any], NDArray[Any]]"));
  batch.def("body_poses", &body_poses, nb::sig("def body_poses(self) -> NDArray[Any]"));
  batch.def("set_body", &set_body, "body"_a, "poses"_a, "velocities"_a);
  batch.def("move_kinematic", &move_kinematic, "body"_a, "poses"_a);
  batch.def("set_wrench", &set_wrench, "body"_a, "wrenches"_a);
  batch.def("set_parameter", &set_parameter, "name"_a, "object"_a, "part"_a, "values"_a);
  batch.def("gravity", &gravity, nb::sig("def gravity(self) -> NDArray[Any]"));
  batch.def("set_gravity", &set_gravity, "values"_a);
  batch.def("energies", &energies, nb::sig("def energies(self) -> NDArray[Any]"));
  bind_outputs(batch);
  bind_record(batch);
}

}  // namespace tenon::python
