// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A tendon along joints is a law of the sum of their coordinates: a spring with a slack between two
// lengths is two soft bounds, its range two more. Tendons along a path in space are unsupported and
// reported.
#include <algorithm>

#include "tenon/engines/jolt/build/build.h"

namespace tenon::engines::jolt {
namespace {

using scene::Index;

std::vector<CoordinateOf> parts_of(Build& build, const scene::Tendon& tendon) {
  std::vector<CoordinateOf> parts;
  for (std::size_t i = 0; i < tendon.joints.size(); ++i) {
    const Index joint = tendon.joints[i];
    const JointMap& map = build.model.joints[joint];
    if (!map.acts || map.dofs.free.size() != 1 || map.dofs.ball) {
      build.report(tendon.path, "",
                   "<" + build.scene.joints[joint].path.str() +
                       "> is not a single coordinate here; the tendon is skipped");
      return {};
    }
    parts.push_back(coordinate_of(build, joint, 0));
    parts.back().coefficient = tendon.coefficients[i];
  }
  return parts;
}

LawTerm bound_at(TermKind kind, double length, double stiffness) {
  LawTerm term;
  term.kind = kind;
  term.target_position = length;
  term.stiffness = stiffness;
  return term;
}

void add_spring(const scene::Tendon& tendon, double length, std::vector<LawTerm>& terms) {
  const double low = tendon.spring_length[0] < 0 ? length : tendon.spring_length[0];
  const double high = tendon.spring_length[0] < 0 ? length : tendon.spring_length[1];
  if (tendon.stiffness > 0 && low == high) {
    LawTerm term = bound_at(TermKind::Spring, low, tendon.stiffness);
    term.damping = tendon.damping;
    terms.push_back(term);
    return;
  }
  if (tendon.stiffness > 0) {
    terms.push_back(bound_at(TermKind::Lower, low, tendon.stiffness));
    terms.push_back(bound_at(TermKind::Upper, high, tendon.stiffness));
  }
  if (tendon.damping > 0) {
    LawTerm term;
    term.damping = tendon.damping;
    terms.push_back(term);
  }
}

std::vector<LawTerm> terms_of(const scene::Tendon& tendon, double length) {
  std::vector<LawTerm> terms;
  add_spring(tendon, length, terms);
  LawTerm term;
  if (tendon.friction > 0) {
    term.kind = TermKind::Friction;
    term.max_force = tendon.friction;
    terms.push_back(term);
  }
  if (tendon.armature > 0) {
    term = {};
    term.kind = TermKind::Armature;
    term.inertia = tendon.armature;
    terms.push_back(term);
  }
  if (tendon.range.has_value()) {
    terms.push_back(bound_at(TermKind::Lower, (*tendon.range)[0], tendon.limit_stiffness));
    terms.push_back(bound_at(TermKind::Upper, (*tendon.range)[1], tendon.limit_stiffness));
  }
  return terms;
}

void add_tendon(Build& build, const scene::Tendon& tendon) {
  if (!tendon.wraps.empty()) {
    build.report(tendon.path, "", "tendons along a path in space are not simulated on Jolt");
    return;
  }
  std::vector<CoordinateOf> parts = parts_of(build, tendon);
  if (parts.empty()) {
    return;
  }
  const JPH::Ref<CoordinateLaw> law = new CoordinateLaw(std::move(parts));
  law->terms = terms_of(tendon, law->length_now());
  if (!law->terms.empty()) {
    build.sums.push_back(law);
  }
}

}  // namespace

void add_tendons(Build& build) {
  for (const scene::Tendon& tendon : build.scene.tendons) {
    add_tendon(build, tendon);
  }
}

}  // namespace tenon::engines::jolt
