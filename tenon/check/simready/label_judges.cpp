// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Requirements on semantic labels, and on what sensors other than cameras see of a material. A
// label counts at a shape, at what is above it, at its material and above that, and at its subsets.
#include <algorithm>
#include <map>
#include <set>

#include "tenon/check/simready/judges.h"
#include "tenon/check/simready/reading.h"
#include "tenon/layer/field_values.h"

namespace tenon::check::simready {
namespace {

constexpr const char* kLabels = "SemanticsLabelsAPI";

bool is_below_root(const Judged& judged, const stage::Prim& prim) {
  return judged.stage.root && prim.path().has_prefix(judged.stage.root.path());
}

using Tokens = layer::Array<Token>;

std::string label_name(const std::string& instance) { return "semantics:labels:" + instance; }

/// The labels of an instance; none where they cannot be used.
std::optional<std::vector<std::string>> labels_of(const stage::Prim& prim,
                                                  const std::string& instance) {
  const stage::Attribute labels = prim.attribute(Token(label_name(instance)));
  if (!labels.has_authored_value() || labels.type_name() != Token("token[]")) {
    return std::nullopt;
  }
  const layer::Value value = labels.get();
  const auto* tokens = value.get<Tokens>();
  std::vector<std::string> found;
  if (tokens != nullptr) {
    for (const Token& token : *tokens) {
      found.push_back(token.str());
    }
  }
  return found.empty() && labels.time_samples().empty() ? std::nullopt : std::optional(found);
}

void add_upwards(stage::Prim prim, std::vector<stage::Prim>& to) {
  for (; prim && !prim.is_pseudo_root(); prim = prim.parent()) {
    to.push_back(prim);
  }
}

/// Where labels of a shape may stand.
std::vector<stage::Prim> label_sources(const stage::Prim& shape) {
  std::vector<stage::Prim> found;
  add_upwards(shape, found);
  const std::vector<stage::Prim> materials = bound_materials(shape);
  if (!materials.empty()) {
    add_upwards(materials.front(), found);
  }
  for (const stage::Prim& child : shape.children()) {
    if (child.is_a(Token("GeomSubset"))) {
      found.push_back(child);
    }
  }
  return found;
}

bool is_labelled(const stage::Prim& shape) {
  for (const stage::Prim& source : label_sources(shape)) {
    for (const std::string& instance : api_instances(source, kLabels)) {
      if (labels_of(source, instance)) {
        return true;
      }
    }
  }
  return false;
}

bool is_code_of_wikidata(const std::string& text) {
  return text.size() > 1 && text[0] == 'Q' &&
         std::all_of(text.begin() + 1, text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

}  // namespace

void judge_sl_001(const Judged& judged, Report& report) {
  for (const stage::Prim& prim : judged.stage.with_shared) {
    if (is_below_root(judged, prim) && is_rendered(prim) && !is_labelled(prim)) {
      report.at(prim, "nothing says what the shape is", "apply SemanticsLabelsAPI above it");
    }
  }
}

void judge_sl_002(const Judged& judged, Report& report) {
  for (const stage::Prim& prim : judged.stage.with_shared) {
    if (!is_below_root(judged, prim)) {
      continue;
    }
    for (const std::string& old : api_instances(prim, "SemanticsAPI")) {
      const std::string start = "semantic:" + old + ":params:";
      const std::string taxonomy = text(prim, start + "semanticType");
      const std::string value = text(prim, start + "semanticData");
      const auto labels = labels_of(prim, taxonomy);
      const bool kept = labels &&
                        std::find(labels->begin(), labels->end(), value) != labels->end() &&
                        has_api(prim, std::string(kLabels) + ":" + taxonomy);
      if (!taxonomy.empty() && !value.empty() && !kept) {
        report.at(prim, "the label " + value + " is in the old schema SemanticsAPI alone",
                  "author it in SemanticsLabelsAPI:" + taxonomy);
      }
    }
  }
}

void judge_sl_003(const Judged& judged, Report& report) {
  std::set<Path> told;
  for (const stage::Prim& prim : judged.stage.with_shared) {
    if (!is_below_root(judged, prim) || !is_rendered(prim)) {
      continue;
    }
    for (const stage::Prim& source : label_sources(prim)) {
      for (const std::string& instance : api_instances(source, kLabels)) {
        if (!labels_of(source, instance) && told.insert(source.path()).second) {
          report.at(source, label_name(instance) + " holds no labels", "author an array of tokens");
        }
      }
    }
  }
}

void judge_sl_mat_001(const Judged& judged, Report& report) {
  for (const stage::Prim& prim : judged.stage.with_shared) {
    if (is_below_root(judged, prim) && prim.is_a(Token("Material")) &&
        !(has_api(prim, std::string(kLabels) + ":material") && labels_of(prim, "material"))) {
      report.at(prim, "the material has no label",
                "apply SemanticsLabelsAPI:material with a label");
    }
  }
}

void judge_sl_time_001(const Judged& judged, Report& report) {
  for (const stage::Prim& prim : judged.stage.with_shared) {
    for (const std::string& instance : api_instances(prim, kLabels)) {
      const Token name(label_name(instance));
      if (is_below_root(judged, prim) && !prim.attribute(name).time_samples().empty()) {
        report.at(prim, name, "the labels change with time", "author one value");
      }
    }
  }
}

void judge_sl_qcode_001(const Judged& judged, Report& report) {
  static const std::string kInstance = "wikidata_qcode";
  for (const stage::Prim& prim : judged.stage.with_shared) {
    if (!is_below_root(judged, prim) || !has_api(prim, std::string(kLabels) + ":" + kInstance)) {
      continue;
    }
    const auto labels = labels_of(prim, kInstance);
    for (const std::string& label : labels.value_or(std::vector<std::string>())) {
      if (!is_code_of_wikidata(label)) {
        report.at(prim, Token(label_name(kInstance)), label + " is no Q with digits",
                  "author the code that Wikidata has");
      }
    }
  }
}

namespace {

const std::string kSeen = "omni:simready:nonvisual:";

/// Which values an attribute of a material may have, and of which type it is.
struct SeenAs {
  const char* type;
  bool needed = false;
  std::set<std::string> values{};
};

const SeenAs& seen_as(const std::string& name) {
  static const std::map<std::string, SeenAs> kKinds{
      {"base",
       {"token",
        true,
        {"aluminum",
         "steel",
         "oxidized_steel",
         "iron",
         "oxidized_iron",
         "silver",
         "brass",
         "bronze",
         "oxidized_Bronze_Patina",
         "tin",
         "plastic",
         "fiberglass",
         "carbon_fiber",
         "vinyl",
         "plexiglass",
         "pvc",
         "nylon",
         "polyester",
         "clear_glass",
         "frosted_glass",
         "one_way_mirror",
         "mirror",
         "ceramic_glass",
         "asphalt",
         "concrete",
         "leaf_grass",
         "dead_leaf_grass",
         "rubber",
         "wood",
         "bark",
         "cardboard",
         "paper",
         "fabric",
         "skin",
         "fur_hair",
         "leather",
         "marble",
         "brick",
         "stone",
         "gravel",
         "dirt",
         "mud",
         "water",
         "salt_water",
         "snow",
         "ice",
         "calibration_lambertian"}}},
      {"coating", {"token", false, {"none", "paint", "clearcoat", "paint_clearcoat"}}},
      {"attributes",
       {"token[]",
        false,
        {"none", "emissive", "retroreflective", "single_sided", "visually_transparent"}}}};
  return kKinds.at(name);
}

std::vector<stage::Prim> seen_materials(const Judged& judged) {
  std::vector<stage::Prim> found;
  std::set<Path> known;
  for (const stage::Prim& prim : judged.stage.with_shared) {
    if (!is_below_root(judged, prim) || !is_rendered(prim)) {
      continue;
    }
    for (const stage::Prim& material : bound_materials(prim)) {
      if (known.insert(material.path()).second) {
        found.push_back(material);
      }
    }
  }
  return found;
}

void judge_seen(const Judged& judged, Report& report, const std::string& name) {
  const SeenAs& wanted = seen_as(name);
  for (const stage::Prim& material : seen_materials(judged)) {
    const stage::Attribute attribute = material.attribute(Token(kSeen + name));
    const layer::Value value = attribute.get();
    bool good = attribute.is_authored() && attribute.type_name() == Token(wanted.type) &&
                (!value.empty() || !wanted.needed);
    if (const Token* token = value.get<Token>()) {
      good = good && wanted.values.contains(token->str());
    } else if (const auto* tokens = value.get<Tokens>()) {
      good = good && std::all_of(tokens->begin(), tokens->end(), [&](const Token& one) {
               return wanted.values.contains(one.str());
             });
    }
    if (!good) {
      report.at(material, kSeen + name + " does not say what lidar and radar see",
                "author one of its values");
    }
  }
}

}  // namespace

void judge_nvm_001(const Judged& judged, Report& report) {
  judge_seen(judged, report, "attributes");
}
void judge_nvm_002(const Judged& judged, Report& report) { judge_seen(judged, report, "base"); }
void judge_nvm_003(const Judged& judged, Report& report) { judge_seen(judged, report, "coating"); }

void judge_nvm_004(const Judged& judged, Report& report) {
  std::set<Path> bound;
  for (const stage::Prim& prim : judged.stage.plain) {
    if (is_below_root(judged, prim) && is_rendered(prim)) {
      for (const stage::Prim& material : bound_materials(prim)) {
        bound.insert(material.path());
      }
    }
  }
  for (const stage::Prim& prim : judged.stage.plain) {
    if (!is_below_root(judged, prim) || !prim.is_a(Token("Material")) ||
        bound.contains(prim.path())) {
      continue;
    }
    for (const char* name : {"base", "coating", "attributes"}) {
      if (prim.attribute(Token(kSeen + name)).is_authored()) {
        report.at(prim, "the material says what lidar sees, and nothing is made of it",
                  "bind it, or remove it");
        break;
      }
    }
  }
}

void judge_nvm_006(const Judged& judged, Report& report) {
  for (const stage::Prim& material : seen_materials(judged)) {
    for (const char* name : {"base", "coating", "attributes"}) {
      if (!material.attribute(Token(kSeen + name)).time_samples().empty()) {
        report.at(material, Token(kSeen + name), "what lidar sees changes with time",
                  "author one value");
      }
    }
  }
}

}  // namespace tenon::check::simready
