// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What tenon_usd/dynamics.py stands on: a scene at one posture, and its numbers as arrays of
// doubles. Nothing of Python changes a scene, so that calls need no lock, and each lets other
// threads of Python run. Dynamics keeps what it finds and so belongs to one thread: what asks it
// for effective inertias makes one of its own.
#include "scene_dynamics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "failure.h"
#include "named_coordinates.h"
#include "numbers.h"
#include "physics.h"
#include <nanobind/ndarray.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/unique_ptr.h>
#include <nanobind/stl/vector.h>

#include "tenon/dynamics/dynamics.h"
#include "tenon/dynamics/posture_text.h"

namespace tenon::python {
namespace {

using namespace nb::literals;
using dynamics::Coordinate;
using dynamics::Dynamics;
using dynamics::Multibody;
using dynamics::Posture;
using scene::Index;

using Numbers = nb::ndarray<const double, nb::c_contig, nb::device::cpu>;
using Texts = std::vector<std::string>;
using Values = std::vector<std::pair<std::string, double>>;

/// The trees of a scene, which they keep.
struct SceneTrees {
  explicit SceneTrees(std::shared_ptr<ReadScene> of)
      : read(std::move(of)), multibody(read->scene) {}

  std::shared_ptr<ReadScene> read;
  Multibody multibody;
};

/// A scene at one posture.
struct PosedScene {
  PosedScene(std::shared_ptr<const SceneTrees> of, Posture posture)
      : trees(std::move(of)), dynamics(trees->multibody, std::move(posture)) {}

  const Multibody& multibody() const { return trees->multibody; }
  const scene::PhysicsScene& scene() const { return trees->read->scene; }
  const Posture& posture() const { return dynamics.posture(); }
  std::size_t count() const { return multibody().coordinates().size(); }

  std::shared_ptr<const SceneTrees> trees;
  Dynamics dynamics;
};

// ---- a scene and a pose

Result<std::unique_ptr<PosedScene>> posed(std::shared_ptr<const SceneTrees> trees,
                                          const Texts& texts, const Values& values) {
  TENON_TRY(Posture posture, values.empty() ? posture_from_texts(trees->multibody, texts)
                                            : posture_from_values(trees->multibody, values));
  for (Index b = 0; b < posture.bodies.size(); ++b) {
    if (!is_finite(posture.bodies[b])) {
      const std::string path = trees->read->scene.bodies[b].path.str();
      return Error(ErrorCode::Invalid, path + " has no finite place at this pose")
          .with_prim(path)
          .with_rule("pose.bad-value")
          .with_fix("give smaller numbers");
    }
  }
  return std::make_unique<PosedScene>(std::move(trees), std::move(posture));
}

std::unique_ptr<PosedScene> make_posed_scene(std::shared_ptr<ReadScene> scene, const Texts& texts,
                                             const Values& values) {
  return or_raise(unlocked(
      [&] { return posed(std::make_shared<const SceneTrees>(std::move(scene)), texts, values); }));
}

std::unique_ptr<PosedScene> moved(const PosedScene& self, const Texts& texts,
                                  const Values& values) {
  return or_raise(unlocked([&] { return posed(self.trees, texts, values); }));
}

// ---- numbers in and out

/// One for each coordinate, all finite.
std::vector<double> along_coordinates(const PosedScene& self, const Numbers& numbers,
                                      const char* what) {
  if (numbers.size() != self.count()) {
    throw nb::value_error("the array has another number of values");
  }
  std::vector<double> values(numbers.data(), numbers.data() + numbers.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i])) {
      raise(Error(ErrorCode::Invalid, std::string(what) + " must be finite numbers; number " +
                                          std::to_string(i) + " is not")
                .with_rule("dynamics.not-finite"));
    }
  }
  return values;
}

nb::object vector_of(std::vector<double> values) {
  NewArray<> made({values.size()});
  made.numbers = std::move(values);
  return made.take();
}

