// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tenon/base/path.h"
#include "tenon/base/token.h"
#include "tenon/physics/bodies/mass_properties.h"
#include "tenon/physics/scene_names.h"
#include "tenon/scene/physics_scene.h"

/// The decisions of a reading, to answer "why": filled on request.
namespace tenon::physics {

enum class MassQuantity : std::uint8_t { Mass, Density, CenterOfMass, Inertia };

/// "mass", "density", "centerOfMass", "inertia".
std::string_view mass_quantity_name(MassQuantity quantity);

/// One that could give a quantity: an opinion, a sum over colliders, or a default.
struct MassCandidate {
  MassQuantity quantity = MassQuantity::Mass;
  Path prim;              ///< that authors it; empty: the rule alone gives it
  Token property;         ///< empty: the rule alone gives it
  std::string value;      ///< SI, with its unit
  const char* rule = "";  ///< number of the rule of reading, "S-39"
  bool used = false;
  std::string why;  ///< why it counts or not, a clause
};

/// What one collider gives to its body.
struct ColliderMass {
  Index collider = 0;
  bool counted = false;                   ///< false: disabled (S-43)
  double volume = 0;                      ///< [m^3]
  MassProperties properties;              ///< in the body frame, before what the body itself says
  std::vector<MassCandidate> candidates;  ///< mass, then densities; strongest first
};

/// The way to the mass properties of one body; candidates strongest first.
struct MassProvenance {
  Index body = 0;
  AuthoredMass authored;    ///< on the body itself, SI
  MassProperties computed;  ///< the sum of the colliders; mass 0 where there is none
  MassProperties result;
  std::vector<MassCandidate> candidates;  ///< mass, centre of mass, inertia
  std::vector<ColliderMass> colliders;    ///< of the body, ascending
};

/// Why two colliders never touch, as one prim says it.
enum class PairRule : std::uint8_t { FilteredPair, Joint, Articulation };

struct PairProvenance {
  Index a = 0;  ///< sets of the collision filter, a <= b
  Index b = 0;
  PairRule rule = PairRule::FilteredPair;
  Path prim;         ///< that says so
  Token property{};  ///< of that prim; empty: what the rule reads there
};

struct Provenance {
  std::vector<MassProvenance> masses;  ///< (body_count)
  std::vector<PairProvenance> pairs;   ///< in the order of reading
};

/// One reason why two colliders do not touch.
struct PairReason {
  const char* rule = "";  ///< "S-77"
  std::string why;        ///< a sentence
  Path prim;              ///< that says so; empty: the rule alone
  Token property;
};

/// All reasons why two colliders of a scene never touch; empty: they may.
std::vector<PairReason> why_apart(const PhysicsScene& scene, const Provenance& provenance,
                                  Index collider_a, Index collider_b);

}  // namespace tenon::physics
