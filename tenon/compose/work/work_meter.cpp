// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/compose/work/work_meter.h"

#include <string_view>

#include "tenon/compose/composition_error.h"
#include "tenon/compose/layer_stack.h"

namespace tenon::compose {
namespace {

std::string_view arcs_of(ArcKind kind) {
  switch (kind) {
    case ArcKind::Inherit:
      return "inherits";
    case ArcKind::Variant:
      return "variants";
    case ArcKind::Relocate:
      return "relocates";
    case ArcKind::Reference:
      return "references";
    case ArcKind::Payload:
      return "payloads";
    case ArcKind::Specialize:
      return "specializes";
    case ArcKind::Root:
      break;
  }
  return "arcs";
}

using UnitsByPlace = std::unordered_map<ArcPlace, std::size_t, ArcPlaceHash>;

/// The most costly first; equal ones in an order that no address decides.
bool is_more_costly(const ArcCost& a, const ArcCost& b) {
  if (a.units != b.units) {
    return a.units > b.units;
  }
  if (a.place.layer_stack != b.place.layer_stack) {
    const std::string& a_layer = a.place.layer_stack->identifier();
    const std::string& b_layer = b.place.layer_stack->identifier();
    if (a_layer != b_layer) {
      return a_layer < b_layer;
    }
  }
  return a.place.path != b.place.path ? a.place.path.str() < b.place.path.str()
                                      : a.place.kind < b.place.kind;
}

}  // namespace

void WorkMeter::fold_costs() {
  UnitsByPlace units;
  for (const ArcCost& cost : costs_) {
    units[cost.place] += cost.units;
  }
  costs_.clear();
  for (const auto& [place, sum] : units) {
    costs_.push_back({place, sum});
  }
  most_costs_ = std::max<std::size_t>(most_costs_, 2 * costs_.size());
}

Message ArcCosts::most_costly(std::size_t all_units) const {
  ArcCost most;
  for (const auto& [place, units] : units_) {
    const ArcCost cost{place, units};
    if (most.place.layer_stack == nullptr || is_more_costly(cost, most)) {
      most = cost;
    }
  }
  if (most.place.layer_stack == nullptr) {
    return "";
  }
  return "the " + std::string(arcs_of(most.place.kind)) + " of " +
         named_in(*most.place.layer_stack->root, most.place.path) + " took " +
         std::to_string(most.units) + " of " + std::to_string(all_units) + " units";
}

}  // namespace tenon::compose