nb::object matrix_of(dynamics::DenseMatrix matrix) {
  NewArray<> made({0});
  made.shape = {matrix.rows, matrix.columns};
  made.numbers = std::move(matrix.values);
  return made.take();
}

nb::object numbers_of(const Vec3d& v) { return vector_of({v[0], v[1], v[2]}); }

// ---- what there is

nb::list coordinates(const PosedScene& self) {
  nb::list rows;
  for (const Coordinate& coordinate : self.multibody().coordinates()) {
    const nb::object joint = coordinate.joint
                                 ? text(self.scene().joints[*coordinate.joint].path.str())
                                 : nb::object(nb::none());
    rows.append(nb::make_tuple(joint, text(self.scene().bodies[coordinate.body].path.str()),
                               text(scene::dof_name(coordinate.dof)), coordinate.part));
  }
  return rows;
}

std::size_t coordinate(const PosedScene& self, const std::string& joint,
                       const std::optional<std::string>& dof) {
  if (dof && dof->empty()) {
    throw nb::value_error("dof is empty");
  }
  return or_raise(coordinate_named(self.multibody(), joint, dof.value_or("")));
}

std::size_t body(const PosedScene& self, const std::string& name) {
  return or_raise(body_named(self.scene(), name));
}

nb::object positions(const PosedScene& self) {
  std::vector<double> values;
  for (const Coordinate& coordinate : self.multibody().coordinates()) {
    values.push_back(coordinate.joint ? self.posture().joints[*coordinate.joint][coordinate.part]
                                      : std::numeric_limits<double>::quiet_NaN());
  }
  return vector_of(std::move(values));
}

nb::object body_positions(const PosedScene& self) {
  NewArray<> made({self.posture().bodies.size(), 3});
  auto to = made.numbers.begin();
  for (const Pose& pose : self.posture().bodies) {
    to = std::copy(pose.position.v.begin(), pose.position.v.end(), to);
  }
  return made.take();
}

nb::object body_orientations(const PosedScene& self) {
  NewArray<> made({self.posture().bodies.size(), 4});
  auto to = made.numbers.begin();
  for (const Pose& pose : self.posture().bodies) {
    const Quatd& q = pose.orientation;
    for (const double part : {q.w, q.x, q.y, q.z}) {
      *to++ = part;
    }
  }
  return made.take();
}

// ---- algebra

nb::object mass_matrix(const PosedScene& self) {
  return matrix_of(or_raise(unlocked([&] { return self.dynamics.mass_matrix(); })));
}

nb::object gravity_forces(const PosedScene& self) {
  return vector_of(unlocked([&] { return self.dynamics.gravity_forces(); }));
}

nb::object bias_forces(const PosedScene& self, const Numbers& velocities) {
  const std::vector<double> given = along_coordinates(self, velocities, "velocities");
  return vector_of(unlocked([&] { return self.dynamics.bias_forces(given); }));
}

nb::object jacobian(const PosedScene& self, std::size_t body, const std::optional<Numbers>& point) {
  if (body >= self.scene().bodies.size()) {
    throw nb::index_error("there is no such body");
  }
  Vec3d place =
      transform_point(self.posture().bodies[body], self.scene().bodies[body].center_of_mass);
  if (point) {
    if (point->size() != 3) {
      throw nb::value_error("the array has another number of values");
    }
    place = {{point->data()[0], point->data()[1], point->data()[2]}};
    if (!is_finite(place)) {
      raise(Error(ErrorCode::Invalid, "a point must be finite numbers")
                .with_rule("dynamics.not-finite"));
    }
  }
  return matrix_of(
      unlocked([&] { return self.dynamics.jacobian(static_cast<Index>(body), place); }));
}

/// Calls with all coordinates, those of one group of bodies after the other: what Dynamics prepares
/// for a group serves until the next one.
template <class Call>
void each_by_group(const Multibody& multibody, const Call& call) {
  std::vector<std::size_t> order(multibody.coordinates().size());
  std::iota(order.begin(), order.end(), 0);
  const auto group = [&](std::size_t i) {
    return multibody.group_of()[multibody.coordinates()[i].body];
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return group(a) < group(b); });
  for (const std::size_t i : order) {
    call(i);
  }
}

