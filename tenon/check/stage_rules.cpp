// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What every USD file should have, whether it holds physics or not.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "tenon/base/text/comma_list.h"
#include "tenon/check/subject.h"
#include "tenon/layer/field_values.h"
#include "tenon/layer/fields.h"
#include "tenon/layer/finding_place.h"
#include "tenon/physics/attribute_values.h"
#include "tenon/stage/transform_at.h"

namespace tenon::check {
namespace {

namespace fields = layer::fields;

const std::string kPhysicsSet = "Physics";

/// Selections that files author on a prim, strongest first; the session's are the user's own.
std::map<std::string, std::string> authored_selections(const Subject& subject,
                                                       const stage::Prim& prim) {
  std::map<std::string, std::string> found;
  for (const stage::SpecSite& site : prim.spec_stack()) {
    if (site.layer == subject.stage.session_layer()) {
      continue;
    }
    if (const auto* selections =
            site.spec->get<layer::VariantSelections>(fields::variantSelection)) {
      found.insert(selections->items.begin(), selections->items.end());
    }
  }
  return found;
}

StatementPart selection_part(const std::string& set, const std::string& variant) {
  return layer::entry_part(fields::variantSelection, {set}, variant);
}

bool has(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

void report_missing(const Subject& subject, Reporter& report, Token field, const char* counts) {
  if (!subject.stage.has_authored_metadata(field)) {
    report.at_root(subject.stage, field.str() + " is not authored; " + counts + " counts",
                   "author " + field.str());
  }
}

/// Low and high corners that hold something: finite, low not above high.
bool is_box(const Vec3f& low, const Vec3f& high) {
  for (std::size_t i = 0; i < 3; ++i) {
    constexpr float kHuge = 1e37F;
    if (!(low[i] <= high[i]) || !(std::fabs(low[i]) < kHuge) || !(std::fabs(high[i]) < kHuge)) {
      return false;
    }
  }
  return true;
}

/// Some pair of corners is a box; empty purposes of extentsHint are written inside out.
bool has_box(const layer::Array<Vec3f>& corners) {
  for (std::size_t i = 0; i + 1 < corners.size(); i += 2) {
    if (is_box(corners[i], corners[i + 1])) {
      return true;
    }
  }
  return corners.empty();
}

/// Below an inactive prim or an unloaded payload: it would be there if that were switched on.
bool lies_below_what_is_off(const stage::Stage& stage, Path path) {
  for (; !path.empty() && !path.is_absolute_root(); path = path.parent()) {
    if (const stage::Prim above = stage.prim(path)) {
      return !above.is_active() || !above.is_loaded();
    }
  }
  return false;
}

template <class Q>
double length_of(const layer::Value& value) {
  const Q* q = value.get<Q>();
  return q == nullptr ? -1 : std::sqrt(dot(to_double(*q), to_double(*q)));
}

}  // namespace

// S-7
void check_length_unit(const Subject& subject, Reporter& report) {
  report_missing(subject, report, fields::metersPerUnit, "0.01, centimetres,");
}

// S-8
void check_mass_unit(const Subject& subject, Reporter& report) {
  if (!subject.scene.bodies.empty()) {
    report_missing(subject, report, fields::kilogramsPerUnit, "1");
  }
}

// S-9
void check_up_axis_missing(const Subject& subject, Reporter& report) {
  report_missing(subject, report, fields::upAxis, "Y");
}

void check_default_prim_missing(const Subject& subject, Reporter& report) {
  const layer::Layer& root = subject.stage.root_layer();
  if (root.default_prim().empty() && !subject.prims.empty()) {
    report.at_root(subject.stage,
                   "defaultPrim is not authored: references to the file have to name a prim",
                   "author defaultPrim with the name of the root prim");
  }
}

void check_default_prim_unresolved(const Subject& subject, Reporter& report) {
  const Token name = subject.stage.root_layer().default_prim();
  if (!name.empty() && !subject.stage.default_prim()) {
    report.at_root(subject.stage, "defaultPrim names \"" + name.str() + "\", which does not exist",
                   "name a prim that exists", layer::item_part(fields::defaultPrim, name.str()));
  }
}

void check_target_missing(const Subject& subject, Reporter& report) {
  for (const stage::Prim& prim : subject.prims) {
    for (const Token name : prim.authored_property_names()) {
      const bool relationship = prim.is_relationship(name);
      const std::vector<Path> targets =
          relationship ? prim.relationship(name).targets() : prim.attribute(name).connections();
      for (const Path& target : targets) {
        const stage::Prim there =
            target.prim().is_absolute_root() ? prim : subject.stage.prim(target.prim());
        const bool exists = there ? !target.is_property() || there.has_property(target.name())
                                  : lies_below_what_is_off(subject.stage, target.prim());
        const bool owner = name == "physics:simulationOwner" &&
                           subject.has_finding("scene.owner-missing", prim.path().str());
        const bool of_pose = name == "isaac:robot:pose:joints";  // pose.joint-missing
        if (!exists && !owner && !of_pose && !subject.is_reported(prim.path().str(), name.str())) {
          report.at_target(prim, name, target,
                           name.str() + " names " + named(target, RelatedRole::Target) +
                               ", which does not exist",
                           "name what exists, or remove the target");
        }
      }
    }
  }
}

void check_unknown_selection(const Subject& subject, Reporter& report) {
  for (const stage::Prim& prim : subject.prims) {
    for (const auto& [set, variant] : authored_selections(subject, prim)) {
      const std::vector<std::string> sets = prim.variant_set_names();
      const std::vector<std::string> variants = prim.variant_names(set);
      if (!has(sets, set)) {
        report.at(prim,
                  "a variant of the set \"" + set + "\" is selected, and there is no such set",
                  "remove the selection", selection_part(set, variant));
      } else if (!variant.empty() && !has(variants, variant)) {
        report.at(prim,
                  "variant set \"" + set + "\" has no variant \"" + variant +
                      "\": nothing of the set is composed",
                  "select one of: " + comma_list(variants), selection_part(set, variant));
      }
    }
  }
}

void check_physics_unselected(const Subject& subject, Reporter& report) {
  const stage::Prim prim = subject.stage.default_prim();
  if (!prim || !has(prim.variant_set_names(), kPhysicsSet)) {
    return;
  }
  if (!authored_selections(subject, prim).contains(kPhysicsSet)) {
    report.at(prim,
              "no variant of the set \"Physics\" is selected: the asset opens without physics",
              "select one of: " + comma_list(prim.variant_names(kPhysicsSet)));
  }
}

void check_asset_missing(const Subject& subject, Reporter& report) {
  for (const stage::Prim& prim : subject.prims) {
    for (const Token name : prim.authored_property_names()) {
      if (prim.is_relationship(name)) {
        continue;
      }
      const layer::Value value = prim.attribute(name).get();
      const auto* asset = value.get<layer::AssetPath>();
      if (asset == nullptr || asset->authored.empty() || !asset->resolved.empty()) {
        continue;
      }
      // Tiles are patterns; modules without a folder come with the renderer.
      const bool pattern = asset->authored.find('<') != std::string::npos;
      const bool module =
          asset->authored.find('/') == std::string::npos && asset->authored.ends_with(".mdl");
      if (!pattern && !module) {
        report.at(prim, name, name.str() + " names @" + asset->authored + "@, which is not there",
                  "put the file there, or correct the path",
                  physics::value_part("@" + asset->authored + "@"));
      }
    }
  }
}

void check_extent(const Subject& subject, Reporter& report) {
  for (const stage::Prim& prim : subject.prims) {
    for (const char* name : {"extent", "extentsHint"}) {
      const stage::Attribute extent = prim.attribute(name);
      const auto corners =
          extent.has_authored_value() ? extent.get_as<layer::Array<Vec3f>>() : std::nullopt;
      if (corners && !has_box(*corners)) {
        report.at(
            prim, name,
            std::string(name) + " is not a box: its corners are inside out, infinite or no number",
            "author low and high corners, or remove it");
      }
    }
  }
}

void check_over_only(const Subject& subject, Reporter& report) {
  std::vector<stage::Prim> pending{subject.stage.pseudo_root()};
  while (!pending.empty()) {
    const stage::Prim prim = pending.back();
    pending.pop_back();
    if (!prim.is_pseudo_root() && !prim.is_defined()) {
      report.at(prim, "the prim is overridden and defined nowhere: its opinions act on nothing",
                "define it, correct its path, or remove it");
      continue;
    }
    if (prim.is_active() && !prim.is_instance()) {
      const std::vector<stage::Prim> children = prim.children();
      pending.insert(pending.end(), children.rbegin(), children.rend());
    }
  }
}

void check_below_instance(const Subject& subject, Reporter& report) {
  std::set<const layer::Layer*> local;
  for (const compose::StackedLayer& stacked : subject.stage.layer_stack().layers) {
    local.insert(stacked.layer.get());
  }
  for (const stage::Prim& prim : subject.prims) {
    if (!prim.is_instance() || prim.is_instance_proxy()) {
      continue;
    }
    for (const stage::SpecSite& site : prim.spec_stack()) {
      const bool here = local.contains(site.layer) && site.path == prim.path();
      if (here && !layer::Layer::children(*site.spec, fields::primChildren).empty()) {
        report.at(
            prim, "opinions below an instance do not count: instances share their descendants",
            "make the prim not instanceable, or put the opinions into the file that it references");
        break;
      }
    }
  }
}

void check_xform_op(const Subject& subject, Reporter& report) {
  for (const stage::Prim& prim : subject.prims) {
    if (!prim.attribute("xformOpOrder").has_authored_value()) {
      continue;
    }
    Diagnostics found;
    stage::local_transform(prim, {}, &found);
    for (const Diagnostic& d : found) {
      report.at(prim, "xformOpOrder", d.message, d.fix, d.part);
    }
  }
}

void check_orient_length(const Subject& subject, Reporter& report) {
  for (const stage::Prim& prim : subject.prims) {
    for (const Token name : prim.authored_property_names()) {
      if (!name.view().starts_with("xformOp:orient")) {
        continue;
      }
      const layer::Value value = prim.attribute(name).get();
      const double norm =
          std::max({length_of<Quatf>(value), length_of<Quatd>(value), length_of<Quath>(value)});
      if (norm >= 0 && std::fabs(norm - 1) > 1e-2) {
        report.at(prim, name, name.str() + " has length " + digits(norm) + ", no rotation",
                  "author a unit quaternion");
      }
    }
  }
}

}  // namespace tenon::check
