// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Jolt tells its listener where bodies touch, before it knows the forces. The impulses of the step
// are in what it saves of its contacts: for each pair of bodies the manifolds, and for each of
// their points the impulses along the normal and along two directions across it.
#include "tenon/engines/jolt/run/contact_forces.h"

#include <algorithm>

#include "tenon/engines/jolt/convert.h"
#include "tenon/engines/jolt/run/state_bytes.h"

namespace tenon::engines::jolt {
namespace {

struct PointImpulse {
  JPH::Float3 place1;
  JPH::Float3 place2;
  float normal = 0;
  float across[2] = {0, 0};
};
static_assert(sizeof(PointImpulse) == 36, "as ContactConstraintManager::CachedContactPoint");

void add_contact(const scene::PhysicsScene& scene, const PairListener::Manifold& manifold,
                 std::size_t index, const PointImpulse& impulse, double time_step,
                 std::vector<Contact>& contacts) {
  const PairListener::Point& point = manifold.points[index];
  if (impulse.normal <= 0 && point.depth < 0) {
    return;  // near, and no more
  }
  const JPH::Vec3 along = to_jolt(manifold.normal).GetNormalizedPerpendicular();
  const Vec3d one = from_jolt(along);
  const Vec3d other = from_jolt(to_jolt(manifold.normal).Cross(along));
  const Vec3d friction =
      one * static_cast<double>(impulse.across[0]) + other * static_cast<double>(impulse.across[1]);
  const double sign = manifold.collider1 < manifold.collider2 ? 1 : -1;
  Contact contact;
  contact.collider0 = std::min(manifold.collider1, manifold.collider2);
  contact.collider1 = std::max(manifold.collider1, manifold.collider2);
  contact.body0 = scene.colliders[contact.collider0].body;
  contact.body1 = scene.colliders[contact.collider1].body;
  contact.point = point.place;
  contact.normal = manifold.normal * sign;
  contact.depth = point.depth;
  contact.normal_force = static_cast<double>(impulse.normal) / time_step;
  contact.friction_force = friction * (sign / time_step);
  contacts.push_back(contact);
}

void read_system(const scene::PhysicsScene& scene, const System& system, double time_step,
                 std::vector<Contact>& contacts) {
  StateBytes saved;
  system.system->SaveState(saved, JPH::EStateRecorderState::Contacts);
  StateBytes stream(saved.bytes());
  JPH::EStateRecorderState what{};
  stream.Read(what);
  std::size_t pairs = 0;
  stream.Read(pairs);
  for (std::size_t p = 0; p < pairs && !stream.IsFailed(); ++p) {
    JPH::BodyPair bodies;
    JPH::Float3 moved;
    JPH::Float3 turned;
    std::size_t manifolds = 0;
    stream.Read(bodies);
    stream.Read(moved);
    stream.Read(turned);
    stream.Read(manifolds);
    for (std::size_t m = 0; m < manifolds && !stream.IsFailed(); ++m) {
      JPH::SubShapeIDPair parts;
      JPH::uint16 points = 0;
      JPH::Float3 normal;
      stream.Read(parts);
      stream.Read(points);
      stream.Read(normal);
      const auto told = system.listener->manifolds().find(parts);
      for (std::size_t i = 0; i < points; ++i) {
        PointImpulse impulse;
        stream.Read(impulse);
        if (told != system.listener->manifolds().end() && i < told->second.points.size()) {
          add_contact(scene, told->second, i, impulse, time_step, contacts);
        }
      }
    }
  }
}

}  // namespace

std::vector<Contact> read_contacts(const scene::PhysicsScene& scene, const Model& model) {
  std::vector<Contact> contacts;
  for (const System& system : model.systems) {
    read_system(scene, system, model.time_step, contacts);
  }
  return contacts;
}

}  // namespace tenon::engines::jolt
