// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Sections 1.1 and 1.2: units, transforms, layers and arcs. As the checker does it, all prims are
// looked at, those of every specifier and state, and no instance is entered; of arcs what their
// prims say, of files the layers that the stage opened.
#include <algorithm>
#include <set>
#include <string>

#include "tenon/base/text/counted.h"
#include "tenon/check/rep0158/judges.h"
#include "tenon/layer/field_values.h"
#include "tenon/layer/fields.h"
#include "tenon/layer/layer.h"

namespace tenon::check::rep0158 {
namespace {

namespace fields = layer::fields;

constexpr std::size_t kHeavy = 50;  ///< points or faces that a text layer may have

void judge_unit(const Judged& judged, Report& report, const char* name) {
  const layer::Value value = judged.stage.stage->metadata(Token(name));
  if (value.get_or<double>(0) != 1) {
    report.at_root(judged, std::string(name) + " is " + digits(value.get_or<double>(0)),
                   std::string("author ") + name + " = 1, and scale what counts in it");
  }
}

bool is_body_or_joint(const stage::Prim& prim) {
  return has_stock_api(prim, "PhysicsRigidBodyAPI") || has_joint_type(prim);
}

bool has_part(const std::string& name, const char* part) {
  return name.find(part) != std::string::npos;
}

/// A kind that is "component".
bool is_component(const stage::Prim& prim) {
  const layer::Value kind = prim.metadata(fields::kind);
  const Token* token = kind.get<Token>();
  return token != nullptr && *token == "component";
}

/// The prim and those below it that are active, loaded, defined and not abstract.
std::vector<stage::Prim> counted_below(const stage::Prim& root) {
  std::vector<stage::Prim> found;
  std::vector<stage::Prim> pending{root};
  while (!pending.empty()) {
    const stage::Prim at = pending.back();
    pending.pop_back();
    if (!at.is_active() || !at.is_loaded() || !at.is_defined() || at.is_abstract()) {
      continue;
    }
    found.push_back(at);
    if (!at.is_instance()) {
      const std::vector<stage::Prim> children = at.children();
      pending.insert(pending.end(), children.begin(), children.end());
    }
  }
  return found;
}

bool applies_schemas(const layer::Spec& spec) {
  const auto* list = spec.get<layer::ListOp<Token>>(fields::apiSchemas);
  return list != nullptr && (!list->explicit_items.empty() || !list->prepended.empty() ||
                             !list->appended.empty() || !list->added.empty());
}

bool is_heavy(const layer::Layer& layer, Path prim) {
  for (const char* name : {"points", "faceVertexCounts"}) {
    const layer::Spec* property = layer.find(prim.property(Token(name)));
    const layer::Value* value =
        property == nullptr ? nullptr : property->find(fields::default_value);
    if (value == nullptr) {
      continue;
    }
    const auto* points = value->get<layer::Array<Vec3f>>();
    const auto* counts = value->get<layer::Array<std::int32_t>>();
    if ((points != nullptr && points->size() > kHeavy) ||
        (counts != nullptr && counts->size() > kHeavy)) {
      return true;
    }
  }
  return false;
}

struct LayerFacts {
  bool has_schemas = false;
  bool has_heavy = false;
};

/// Of its prims; what variants hold is not looked at.
LayerFacts facts_of_layer(const layer::Layer& layer) {
  LayerFacts facts;
  std::vector<Path> pending{Path::absolute_root()};
  while (!pending.empty()) {
    const Path at = pending.back();
    pending.pop_back();
    if (const layer::Spec* spec = layer.find(at)) {
      facts.has_schemas = facts.has_schemas || applies_schemas(*spec);
      facts.has_heavy = facts.has_heavy || is_heavy(layer, at);
    }
    for (const Token& child : layer.children(at, fields::primChildren)) {
      pending.push_back(at.child(child));
    }
  }
  return facts;
}

/// Visits the layers of the stage that are files with this ending.
template <class Visit>
void each_layer(const Judged& judged, const char* ending, const Visit& visit) {
  for (const layer::LayerPtr& layer : judged.stage.stage->used_layers()) {
    if (layer->identifier().ends_with(ending)) {
      visit(*layer);
    }
  }
}

std::string file_name(const std::string& path) { return path.substr(path.rfind('/') + 1); }

}  // namespace

void judge_1_1_1(const Judged& judged, Report& report) {
  judge_unit(judged, report, "metersPerUnit");
}

void judge_1_1_2(const Judged& judged, Report& report) {
  judge_unit(judged, report, "kilogramsPerUnit");
}

void judge_1_1_3(const Judged& judged, Report& report) {
  const layer::Value axis = judged.stage.stage->metadata(Token("upAxis"));
  const Token* token = axis.get<Token>();
  if (token == nullptr || !(*token == "Z")) {
    report.at_root(judged, "upAxis is not Z", "author upAxis = \"Z\", and turn the default prim");
  }
}

void judge_1_1_4(const Judged& judged, Report& report) {
  const std::vector<std::string> ops =
      judged.stage.root ? xform_ops(judged.stage.root) : std::vector<std::string>();
  for (const std::string& op : ops) {
    if (has_part(op, "rotate") || has_part(op, "orient")) {
      report.at(judged.stage.root, Token("xformOpOrder"), "the default prim has " + op,
                "turn what is below it");
    }
  }
}

void judge_1_1_5(const Judged& judged, Report& report) {
  const double rate = judged.stage.stage->time_codes_per_second();
  if (rate != 1) {
    report.at_root(judged, "timeCodesPerSecond is " + digits(rate),
                   "author timeCodesPerSecond = 1, and the times of samples in seconds");
  }
}

void judge_1_1_6(const Judged& judged, Report& report) {
  for (const stage::Prim& prim : judged.stage.every) {
    const std::vector<std::string> ops =
        is_body_or_joint(prim) ? xform_ops(prim) : std::vector<std::string>();
    const auto count = [&](const char* kind) {
      return std::count_if(ops.begin(), ops.end(),
                           [&](const std::string& op) { return has_part(op, kind); });
    };
    if (!ops.empty() && (ops.size() != 2 || count("xformop:translate") != 1 ||
                         count("xformop:orient") != 1 || count("xformop:transform") != 0)) {
      report.at(prim, Token("xformOpOrder"),
                "the body has " + counted(ops.size(), "xformOp") +
                    " where one xformOp:translate and one xformOp:orient are asked for",
                "author these two");
    }
  }
}

void judge_1_1_7(const Judged& judged, Report& report) {
  for (const stage::Prim& prim : judged.stage.every) {
    for (const std::string& op :
         is_body_or_joint(prim) ? xform_op_names(prim) : std::vector<std::string>()) {
      if (!has_part(lower_case(op), "xformop:scale")) {
        continue;
      }
      const Token name(op.starts_with("!invert!") ? op.substr(8) : op);
      const layer::Value value = prim.attribute(name).get();
      const Vec3d scale = value.holds<Vec3f>()   ? to_double(*value.get<Vec3f>())
                          : value.holds<Vec3d>() ? *value.get<Vec3d>()
                                                 : Vec3d{{0, 0, 0}};
      if (!value.empty() && !(scale == Vec3d{{1, 1, 1}})) {
        report.at(prim, name, "the body is scaled", "scale what is below it");
      }
    }
  }
}

void judge_1_2_1(const Judged& judged, Report& report) {
  if (!judged.stage.root) {
    report.at_root(judged, "there is no default prim", "author defaultPrim");
  }
}

namespace {

void judge_asset_info(const Judged& judged, Report& report, const char* key) {
  if (!judged.stage.root) {
    return;
  }
  const layer::Value value = judged.stage.root.metadata(fields::assetInfo);
  const auto* info = value.get<layer::Dictionary>();
  if (info == nullptr || !info->items.contains(key)) {
    report.at(judged.stage.root, std::string("assetInfo has no ") + key,
              std::string("author assetInfo = { string ") + key + " = \"...\" }");
  }
}

}  // namespace

void judge_1_2_2(const Judged& judged, Report& report) {
  judge_asset_info(judged, report, "identifier");
}

void judge_1_2_3(const Judged& judged, Report& report) {
  judge_asset_info(judged, report, "version");
}

void judge_1_2_4(const Judged& judged, Report& report) {
  std::set<std::string> used;
  for (const layer::LayerPtr& layer : judged.stage.stage->used_layers()) {
    used.insert(layer->identifier());
  }
  std::set<std::string> told;
  for (const simready::NamedFile& file : judged.asset.named) {
    const bool absolute =
        file.authored.starts_with('/') || lower_case(file.authored).starts_with("omniverse://");
    if (file.is_layer && absolute && used.contains(file.layer) &&
        told.insert(file.layer + "\n" + file.authored).second) {
      report.at_root(judged, file_name(file.layer) + " names " + file.authored,
                     "name it from the layer's folder on, as in ./base.usda");
    }
  }
}

void judge_1_2_6(const Judged& judged, Report& report) {
  for (const stage::Prim& outer : judged.stage.every) {
    for (const stage::Prim& prim :
         is_component(outer) ? counted_below(outer) : std::vector<stage::Prim>()) {
      if (!(prim == outer) && is_component(prim)) {
        report.at(
            prim,
            "the component is inside of the component " + named(outer.path(), RelatedRole::Prim),
            "author kind = \"subcomponent\"");
      }
    }
  }
}

void judge_1_2_7(const Judged& judged, Report& report) {
  for (const stage::Prim& prim : judged.stage.every) {
    for (const std::string& set : prim.variant_set_names()) {
      if (prim.variant_selection(set).empty()) {
        report.at(prim, "the variant set " + set + " has no selection",
                  "author one, as in `tenon variant ASSET " + set + "=NAME`");
      }
    }
  }
}

void judge_1_2_8(const Judged& judged, Report& report) {
  for (const stage::Prim& prim : judged.stage.every) {
    for (const auto& [field, word] : {std::pair{fields::inheritPaths, "inherits"},
                                      std::pair{fields::specializes, "specializes"}}) {
      if (prim.has_authored_metadata(field)) {
        report.at(prim, std::string("the prim ") + word + " another one",
                  "make sure that the asset brings that prim, or reference it");
      }
    }
  }
}

void judge_1_2_9(const Judged& judged, Report& report) {
  static const char* const kHints[] = {"prefabpath", "assetref", "assetpath", "spawnpath",
                                       "modelpath"};
  for (const stage::Prim& prim : judged.stage.every) {
    for (const Token& name : prim.authored_property_names()) {
      const std::string lower = lower_case(name.str());
      if (std::none_of(std::begin(kHints), std::end(kHints),
                       [&](const char* hint) { return has_part(lower, hint); })) {
        continue;
      }
      const stage::Attribute attribute = prim.attribute(name);
      if (attribute.is_authored() && attribute.is_custom() && attribute.type_name() == "string") {
        report.at(prim, name, "the string looks like an asset to load",
                  "reference the asset, or make it a payload");
      }
    }
  }
}

void judge_1_2_10(const Judged& judged, Report& report) {
  for (const stage::Prim& prim : judged.stage.every) {
    if (has_payload(prim) && is_kinematic_or_ros(prim)) {
      report.at(prim, "the payload is on a joint, a body or an interface of ROS",
                "make a payload of what is drawn below it");
    }
  }
}

void judge_1_2_11(const Judged& judged, Report& report) {
  for (const stage::Prim& prim : judged.stage.every) {
    if (!(prim.type_name() == "PointInstancer")) {
      continue;
    }
    for (const Path& target : prim.relationship("prototypes").targets()) {
      const stage::Prim prototype = judged.stage.stage->prim(target);
      const std::vector<stage::Prim> parts =
          prototype ? counted_below(prototype) : std::vector<stage::Prim>();
      if (std::any_of(parts.begin(), parts.end(), [](const stage::Prim& part) {
            return is_kinematic_or_ros(part) || has_stock_api(part, "PhysicsRigidBodyAPI") ||
                   names_api(part, "PhysicsArticulationRootAPI");
          })) {
        report.at(prim, Token("prototypes"),
                  "the prototype " + named(target, RelatedRole::Prim) +
                      " has joints, bodies or interfaces of ROS",
                  "let the simulator copy it");
      }
    }
  }
}

void judge_1_2_12(const Judged& judged, Report& report) {
  each_layer(judged, ".usdc", [&](const layer::Layer& layer) {
    if (facts_of_layer(layer).has_schemas) {
      report.at_root(judged, file_name(layer.identifier()) + " is binary and applies API schemas",
                     "write it as .usda, with `tenon cat FILE -o FILE.usda`");
    }
  });
}

void judge_1_2_13(const Judged& judged, Report& report) {
  each_layer(judged, ".usda", [&](const layer::Layer& layer) {
    if (facts_of_layer(layer).has_heavy) {
      report.at_root(judged, file_name(layer.identifier()) + " is text and has meshes",
                     "write it as .usdc, with `tenon cat FILE -o FILE.usdc`");
    }
  });
}

}  // namespace tenon::check::rep0158
