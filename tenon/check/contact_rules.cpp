// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Contacts at the start that no engine here resolves well. The thresholds were measured at steps of
// 2 ms on MuJoCo, PhysX and Jolt:
//   A box on one of its size moves by 1 % of its size and more from 28 to 1 on (Jolt), 100 to 1
//   (MuJoCo) and 3000 to 1 (PhysX); on four supports from 100 to 1 on. In steps that are shorter by
//   a factor the ratio may be larger by that factor.
//   A ball that meets two which touch shares its impulse with both at once. At a restitution of 1
//   it comes back with a third of its speed on all three, where Newton's cradle stops it. With gaps
//   of 2 % of their size between the balls MuJoCo and PhysX still are wrong, with 5 % all three are
//   right.
// The rule on masses skips bodies that joints hold: these carry more than their own mass.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "tenon/base/text/counted.h"
#include "tenon/check/extents.h"
#include "tenon/check/overlaps/overlaps.h"
#include "tenon/check/subject.h"

namespace tenon::check {
namespace {

using scene::Body;
using scene::Collider;
using scene::Index;

constexpr double kRatioOnOne = 40;       ///< of masses, on one support
constexpr double kRatioOnSeveral = 100;  ///< of masses, shared by the supports
constexpr double kSmallestStep = 1e-4;   ///< [s] that is proposed
constexpr double kBouncy = 0.5;          ///< restitution of a pair
constexpr double kProposedGap = 0.05;    ///< of the thickness of a body
constexpr double kNarrowGap = 0.03;      ///< of the sizes of two; less is as if they touched
constexpr double kSameVelocity = 1e-6;   ///< [m/s]

std::vector<bool> jointed_bodies(const scene::PhysicsScene& scene) {
  std::vector<bool> jointed(scene.bodies.size(), false);
  for (const scene::Joint& joint : scene.joints) {
    for (const auto& body : {joint.body0, joint.body1}) {
      if (joint.enabled && body) {
        jointed[*body] = true;
      }
    }
  }
  return jointed;
}

/// Some body is that much heavier than another one.
bool masses_differ(const scene::PhysicsScene& scene, double ratio) {
  double least = kInfinity;
  double most = 0;
  for (const Body& body : scene.bodies) {
    least = body.kinematic ? least : std::fmin(least, body.mass);
    most = body.kinematic ? most : std::fmax(most, body.mass);
  }
  return most >= ratio * least;
}

/// What the dynamic bodies rest on: bodies, and the world as none.
using Supports = std::map<Index, std::set<std::optional<Index>>>;

Supports supports_of(const scene::PhysicsScene& scene, const std::vector<ColliderPair>& contacts) {
  Supports supports;
  const auto add = [&](Index upper, Index lower) {
    const std::optional<Index> body = scene.colliders[upper].body;
    if (!scene.is_dynamic(body) || scene.colliders[lower].body == body) {
      return;
    }
    const Vec3d pull =
        scene.scenes[scene.bodies[*body].scene].gravity * scene.bodies[*body].gravity_scale;
    if (length(pull) > 0 && rests_on(scene, upper, lower, normalized(pull))) {
      supports[*body].insert(scene.colliders[lower].body);
    }
  };
  for (const auto& [a, b] : contacts) {
    add(a, b);
    add(b, a);
  }
  return supports;
}

/// A light body that carries a heavy one.
void report_ratio(const Subject& subject, const Body& heavy, const Body& light, double share,
                  double most, Reporter& report) {
  const double ratio = share / light.mass;
  const double right = most / 2;  // with room: `most` is where the first engine fails
  const double step = step_of(subject.scene, heavy) * right / ratio;
  report.at(subject.stage.prim(heavy.path),
            "at the start " + digits(share) + " kg rest on " +
                named(light.path, RelatedRole::Body) + " of " + digits(light.mass) + " kg, " +
                digits(ratio) + " to 1: in steps of " + digits(step_of(subject.scene, heavy)) +
                " s solvers press the light body in, or it slides or shoots out",
            "give the light body at least " + digits(share / right) +
                " kg, check the unit of both masses" +
                (step < kSmallestStep ? std::string()
                                      : ", or take steps of " + digits(step) + " s (--dt)"));
}

/// Bodies that touch others of which they bounce off, each with those of its heap: (body_count).
class BouncyRows {
 public:
  BouncyRows(const scene::PhysicsScene& scene, const std::vector<ColliderPair>& contacts)
      : scene_(scene), first_(scene.bodies.size()) {
    for (Index i = 0; i < first_.size(); ++i) {
      first_[i] = i;
    }
    for (const auto& [a, b] : contacts) {
      const auto body_a = scene.colliders[a].body;
      const auto body_b = scene.colliders[b].body;
      if (scene.is_dynamic(body_a) && scene.is_dynamic(body_b) && bounciness(a, b) >= kBouncy) {
        join(*body_a, *body_b);
        bounciest_ = std::fmax(bounciest_, bounciness(a, b));
      }
    }
    for (Index i = 0; i < first_.size(); ++i) {
      rows_[root(i)].push_back(i);
    }
    std::erase_if(rows_, [](const auto& row) { return row.second.size() < 2; });
  }

