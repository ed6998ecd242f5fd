// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// MuJoCo's contacts are spring-dampers in acceleration: while touching,
//   a = (1 - d) a_free - d (b v + d k r),   d = 0.9..0.95 with depth r,
// and they only push. In direct form solref = {-k dmax^2, -b dmax}. A rebound needs k and b such
// that the ratio of the speeds after and before is e. The continuous ratio is known (Hunt and
// Crossley 1975; Nagurka and Huang 2004), but a contact lasts few time steps, so b is found on the
// discrete motion itself, by bisection, averaged over where in the step the impact falls. Where all
// surfaces are of one kind the geoms hold what two of them make of each other. Else the values of
// the pair are written into each contact that is made. So is how firm the friction of a contact is
// that slides (docs/simulation.md, friction of what slides).
#include "tenon/engines/mujoco/build/surfaces.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tenon/math/vector.h"

namespace tenon::engines::mujoco {
namespace {

constexpr double kLowImpedance = 0.9;  // MuJoCo's default solimp
constexpr double kHighImpedance = 0.95;
constexpr double kImpedanceWidth = 0.001;  // [m]
constexpr double kStiffSteps = 0.25;       // natural frequency times time step, elastic contacts
constexpr int kReboundSteps = 13;          // half a period of it: pi / 0.25
constexpr double kSoftSteps = 0.16;        // the same without bounce
constexpr double kMaxDamping = 0.9;        // damping times time step: below 1, or the contact rings
// Friction of what slides is as firm as this much acceleration into the other body, the load that
// the depth shows and that of an impact take, and brakes within 0.1 s.
constexpr double kPressing = 50;      // [m/s^2]
constexpr double kLeastBraking = 10;  // [1/s]
// Each restitution takes a bisection of a millisecond. Where there are very many, further ones are
// rounded by less than the error that the springs have anyway.
constexpr std::size_t kExactRestitutions = 256;
constexpr double kRoundedRestitutions = 256;

double impedance(double depth) {
  const double x = std::min(1.0, depth / kImpedanceWidth);
  const double y = x < 0.5 ? 2 * x * x : 1 - 2 * (1 - x) * (1 - x);  // solimp midpoint 0.5, power 2
  return kLowImpedance + y * (kHighImpedance - kLowImpedance);
}

// Speed after the contact over speed before, for an impact at `speed` with the first touch `phase`
// of a step past the surface.
double rebound(double stiffness, double damping, double time_step, double speed, double phase) {
  double depth = phase * time_step * speed;
  double velocity = speed;  // into the surface
  for (int i = 0; i < 100000 && depth > 0; ++i) {
    const double d = impedance(depth);
    const double push = d * (damping * velocity + d * stiffness * depth);
    velocity -= time_step * std::max(0.0, push);
    depth += time_step * velocity;
  }
  return -velocity / speed;
}

double mean_rebound(double stiffness, double damping, double time_step) {
  constexpr int kPhases = 16;
  double sum = 0;
  for (int i = 0; i < kPhases; ++i) {
    sum += rebound(stiffness, damping, time_step, 2.0, (i + 0.5) / kPhases);
  }
  return sum / kPhases;
}

const scene::Material& material_of(const scene::PhysicsScene& scene,
                                   const std::optional<scene::Index>& index) {
  return index ? scene.materials[*index] : scene.unbound;
}

void set_friction(mjsGeom& geom, const scene::Material& material) {
  geom.friction[0] = material.dynamic_friction;
  geom.friction[1] = material.torsional_friction.value_or(geom.friction[1]);
  geom.friction[2] = material.rolling_friction.value_or(geom.friction[2]);
}

SurfaceKind kind_of(const scene::PhysicsScene& scene, const std::optional<scene::Index>& index,
                    const scene::ColliderSettings& settings) {
  const scene::Material& material = material_of(scene, index);
  const scene::Compliance& soft = material.compliance;
  return {material.dynamic_friction,
          std::clamp(material.restitution, 0.0, 1.0),
          material.friction_combine,
          material.restitution_combine,
          soft.stiffness,
          soft.damping,
          soft.acceleration,
          soft.damping_combine,
          settings.torsional_patch,
          settings.min_torsional_patch};
}

double friction_of(const SurfaceKind& a, const SurfaceKind& b) {
  return scene::combine(a.friction, a.friction_combine, b.friction, b.friction_combine);
}

std::array<double, 2> solref_of(Surfaces& surfaces, const SurfaceKind& a, const SurfaceKind& b) {
  double restitution =
      scene::combine(a.restitution, a.restitution_combine, b.restitution, b.restitution_combine);
  if (surfaces.solref.size() >= kExactRestitutions) {
    restitution = std::round(restitution * kRoundedRestitutions) / kRoundedRestitutions;
  }
  const auto [entry, is_new] = surfaces.solref.try_emplace(restitution);
  if (is_new) {
    entry->second = contact_solref(restitution, surfaces.time_step);
  }
  return entry->second;
}

void report_materials(Build& build) {
  std::vector<char> used(build.scene.materials.size(), 0);
  for (const scene::Collider& collider : build.scene.colliders) {
    if (collider.material.has_value() && collider.enabled) {
      used[*collider.material] = 1;
    }
    for (const scene::FaceMaterial& faces : collider.face_materials) {
      if (faces.material && collider.enabled) {
        used[*faces.material] = 1;
      }
    }
  }
  for (std::size_t i = 0; i < used.size(); ++i) {
    const scene::Material& material = build.scene.materials[i];
    if (used[i] != 0 && material.static_friction != material.dynamic_friction) {
      build.report(material.path, "physics:staticFriction",
                   "MuJoCo has one coefficient per contact; the dynamic one is used");
    }
    if (used[i] != 0 && material.restitution > 0) {
      build.report(material.path, "physics:restitution",
                   "MuJoCo has no restitution: contacts are springs tuned to rebound with the "
                   "restitution of the pair, within a few per cent, over about " +
                       std::to_string(kReboundSteps) +
                       " steps: what follows is late by that, and bodies that slide along each "
                       "other meanwhile part in another direction; below about 0.3 little of the "
                       "rebound is left");
    }
    if (used[i] != 0 && material.restitution > 0 && material.dynamic_friction > 0) {
      build.report(material.path, "physics:dynamicFriction",
                   "a rebound lasts for several steps here, and friction acts all that time: what "
                   "slides or spins when it bounces leaves with another velocity and spin");
    }
  }
}

}  // namespace

std::array<double, 2> contact_solref(double restitution, double time_step) {
  const double elastic = std::clamp(restitution, 0.0, 1.0);
  const double steps = kSoftSteps + (kStiffSteps - kSoftSteps) * std::min(1.0, elastic / 0.3);
  const double stiffness = (steps / time_step) * (steps / time_step);
  double low = 0;
  double high = kMaxDamping / time_step;
  for (int i = 0; i < 50; ++i) {
    const double middle = (low + high) / 2;
    (mean_rebound(stiffness, middle, time_step) > elastic ? low : high) = middle;
  }
  return {-stiffness * kHighImpedance * kHighImpedance, -(low + high) / 2 * kHighImpedance};
}

/// In text of an asset with MuJoCo's schemas, unauthored values are MuJoCo's defaults.
bool keeps_defaults(const Build& build) {
  return build.purpose == Purpose::Text && build.scene.scenes.front().parts.mujoco.has_value();
}

Surfaces add_surfaces(Build& build) {
  Surfaces surfaces;
  surfaces.time_step = build.time_step;
  std::map<SurfaceKind, int> numbers;
  surfaces.of_collider.resize(build.geoms.size());
  for (std::size_t i = 0; i < build.geoms.size(); ++i) {
    for (const std::optional<scene::Index>& material : build.geom_materials[i]) {
      const SurfaceKind kind = kind_of(build.scene, material, build.scene.colliders[i].settings);
      const auto [entry, is_new] = numbers.try_emplace(kind, static_cast<int>(numbers.size()));
      if (is_new) {
        surfaces.kinds.push_back(kind);
      }
      surfaces.of_collider[i].push_back(entry->second);
    }
  }
  for (std::size_t i = 0; i < build.geoms.size(); ++i) {
    const scene::MujocoContact& contact = build.scene.colliders[i].parts.mujoco;
    const bool decides = contact.priority.value_or(0) != 0;
    surfaces.keeps_solref.push_back(contact.solref.empty() ? 0 : 1);
    for (std::size_t g = 0; g < build.geoms[i].size(); ++g) {
      const SurfaceKind& kind =
          surfaces.kinds[static_cast<std::size_t>(surfaces.of_collider[i][g])];
      mjsGeom& geom = *build.geoms[i][g];
      set_friction(geom, material_of(build.scene, build.geom_materials[i][g]));
      if (!decides) {
        geom.friction[0] = friction_of(kind, kind);
      }
      if (kind.restitution > 0 || !keeps_defaults(build)) {
        const std::array<double, 2> solref = solref_of(surfaces, kind, kind);
        std::copy(solref.begin(), solref.end(), geom.solref);
      }
      std::copy(contact.solref.begin(), contact.solref.end(), geom.solref);
      if (decides) {
        surfaces.of_collider[i][g] = -1;  // MuJoCo does not mix where one has priority
      }
    }
  }
  surfaces.by_contact = surfaces.kinds.size() > 1 ||
                        std::any_of(surfaces.kinds.begin(), surfaces.kinds.end(),
                                    [](const SurfaceKind& kind) { return kind.is_special(); });
  report_materials(build);
  return surfaces;
}

namespace {

// A contact that gives way: PhysX takes the one that is soft, of two soft ones both by the mode.
void make_soft(const SurfaceKind& a, const SurfaceKind& b, double time_step, const mjModel& model,
               mjContact& contact) {
  const SurfaceKind& soft = a.stiffness > 0 ? a : b;
  double stiffness = soft.stiffness;
  double damping = soft.damping;
  if (a.stiffness > 0 && b.stiffness > 0) {
    stiffness =
        scene::combine(a.stiffness, a.restitution_combine, b.stiffness, b.restitution_combine);
    damping = scene::combine(a.damping, a.damping_combine, b.damping, b.damping_combine);
  }
  double weight = 1;
  if (!soft.by_mass) {
    weight = model.body_invweight0[std::ptrdiff_t{2} * model.geom_bodyid[contact.geom[0]]] +
             model.body_invweight0[std::ptrdiff_t{2} * model.geom_bodyid[contact.geom[1]]];
  }
  const SpringReference spring = spring_reference(stiffness * weight, damping * weight, time_step);
  contact.solref[0] = -spring.stiffness;
  contact.solref[1] = -spring.damping;
  contact.solimp[0] = spring.impedance;
  contact.solimp[1] = spring.impedance;
  // Friction stays as firm as the time step allows.
  contact.solreffriction[0] = 0;
  contact.solreffriction[1] = -(1 - spring.impedance) / time_step;
}

void resist_turning(const SurfaceKind& a, const SurfaceKind& b, mjContact& contact) {
  const double ball = std::max(a.patch, b.patch);
  const double radius =
      std::max({a.min_patch, b.min_patch, std::sqrt(2 * ball * std::max(0.0, -contact.dist))});
  contact.friction[2] = std::max(contact.friction[0] * radius, mjMINMU);
}

}  // namespace

bool apply_surfaces(Surfaces& surfaces, const mjModel* model, mjData* data) {
  bool changed = false;
  for (int i = 0; i < data->ncon; ++i) {
    mjContact& contact = data->contact[i];
    const int a = surfaces.geom_surface[static_cast<std::size_t>(contact.geom[0])];
    const int b = surfaces.geom_surface[static_cast<std::size_t>(contact.geom[1])];
    if (a < 0 || b < 0 || (a == b && !surfaces.kinds[static_cast<std::size_t>(a)].is_special())) {
      continue;
    }
    const SurfaceKind& kind_a = surfaces.kinds[static_cast<std::size_t>(a)];
    const SurfaceKind& kind_b = surfaces.kinds[static_cast<std::size_t>(b)];
    contact.friction[0] = std::max(friction_of(kind_a, kind_b), mjMINMU);
    contact.friction[1] = contact.friction[0];
    if (surfaces.keeps_solref[static_cast<std::size_t>(contact.geom[0])] == 0 &&
        surfaces.keeps_solref[static_cast<std::size_t>(contact.geom[1])] == 0) {
      const std::array<double, 2> solref = solref_of(surfaces, kind_a, kind_b);
      contact.solref[0] = solref[0];
      contact.solref[1] = solref[1];
      if (kind_a.stiffness > 0 || kind_b.stiffness > 0) {
        make_soft(kind_a, kind_b, surfaces.time_step, *model, contact);
      }
    }
    if (kind_a.patch > 0 || kind_b.patch > 0 || kind_a.min_patch > 0 || kind_b.min_patch > 0) {
      resist_turning(kind_a, kind_b, contact);
    }
    changed = true;
  }
  return changed;
}

namespace {

// Friction of hard contacts whose softness is ours.
bool may_soften(const Surfaces& surfaces, const mjContact& contact) {
  if (contact.dim < 3 || contact.exclude != 0 || contact.solref[1] >= 0 ||
      contact.solreffriction[1] != 0) {
    return false;
  }
  return std::all_of(std::begin(contact.geom), std::end(contact.geom), [&](int geom) {
    return geom >= 0 && surfaces.geom_surface[static_cast<std::size_t>(geom)] >= 0 &&
           surfaces.keeps_solref[static_cast<std::size_t>(geom)] == 0;
  });
}

// Of the point of a geom's body [m/s].
Vec3d velocity_of(const mjModel& model, const mjData& data, int geom, const mjtNum* point) {
  const std::ptrdiff_t body = model.geom_bodyid[geom];
  const mjtNum* const motion = data.cvel + 6 * body;  // about the centre of mass of the tree
  const Vec3d center = read_vector(data.subtree_com + std::ptrdiff_t{3} * model.body_rootid[body]);
  return read_vector(motion + 3) + cross(read_vector(motion), read_vector(point) - center);
}

// How a unit force between the bodies accelerates them against each other at the contact [1/kg]; as
// if they were on no joints.
double mobility(const mjModel& model, const mjData& data, const mjContact& contact,
                const Vec3d& direction) {
  double sum = 0;
  for (const int geom : contact.geom) {
    const std::ptrdiff_t body = model.geom_bodyid[geom];
    if (model.body_weldid[body] == 0 || model.body_mass[body] <= 0) {
      continue;
    }
    sum += 1 / model.body_mass[body];
    const Vec3d arm = read_vector(contact.pos) - read_vector(data.xipos + 3 * body);
    const Vec3d moment = cross(arm, direction);
    const mjtNum* const axes = data.ximat + 9 * body;  // columns
    for (std::ptrdiff_t axis = 0; axis < 3; ++axis) {
      const double part = dot(Vec3d{axes[axis], axes[3 + axis], axes[6 + axis]}, moment);
      sum += part * part / std::max(model.body_inertia[3 * body + axis], mjMINVAL);
    }
  }
  return std::max(sum, mjMINVAL);
}

// What presses on a contact, as an acceleration: what keeps it at its depth, and an impact.
double load_on(const mjContact& contact, const Vec3d& apart) {
  const double depth = std::max(0.0, -contact.dist);
  const double d = impedance(depth);
  const double part = d / kHighImpedance;
  const double closing = -dot(apart, read_vector(contact.frame));
  return -contact.solref[0] * part * part * depth / (1 - d) -
         contact.solref[1] * std::max(0.0, closing);
}

bool soften_friction(const mjModel& model, const mjData& data, const Vec3d& apart, double load,
                     mjContact& contact) {
  const Vec3d normal = read_vector(contact.frame);
  const Vec3d along = apart - normal * dot(apart, normal);
  const double sliding = length(along);
  const double firm = -contact.solref[1] * sliding;
  const double least = contact.friction[0] * (kPressing + load);
  if (std::max(kLeastBraking * sliding, least) >= firm) {
    return false;
  }
  const double turning = mobility(model, data, contact, along * (1 / sliding)) /
                         mobility(model, data, contact, normal);
  const double enough = std::max(kLeastBraking * sliding, least * std::max(1.0, turning));
  if (enough >= firm) {
    return false;
  }
  contact.solreffriction[0] = 0;
  contact.solreffriction[1] = -enough / sliding;
  return true;
}

}  // namespace

bool softens_sliding(const mjModel& model) {
  const bool has_friction =
      std::any_of(model.geom_condim, model.geom_condim + model.ngeom, [](int n) { return n > 1; });
  const bool steps_inside =  // where MuJoCo evaluates a step by itself
      model.opt.integrator == mjINT_RK4 && (model.opt.enableflags & mjENBL_SLEEP) != 0;
  return has_friction && model.opt.cone == mjCONE_ELLIPTIC && !steps_inside;
}

bool soften_sliding(Surfaces& surfaces, const mjModel& model, mjData& data) {
  std::vector<SoftContact>& contacts = surfaces.softened;
  contacts.clear();
  for (int i = 0; i < data.ncon; ++i) {
    if (may_soften(surfaces, data.contact[i])) {
      const int* const geoms = data.contact[i].geom;
      contacts.push_back({i, model.geom_bodyid[geoms[0]], model.geom_bodyid[geoms[1]], {}});
    }
  }
  if (contacts.empty()) {
    return false;
  }
  mj_comVel(&model, &data);  // of the last step are those from before it
  bool changed = false;
  for (std::size_t begin = 0, end = 0; begin < contacts.size(); begin = end) {
    double load = 0;  // a body that slaps down on one side loads the other
    for (; end < contacts.size() && contacts[end].body0 == contacts[begin].body0 &&
           contacts[end].body1 == contacts[begin].body1;
         ++end) {
      const mjContact& contact = data.contact[contacts[end].contact];
      contacts[end].apart = velocity_of(model, data, contact.geom[1], contact.pos) -
                            velocity_of(model, data, contact.geom[0], contact.pos);
      load = std::max(load, load_on(contact, contacts[end].apart));
    }
    for (std::size_t i = begin; i < end; ++i) {
      mjContact& contact = data.contact[contacts[i].contact];
      changed = soften_friction(model, data, contacts[i].apart, load, contact) || changed;
    }
  }
  return changed;
}

}  // namespace tenon::engines::mujoco
