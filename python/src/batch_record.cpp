// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Single numbers of environments, chosen by the caller and read between steps without the
// interpreter: the measurements of a sweep (tenon_usd/sweep/signals.py).
#include "batch_record.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "batch_calls.h"
#include "failure.h"
#include "numbers.h"
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

namespace tenon::python {
namespace {

using namespace nb::literals;

/// Requested readings, as in Python: a signal, the number of its object, an axis from 0.
using Readings = std::vector<std::tuple<std::string, std::size_t, std::size_t>>;

/// One environment at one time.
struct Moment {
  const Batch& batch;
  const engines::World& world;
  const std::vector<engines::Contact>& contacts;  ///< where a signal needs them

  engines::BodyState body(std::size_t i) const {
    return world.body_state(static_cast<scene::Index>(i));
  }
  engines::JointState joint(std::size_t coordinate) const {
    return world.joint_state(batch.coordinates[coordinate].joint);
  }
};

/// What a signal is told about: how many there are of it.
enum class Of : std::uint8_t { All, Body, Coordinate, Drive };

struct Signal {
  std::string_view name;
  Of of;
  std::size_t axes;  ///< 1: it has none
  bool needs_contacts;
  Result<double> (*read)(const Moment&, std::size_t object, std::size_t axis);
};

Result<double> force_on(const Moment& at, std::size_t body, std::size_t /*axis*/) {
  double sum = 0;
  for (const engines::Contact& contact : at.contacts) {
    sum += contact.body0 == body || contact.body1 == body ? contact.normal_force : 0;
  }
  return sum;
}

Result<double> force_on_all(const Moment& at, std::size_t /*object*/, std::size_t /*axis*/) {
  double sum = 0;
  for (const engines::Contact& contact : at.contacts) {
    sum += contact.normal_force;
  }
  return sum;
}

Result<double> drive_effort(const Moment& at, std::size_t drive, std::size_t /*axis*/) {
  const Coordinate& place = at.batch.drives[drive];
  TENON_TRY(const std::vector<double> efforts, at.world.drive_efforts(place.joint));
  return place.part < efforts.size() ? efforts[place.part] : 0;
}

using R = Result<double>;
constexpr std::array kSignals{
    Signal{"position", Of::Body, 3, false,
           [](const Moment& at, std::size_t body, std::size_t axis) -> R {
             return at.body(body).pose.position[axis];
           }},
    Signal{"velocity", Of::Body, 3, false,
           [](const Moment& at, std::size_t body, std::size_t axis) -> R {
             return at.body(body).linear_velocity[axis];
           }},
    Signal{"angularVelocity", Of::Body, 3, false,
           [](const Moment& at, std::size_t body, std::size_t axis) -> R {
             return at.body(body).angular_velocity[axis];
           }},
    Signal{"speed", Of::Body, 1, false,
           [](const Moment& at, std::size_t body, std::size_t) -> R {
             return length(at.body(body).linear_velocity);
           }},
    Signal{"angularSpeed", Of::Body, 1, false,
           [](const Moment& at, std::size_t body, std::size_t) -> R {
             return length(at.body(body).angular_velocity);
           }},
    Signal{"contactForce", Of::Body, 1, true, &force_on},
    Signal{"contactForceOfAll", Of::All, 1, true, &force_on_all},
    Signal{"jointPosition", Of::Coordinate, 1, false,
           [](const Moment& at, std::size_t i, std::size_t) -> R {
             return at.joint(i).position[at.batch.coordinates[i].part];
           }},
    Signal{"jointVelocity", Of::Coordinate, 1, false,
           [](const Moment& at, std::size_t i, std::size_t) -> R {
             return at.joint(i).velocity[at.batch.coordinates[i].part];
           }},
    Signal{"driveEffort", Of::Drive, 1, false, &drive_effort},
    Signal{
        "energy", Of::All, 1, false,
        [](const Moment& at, std::size_t, std::size_t) -> R { return at.world.energy().total(); }},
    Signal{
        "kineticEnergy", Of::All, 1, false,
        [](const Moment& at, std::size_t, std::size_t) -> R { return at.world.energy().kinetic; }},
    Signal{"potentialEnergy", Of::All, 1, false,
           [](const Moment& at, std::size_t, std::size_t) -> R {
             return at.world.energy().potential;
           }},
    Signal{"contactCount", Of::All, 1, false,
           [](const Moment& at, std::size_t, std::size_t) -> R {
             return static_cast<double>(at.world.contact_count());
           }},
};

/// A column of the readings.
struct Column {
  const Signal* signal;
  std::size_t object;
  std::size_t axis;
};

std::size_t count_of(const Batch& batch, Of of) {
  switch (of) {
    case Of::Body:
      return batch.scene->bodies.size();
    case Of::Coordinate:
      return batch.coordinates.size();
    case Of::Drive:
      return batch.drives.size();
    case Of::All:
      break;
  }
  return 1;
}

std::vector<Column> columns_of(const Batch& batch, const Readings& readings) {
  std::vector<Column> columns;
  for (const auto& [name, object, axis] : readings) {
    const auto* const found =
        std::find_if(kSignals.begin(), kSignals.end(),
                     [&name = name](const Signal& signal) { return signal.name == name; });
    if (found == kSignals.end()) {
      throw nb::value_error(("there is no signal \"" + name + "\"").c_str());
    }
    if (object >= count_of(batch, found->of) || axis >= found->axes) {
      throw nb::index_error(("there is no such object or axis of " + name).c_str());
    }
    columns.push_back({found, object, axis});
  }
  return columns;
}

/// The columns of each environment, one environment after the other; `to` is behind them then.
Result<void> read_row(Batch& batch, const std::vector<Column>& columns, double*& to) {
  const bool needs_contacts = std::any_of(columns.begin(), columns.end(), [](const Column& column) {
    return column.signal->needs_contacts;
  });
  std::vector<engines::Contact> contacts;
  for (std::size_t i = 0; i < batch.size(); ++i) {
    if (needs_contacts) {
      TENON_TRY(contacts, batch.world(i).contacts());
    }
    const Moment now{batch, batch.world(i), contacts};
    for (const Column& column : columns) {
      TENON_TRY(*to, column.signal->read(now, column.object, column.axis));
      ++to;
    }
  }
  return {};
}

nb::object read(Batch& batch, const Readings& readings) {
  const std::vector<Column> columns = columns_of(batch, readings);
  NewArray<> made({batch.size(), columns.size()});
  or_raise(with(batch, [&] {
    double* to = made.numbers.data();
    return read_row(batch, columns, to);
  }));
  return made.take();
}

/// (samples, size, columns), and how many environments stand still. When all of them do, nothing
/// more is read: NaN.
nb::tuple record(Batch& batch, const Readings& readings, std::size_t steps, std::size_t every) {
  if (every == 0) {
    throw nb::value_error("there are no steps between two readings");
  }
  const std::vector<Column> columns = columns_of(batch, readings);
  const std::size_t samples = steps / every + (steps % every == 0 ? 0 : 1);
  NewArray<> made({samples, batch.size(), columns.size()});
  std::fill(made.numbers.begin(), made.numbers.end(), std::numeric_limits<double>::quiet_NaN());
  std::size_t failed = 0;
  or_raise(with(batch, [&]() -> Result<void> {
    double* to = made.numbers.data();
    for (std::size_t sample = 0; sample < samples && failed < batch.size(); ++sample) {
      failed = batch.stepper.step(*batch.environments, std::min(every, steps - sample * every));
      batch.stepper.look();
      if (failed < batch.size()) {
        TENON_CHECK(read_row(batch, columns, to));
      }
    }
    return {};
  }));
  return nb::make_tuple(made.take(), failed);
}

}  // namespace

void bind_record(nb::class_<Batch>& batch) {
  batch.def("read", &read, "readings"_a,
            nb::sig("def read(self, readings: Sequence[tuple[str, int, int]]) -> NDArray[Any]"));
  batch.def("record", &record, "readings"_a, "steps"_a, "every"_a,
            nb::sig("def record(self, readings: Sequence[tuple[str, int, int]], steps: int, "
                    "every: int) -> tuple[NDArray[Any], int]"));
}

}  // namespace tenon::python