  /// By the first body, in the order of bodies.
  const std::map<Index, std::vector<Index>>& rows() const { return rows_; }
  double bounciest() const { return bounciest_; }

  double bounciness(Index a, Index b) const {
    const scene::Material& first = material_of(a);
    const scene::Material& second = material_of(b);
    return scene::combine(first.restitution, first.restitution_combine, second.restitution,
                          second.restitution_combine);
  }

 private:
  const scene::Material& material_of(Index collider) const {
    const auto& material = scene_.colliders[collider].material;
    return material ? scene_.materials[*material] : scene_.unbound;
  }
  Index root(Index body) const {
    while (first_[body] != body) {
      body = first_[body];
    }
    return body;
  }
  void join(Index a, Index b) {
    const Index root_a = root(a);
    const Index root_b = root(b);
    first_[std::max(root_a, root_b)] = std::min(root_a, root_b);
  }

  const scene::PhysicsScene& scene_;
  std::vector<Index> first_;
  std::map<Index, std::vector<Index>> rows_;
  double bounciest_ = 0;
};

/// Something is there that can hit the row: a body outside of it that bounces off one of it, the
/// row itself, which falls on what is below, or one of its bodies that moves unlike the rest.
bool can_be_hit(const Subject& subject, const BouncyRows& bouncy, const std::vector<Index>& row,
                bool falls) {
  const scene::PhysicsScene& scene = subject.scene;
  std::vector<bool> in_row(scene.bodies.size(), false);
  for (const Index member : row) {
    in_row[member] = true;
  }
  for (const Index member : row) {
    if (length(scene.bodies[member].linear_velocity - scene.bodies[row.front()].linear_velocity) >
        kSameVelocity) {
      return true;
    }
    for (const Index own : subject.colliders_of_body[member]) {
      for (Index other = 0; other < scene.colliders.size(); ++other) {
        const Collider& collider = scene.colliders[other];
        const bool outside = !collider.body || !in_row[*collider.body];
        if (outside && collider.enabled && (collider.body || falls) &&
            scene.may_collide(own, other) && bouncy.bounciness(own, other) >= kBouncy) {
          return true;
        }
      }
    }
  }
  return false;
}

}  // namespace

void check_contact_ratio(const Subject& subject, Reporter& report) {
  const scene::PhysicsScene& scene = subject.scene;
  if (!masses_differ(scene, kRatioOnOne)) {
    return;
  }
  const std::vector<bool> jointed = jointed_bodies(scene);
  for (const auto& [upper, lower] : supports_of(scene, contacts_at_start(scene, kAllOverlaps))) {
    const Body& heavy = scene.bodies[upper];
    const double share = heavy.mass / static_cast<double>(lower.size());
    const double most = (lower.size() == 1 ? kRatioOnOne : kRatioOnSeveral) *
                        std::fmax(1, kDefaultStep / step_of(scene, heavy));
    for (const std::optional<Index>& body : lower) {
      if (scene.is_dynamic(body) && !jointed[upper] && !jointed[*body] &&
          share >= most * scene.bodies[*body].mass) {
        report_ratio(subject, heavy, scene.bodies[*body], share, most, report);
      }
    }
  }
}

void check_simultaneous_impacts(const Subject& subject, Reporter& report) {
  const scene::PhysicsScene& scene = subject.scene;
  const auto& materials = scene.materials;
  if (std::none_of(materials.begin(), materials.end(),
                   [](const scene::Material& m) { return m.restitution >= kBouncy; })) {
    return;
  }
  const std::vector<ColliderPair> contacts = contacts_at_start(scene, kAllOverlaps);
  const BouncyRows bouncy(scene, contacts_at_start(scene, kAllOverlaps, kNarrowGap));
  const std::vector<bool> jointed = jointed_bodies(scene);
  const Supports supports = supports_of(scene, contacts);
  for (const auto& [first, row] : bouncy.rows()) {
    const bool falls = std::none_of(row.begin(), row.end(), [&](Index body) {
      const auto found = supports.find(body);
      return jointed[body] || (found != supports.end() && found->second.contains(std::nullopt));
    });
    if (!can_be_hit(subject, bouncy, row, falls)) {
      continue;
    }
    Message message = counted(row.size(), "body", "bodies") + " of a restitution up to " +
                      digits(bouncy.bounciest()) +
                      " touch at the start, or nearly: solvers resolve an impact on all of them at "
                      "once, and none passes it on as a row of balls does";
    for (const Index body : row) {
      if (body != first) {
        message.about(scene.bodies[body].path, RelatedRole::Body);
      }
    }
    report.at(subject.stage.prim(scene.bodies[first].path), message,
              "leave gaps of about " + digits(kProposedGap * thickness_of_body(subject, first)) +
                  " m between them");
  }
}

}  // namespace tenon::check
