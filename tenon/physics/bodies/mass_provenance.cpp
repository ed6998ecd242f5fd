// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// For each quantity, everything that could have given it is listed, strongest first. Nothing is
// decided here: the authored, computed and final values come from the code that computes masses,
// and the list follows the order of its rules. The first candidate of a chain is the one that was
// used. Opinions that are authored but count as unset are listed too, with the rule that passes
// over them.
#include "tenon/physics/bodies/mass_provenance.h"

#include "tenon/base/text/rounded_text.h"

namespace tenon::physics {
namespace {

std::string text(const Vec3d& v) {
  return "(" + rounded_text(v[0]) + ", " + rounded_text(v[1]) + ", " + rounded_text(v[2]) + ")";
}

std::string inertia_text(const Mat3d& inertia) {
  return "principal moments " + text(principal_inertia(inertia).moments) + " kg m^2";
}

/// Lists candidates of one quantity; the first that is there is used.
class Chain {
 public:
  Chain(MassProvenance& provenance, MassQuantity quantity)
      : provenance_(provenance), quantity_(quantity) {}

  void add(Path prim, Token property, std::string value, const char* rule, std::string why) {
    const bool first = !used_;
    used_ = true;
    provenance_.candidates.push_back({quantity_, prim, property, std::move(value), rule, first,
                                      first ? std::move(why) : "overruled by the opinion above"});
  }
  void add_unset(Path prim, Token property, std::string value, const char* rule, std::string why) {
    provenance_.candidates.push_back(
        {quantity_, prim, property, std::move(value), rule, false, std::move(why)});
  }

 private:
  MassProvenance& provenance_;
  MassQuantity quantity_;
  bool used_ = false;
};

bool authors(const PhysicsPrim& found, Token name) {
  return found.prim.has_property(name) && found.prim.attribute(name).has_authored_value();
}

/// An opinion that is there but counts as unset, or whose API is not applied.
void add_passed_over(const PhysicsPrim& found, Token name, const char* rule, const char* why,
                     Chain& chain) {
  if (!authors(found, name)) {
    return;
  }
  const bool applied = found.roles.has(Api::Mass);
  chain.add_unset(found.path, name, "", applied ? rule : "S-2",
                  applied ? why : "ignored: PhysicsMassAPI is not applied here");
}

void trace_mass(const ReadState& state, const PhysicsPrim& found, MassProvenance& provenance) {
  Chain chain(provenance, MassQuantity::Mass);
  if (provenance.authored.mass) {
    chain.add(found.path, state.tokens.mass, mass_text(*provenance.authored.mass), "S-39",
              "a mass on the body beats those of its colliders and every density");
  } else {
    add_passed_over(found, state.tokens.mass, "S-41",
                    "unset: zero, negative, infinite, blocked or of another type", chain);
  }
  if (provenance.computed.mass > 0) {
    chain.add({}, {}, mass_text(provenance.computed.mass), "S-39",
              "the sum over the colliders below");
  } else {
    chain.add({}, {}, mass_text(kDefaultMass * state.units.mass), "S-42",
              "no collider has a volume: one unit of mass");
  }
}

void trace_center(const ReadState& state, const PhysicsPrim& found, MassProvenance& provenance) {
  Chain chain(provenance, MassQuantity::CenterOfMass);
  if (provenance.authored.center) {
    chain.add(found.path, state.tokens.center_of_mass, text(*provenance.authored.center) + " m",
              "S-44", "authored, scaled by the prim");
  } else {
    add_passed_over(found, state.tokens.center_of_mass, "S-44",
                    "unset: not finite, blocked or of another type", chain);
  }
  if (provenance.computed.mass > 0) {
    chain.add({}, {}, text(provenance.computed.center) + " m", "M-12",
              "the mean of the colliders, weighted by mass");
  } else {
    chain.add({}, {}, text(Vec3d{}) + " m", "S-42", "no collider has a volume: the origin");
  }
}

std::string computed_inertia_why(const MassProvenance& provenance, CenterShift shift) {
  std::string why = "that of the colliders";
  if (provenance.authored.mass) {
    why += ", scaled to the mass (M-14)";
  }
  if (provenance.authored.center) {
    why += shift == CenterShift::ParallelAxis
               ? ", plus the parallel-axis term of the authored centre (M-15)"
               : ", not moved to the authored centre (M-15)";
  }
  return why;
}

void trace_inertia(const ReadState& state, const PhysicsPrim& found, CenterShift shift,
                   MassProvenance& provenance) {
  Chain chain(provenance, MassQuantity::Inertia);
  if (provenance.authored.inertia) {
    const bool six =
        found.roles.has(Api::NewtonMass) && authors(found, state.tokens.newton_inertia);
    chain.add(found.path, six ? state.tokens.newton_inertia : state.tokens.diagonal_inertia,
              inertia_text(*provenance.authored.inertia), "M-16",
              "authored: used as it is, about the final centre of mass");
  } else {
    add_passed_over(found, state.tokens.diagonal_inertia, "S-45",
                    "unset: exactly zero, negative, blocked or of another type", chain);
    add_passed_over(found, state.tokens.principal_axes, "S-46",
                    "axes without moments have no effect", chain);
  }
  const bool none = !(provenance.computed.mass > 0);
  // Without an authored inertia the result is the computed one.
  const Mat3d& inertia =
      provenance.authored.inertia ? provenance.computed.inertia : provenance.result.inertia;
  if (none) {
    chain.add({}, {}, provenance.authored.inertia ? "" : inertia_text(inertia), "M-18",
              "no collider has a volume: a ball of 0.1 m");
  } else {
    chain.add({}, {}, inertia_text(inertia), "M-12", computed_inertia_why(provenance, shift));
  }
}

}  // namespace

std::string mass_text(double kilograms) { return rounded_text(kilograms) + " kg"; }
std::string density_text(double density) { return rounded_text(density) + " kg/m^3"; }

std::string_view mass_quantity_name(MassQuantity quantity) {
  switch (quantity) {
    case MassQuantity::Mass:
      return "mass";
    case MassQuantity::Density:
      return "density";
    case MassQuantity::CenterOfMass:
      return "centerOfMass";
    case MassQuantity::Inertia:
      break;
  }
  return "inertia";
}

void trace_body_mass(const ReadState& state, const PhysicsPrim& found, CenterShift shift,
                     MassProvenance& provenance) {
  trace_mass(state, found, provenance);
  trace_center(state, found, provenance);
  trace_inertia(state, found, shift, provenance);
}

}  // namespace tenon::physics
