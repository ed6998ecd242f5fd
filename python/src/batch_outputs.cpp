// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What single environments give: each is copied out of the library while nobody steps, then made
// into arrays and dictionaries with the interpreter at hand.
#include "batch_outputs.h"

#include <algorithm>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "batch_calls.h"
#include "failure.h"
#include "numbers.h"
#include <nanobind/ndarray.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include "tenon/asset/export_mjcf.h"
#include "tenon/asset_policy.h"

namespace tenon::python {
namespace {

using namespace nb::literals;

nb::bytes save_state(Batch& batch, std::size_t i) {
  check_environment(batch, i);
  const std::string state = or_raise(with(batch, [&] { return batch.world(i).save_state(); }));
  return nb::bytes(state.data(), state.size());
}

void restore_state(Batch& batch, std::size_t i, const nb::bytes& state) {
  check_environment(batch, i);
  const std::string_view bytes(state.c_str(), state.size());
  or_raise(with(batch, [&] { return batch.world(i).restore_state(bytes); }));
}

template <class Get>
nb::object contact_vectors(const std::vector<engines::Contact>& contacts, const Get& get) {
  NewArray<> made({contacts.size(), 3});
  double* to = made.numbers.data();
  for (const engines::Contact& contact : contacts) {
    put(get(contact), to);
  }
  return made.take();
}

template <class Number, class Get>
nb::object contact_numbers(const std::vector<engines::Contact>& contacts, const Get& get) {
  NewArray<Number> made({contacts.size()});
  std::transform(contacts.begin(), contacts.end(), made.numbers.begin(), get);
  return made.take();
}

nb::dict contacts(Batch& batch, std::size_t i) {
  using engines::Contact;
  check_environment(batch, i);
  const auto found = or_raise(with(batch, [&] { return batch.world(i).contacts(); }));
  const auto index = [](const std::optional<scene::Index>& body) {
    return body ? static_cast<std::int64_t>(*body) : -1;
  };
  nb::dict arrays;
  arrays["collider0"] = contact_numbers<std::int64_t>(
      found, [](const Contact& c) { return static_cast<std::int64_t>(c.collider0); });
  arrays["collider1"] = contact_numbers<std::int64_t>(
      found, [](const Contact& c) { return static_cast<std::int64_t>(c.collider1); });
  arrays["body0"] =
      contact_numbers<std::int64_t>(found, [&](const Contact& c) { return index(c.body0); });
  arrays["body1"] =
      contact_numbers<std::int64_t>(found, [&](const Contact& c) { return index(c.body1); });
  arrays["depth"] = contact_numbers<double>(found, [](const Contact& c) { return c.depth; });
  arrays["normal_force"] =
      contact_numbers<double>(found, [](const Contact& c) { return c.normal_force; });
  arrays["point"] = contact_vectors(found, [](const Contact& c) { return c.point; });
  arrays["normal"] = contact_vectors(found, [](const Contact& c) { return c.normal; });
  arrays["force"] = contact_vectors(found, [](const Contact& c) { return c.force(); });
  arrays["friction_torque"] =
      contact_vectors(found, [](const Contact& c) { return c.friction_torque; });
  return arrays;
}

nb::object contact_counts(Batch& batch) {
  NewArray<std::int64_t> made({batch.size()});
  with(batch, [&] {
    for (std::size_t i = 0; i < batch.size(); ++i) {
      made.numbers[i] = static_cast<std::int64_t>(batch.world(i).contact_count());
    }
    return true;
  });
  return made.take();
}

nb::object vector_of(const Vec3d& vector) {
  NewArray<> made({3});
  std::copy(vector.v.begin(), vector.v.end(), made.numbers.begin());
  return made.take();
}

nb::object rotation_of(const Quatd& rotation) {
  NewArray<> made({4});
  double* to = made.numbers.data();
  put(rotation, to);
  return made.take();
}

nb::object numbers_of(const std::vector<double>& values) {
  NewArray<> made({values.size()});
  made.numbers = values;
  return made.take();
}

nb::dict reading_of(const scene::Sensor& sensor, const engines::SensorReading& reading) {
  nb::dict row;
  row["path"] = text(sensor.path.str());
  row["kind"] = std::string(scene::sensor_kind_name(sensor.kind)).c_str();
  row["time"] = reading.time;
  switch (sensor.kind) {
    case scene::SensorKind::Contact:
      row["in_contact"] = reading.in_contact;
      row["normal_force"] = reading.normal_force;
      break;
    case scene::SensorKind::Imu:
      row["linear_acceleration"] = vector_of(reading.linear_acceleration);
      row["angular_velocity"] = vector_of(reading.angular_velocity);
      row["orientation"] = rotation_of(reading.orientation);
      break;
    case scene::SensorKind::Frame:
      row["position"] = vector_of(reading.position);
      row["linear_velocity"] = vector_of(reading.linear_velocity);
      row["angular_velocity"] = vector_of(reading.angular_velocity);
      row["orientation"] = rotation_of(reading.orientation);
      break;
    case scene::SensorKind::Rays:
      row["distances"] = numbers_of(reading.distances);
      break;
    case scene::SensorKind::ForceTorque:
      row["force"] = vector_of(reading.wrench.force);
      row["torque"] = vector_of(reading.wrench.torque);
      break;
    case scene::SensorKind::Joint:
      row["position"] = numbers_of(reading.joint.position);
      row["velocity"] = numbers_of(reading.joint.velocity);
      row["effort"] = numbers_of(reading.efforts);
      break;
  }
  return row;
}

nb::list sensors(Batch& batch, std::size_t i) {
  check_environment(batch, i);
  const auto readings = or_raise(with(batch, [&] { return batch.world(i).sensors(); }));
  nb::list rows;
  for (std::size_t s = 0; s < readings.size() && s < batch.scene->sensors.size(); ++s) {
    rows.append(reading_of(batch.scene->sensors[s], readings[s]));
  }
  return rows;
}

// ---- outputs of all environments

/// Fills a new array with what `read(world, to)` puts there for one environment after the other.
template <class Read>
nb::object of_each(Batch& batch, NewArray<> made, const Read& read) {
  or_raise(with(batch, [&]() -> Result<void> {
    double* to = made.numbers.data();
    for (std::size_t i = 0; i < batch.size(); ++i) {
      TENON_CHECK(read(batch.world(i), to));
    }
    return {};
  }));
  return made.take();
}

nb::object joint_reactions(Batch& batch) {
  const std::size_t joints = batch.scene->joints.size();
  return of_each(batch, NewArray<>({batch.size(), joints, 6}),
                 [&](const engines::World& world, double*& to) -> Result<void> {
                   for (scene::Index j = 0; j < joints; ++j) {
                     TENON_TRY(const engines::Wrench wrench, world.joint_reaction(j));
                     put(wrench.force, to);
                     put(wrench.torque, to);
                   }
                   return {};
                 });
}

nb::object body_accelerations(Batch& batch) {
  const std::size_t bodies = batch.scene->bodies.size();
  return of_each(batch, NewArray<>({batch.size(), bodies, 6}),
                 [&](const engines::World& world, double*& to) -> Result<void> {
                   for (scene::Index b = 0; b < bodies; ++b) {
                     TENON_TRY(const engines::BodyAcceleration found, world.body_acceleration(b));
                     put(found.linear, to);
                     put(found.angular, to);
                   }
                   return {};
                 });
}

nb::object joint_accelerations(Batch& batch) {
  return of_each(batch, NewArray<>({batch.size(), batch.coordinates.size()}),
                 [&](const engines::World& world, double*& to) -> Result<void> {
                   for (scene::Index j = 0; j < batch.scene->joints.size(); ++j) {
                     TENON_TRY(const std::vector<double> found, world.joint_acceleration(j));
                     to = std::copy(found.begin(), found.end(), to);
                   }
                   return {};
                 });
}

/// The parts of Work in the order of WORK of tenon_usd/world.py.
nb::object work(Batch& batch) {
  return of_each(
      batch, NewArray<>({batch.size(), 7}),
      [](const engines::World& world, double*& to) -> Result<void> {
        TENON_TRY(const engines::Work work, world.work());
        for (const double part : {work.drives, work.applied, work.contacts, work.constraints,
                                  work.damping, work.springs, work.changes}) {
          *to++ = part;
        }
        return {};
      });
}

nb::list events(Batch& batch, std::size_t i) {
  check_environment(batch, i);
  const auto found = with(batch, [&] { return batch.world(i).events(); });
  nb::list rows;
  for (const engines::Event& event : found) {
    nb::dict row;
    row["time"] = event.time;
    row["prim"] = text(event.prim.str());
    row["what"] = message(event.what);
    rows.append(row);
  }
  return rows;
}

/// The model's text, the images that it names, and what MJCF does not support.
nb::tuple to_mjcf(Batch& batch, std::size_t i, const std::string& folder) {
  check_environment(batch, i);
  Diagnostics found;
  const ExportedMjcf exported =
      or_raise(with(batch,
                    [&] {
                      const scene::PhysicsScene& scene =
                          batch.own_scenes.empty() ? *batch.scene : *batch.own_scenes[i];
                      return export_mjcf(*batch.stage, scene, folder,
                                         policy_for(batch.path, batch.open), found);
                    }),
               found);
  nb::dict images;
  for (const auto& [name, bytes] : exported.images) {
    images[text(name)] = nb::bytes(bytes.data(), bytes.size());
  }
  return nb::make_tuple(text(exported.text), images, to_list(found));
}

/// (list, object, field, how many numbers) each.
void set_fields(
    Batch& batch,
    const std::vector<std::tuple<std::string, std::string, std::string, std::size_t>>& keys,
    const nb::ndarray<const double, nb::c_contig, nb::device::cpu>& values) {
  std::vector<FieldKey> fields;
  std::size_t wide = 0;
  for (const auto& [list, object, field, count] : keys) {
    fields.push_back({list, object, field, count});
    wide += count;
  }
  if (values.size() != batch.size() * wide) {
    throw nb::value_error("the array has another number of values");
  }
  or_raise(with(batch, [&] { return batch.set_fields(fields, {values.data(), values.size()}); }));
}

}  // namespace

void bind_outputs(nb::class_<Batch>& batch) {
  batch.def("save_state", &save_state, "environment"_a);
  batch.def("restore_state", &restore_state, "environment"_a, "state"_a);
  batch.def("contacts", &contacts, "environment"_a,
            nb::sig("def contacts(self, environment: int) -> dict[str, NDArray[Any]]"));
  batch.def("contact_counts", &contact_counts, nb::sig("def contact_counts(self) -> NDArray[Any]"));
  batch.def("sensors", &sensors, "environment"_a,
            nb::sig("def sensors(self, environment: int) -> list[dict[str, Any]]"));
  batch.def("joint_reactions", &joint_reactions,
            nb::sig("def joint_reactions(self) -> NDArray[Any]"));
  batch.def("body_accelerations", &body_accelerations,
            nb::sig("def body_accelerations(self) -> NDArray[Any]"));
  batch.def("joint_accelerations", &joint_accelerations,
            nb::sig("def joint_accelerations(self) -> NDArray[Any]"));
  batch.def("work", &work, nb::sig("def work(self) -> NDArray[Any]"));
  batch.def("events", &events, "environment"_a,
            nb::sig("def events(self, environment: int) -> list[dict[str, Any]]"));
  batch.def("to_mjcf", &to_mjcf, "environment"_a, "folder"_a,
            nb::sig("def to_mjcf(self, environment: int, folder: str) -> tuple[str, "
                    "dict[str, bytes], list[Diagnostic]]"));
  batch.def("set_fields", &set_fields, "fields"_a, "values"_a);
}

}  // namespace tenon::python