nb::object effective_inertia(const PosedScene& self) {
  std::vector<double> held(self.count());
  std::vector<double> free(self.count());
  unlocked([&] {
    const Dynamics own(self.multibody(), self.posture());
    each_by_group(self.multibody(), [&](std::size_t i) {
      const dynamics::EffectiveInertia inertia = own.effective_inertia(i);
      held[i] = inertia.held;
      free[i] = inertia.free;
    });
    return true;
  });
  return nb::make_tuple(vector_of(std::move(held)), vector_of(std::move(free)));
}

nb::object along_held(const PosedScene& self, const Numbers& forces) {
  const std::vector<double> given = along_coordinates(self, forces, "forces");
  return vector_of(unlocked([&] {
    std::vector<double> along(self.count());
    const Dynamics own(self.multibody(), self.posture());
    each_by_group(self.multibody(), [&](std::size_t i) { along[i] = own.along_held(i, given); });
    return along;
  }));
}

void bind_facts(nb::class_<PosedScene>& bound) {
  bound.def_prop_ro("scene", [](const PosedScene& self) { return self.trees->read; });
  bound.def_prop_ro("count", &PosedScene::count);
  bound.def_prop_ro("body_count",
                    [](const PosedScene& self) { return self.scene().bodies.size(); });
  bound.def("coordinates", &coordinates,
            nb::sig("def coordinates(self) -> list[tuple[str | None, str, str, int]]"));
  bound.def("coordinate", &coordinate, "joint"_a, "dof"_a.none());
  bound.def("body", &body, "name"_a);
  bound.def("positions", &positions, nb::sig("def positions(self) -> NDArray[Any]"));
  bound.def("body_positions", &body_positions, nb::sig("def body_positions(self) -> NDArray[Any]"));
  bound.def("body_orientations", &body_orientations,
            nb::sig("def body_orientations(self) -> NDArray[Any]"));
  bound.def("mass", [](const PosedScene& self) { return self.dynamics.mass(); });
  bound.def(
      "center_of_mass",
      [](const PosedScene& self) { return numbers_of(self.dynamics.center_of_mass()); },
      nb::sig("def center_of_mass(self) -> NDArray[Any]"));
  bound.def("loop_gap", [](const PosedScene& self) {
    return unlocked([&] { return self.multibody().loop_gap(self.posture()); });
  });
}

}  // namespace

void bind_dynamics(nb::module_& module) {
  nb::class_<PosedScene> bound(module, "PosedScene", "What Dynamics stands on.");
  module.def("make_posed_scene", &make_posed_scene, "scene"_a, "texts"_a, "values"_a);
  bind_facts(bound);
  bound.def("moved", &moved, "texts"_a, "values"_a);
  bound.def("mass_matrix", &mass_matrix, nb::sig("def mass_matrix(self) -> NDArray[Any]"));
  bound.def("gravity_forces", &gravity_forces, nb::sig("def gravity_forces(self) -> NDArray[Any]"));
  bound.def("bias_forces", &bias_forces, "velocities"_a,
            nb::sig("def bias_forces(self, velocities: NDArray[Any]) -> NDArray[Any]"));
  bound.def("jacobian", &jacobian, "body"_a, "point"_a.none(),
            nb::sig("def jacobian(self, body: int, point: NDArray[Any] | None) -> NDArray[Any]"));
  bound.def("effective_inertia", &effective_inertia,
            nb::sig("def effective_inertia(self) -> tuple[NDArray[Any], NDArray[Any]]"));
  bound.def("along_held", &along_held, "forces"_a,
            nb::sig("def along_held(self, forces: NDArray[Any]) -> NDArray[Any]"));
}

}  // namespace tenon::python
