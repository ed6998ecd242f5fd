// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Requirements on robots as Isaac Sim takes them, on the files that they are made of, and on the
// variants of runtimes. Which layer says something is told by its file's name alone: one whose name
// ends with physics.usd, physics.usda or physics.usdc is a layer of physics.
#include <algorithm>
#include <filesystem>
#include <set>

#include "tenon/check/simready/judges.h"
#include "tenon/check/simready/reading.h"
#include "tenon/compose/layer_stack.h"
#include "tenon/layer/field_values.h"
#include "tenon/layer/fields.h"

namespace tenon::check::simready {
namespace {

namespace fs = std::filesystem;
namespace fields = layer::fields;

bool is_physics_layer(const std::string& file) {
  for (const char* ending : {"physics.usd", "physics.usda", "physics.usdc"}) {
    if (file.ends_with(ending)) {
      return true;
    }
  }
  return false;
}

std::string name_of(const layer::Layer& layer) {
  return fs::path(layer.identifier()).filename().string();
}

constexpr const char* kLinks = "isaac:physics:robotLinks";
constexpr const char* kJoints = "isaac:physics:robotJoints";
constexpr const char* kType = "isaac:robotType";

/// Whether the default prim is there; reports that it is not.
bool has_root(const Judged& judged, Report& report) {
  if (!judged.stage.root) {
    report.at_root(judged, "there is no default prim", "author defaultPrim");
  }
  return judged.stage.root.is_valid();
}

bool is_known_type(const std::string& type) {
  static const std::set<std::string> kTypes{
      "End Effector", "Manipulator",         "Humanoid", "Wheeled", "Holonomic",
      "Quadruped",    "Mobile Manipulators", "Aerial"};
  return kTypes.contains(type);
}

/// The spec of the default prim in the root layer; null where it has none.
const layer::Spec* root_spec(const Judged& judged, Path& path) {
  path = judged.stage.root ? judged.stage.root.path() : Path();
  return judged.stage.root ? judged.stage.stage->root_layer().find(path) : nullptr;
}

bool has_set(const stage::Prim& prim, const std::string& set) {
  const std::vector<std::string> names = prim.variant_set_names();
  return std::find(names.begin(), names.end(), set) != names.end();
}

}  // namespace

void judge_rc_005(const Judged& judged, Report& report) {
  for (const stage::Prim& prim : judged.stage.plain) {
    for (const Token& name : prim.authored_property_names()) {
      if (!name.str().starts_with("physics:") || prim.is_relationship(name) ||
          (name == "physics:collisionEnabled" && has_api(prim, "PhysicsCollisionAPI"))) {
        continue;
      }
      for (const stage::SpecSite& site : prim.attribute(name).spec_stack()) {
        if (!is_physics_layer(site.layer->identifier())) {
          report.at(prim, name, name.str() + " is in " + name_of(*site.layer),
                    "author it in physics.usda");
          break;
        }
      }
    }
  }
}

void judge_rc_006(const Judged& judged, Report& report) {
  for (const stage::Prim& prim : judged.stage.plain) {
    for (const compose::StackedLayer& stacked : judged.stage.stage->layer_stack().layers) {
      const layer::Spec* spec = stacked.layer->find(prim.path());
      const auto* apis =
          spec == nullptr ? nullptr : spec->get<layer::ListOp<Token>>(fields::apiSchemas);
      if (apis == nullptr || is_physics_layer(stacked.layer->identifier())) {
        continue;
      }
      std::vector<Token> applied;
      apis->apply_to(applied);
      for (const Token& api : applied) {
        if (api.str().starts_with("Physx") || api.str().starts_with("Physics")) {
          report.at(prim, api.str() + " is applied in " + name_of(*stacked.layer),
                    "apply it in physics.usda");
        }
      }
    }
  }
}

void judge_rc_007(const Judged& judged, Report& report) {
  if (!has_root(judged, report)) {
    return;
  }
  const stage::Prim root = judged.stage.root;
  if (!has_api(root, "IsaacRobotAPI")) {
    report.at(root, "the default prim has no IsaacRobotAPI", "apply it");
  }
  for (const char* name : {kLinks, kJoints}) {
    if (targets(root, name).empty()) {
      report.at(root, std::string(name) + " names nothing", "name the robot's parts in it");
    }
  }
}

void judge_rc_008(const Judged& judged, Report& report) {
  if (!has_root(judged, report)) {
    return;
  }
  const std::string type = text(judged.stage.root, kType);
  if (!is_known_type(type)) {
    report.at(judged.stage.root, Token(kType), "the kind of robot is \"" + type + "\"",
              "author End Effector, Manipulator, Humanoid, Wheeled, Holonomic, Quadruped, Mobile "
              "Manipulators or Aerial");
  }
}

void judge_rc_009(const Judged& judged, Report& report) {
  if (!has_root(judged, report)) {
    return;
  }
  const stage::Prim root = judged.stage.root;
  const stage::Prim joint = target_prim(root, kJoints);
  if (!joint || !is_joint(joint)) {
    report.at(root, std::string(kJoints) + " does not begin with a joint",
              "name the joint that the root link is on first");
    return;
  }
  const std::string type = text(root, kType);
  const auto is_free = [&](const char* name) {
    const stage::Prim body = target_prim(joint, name);
    return body && has_api(body, "PhysicsRigidBodyAPI");
  };
  const bool pinned = !is_free("physics:body0") || !is_free("physics:body1");
  const bool to_pin = type == "Manipulator" || type == "End Effector";
  if (type.empty() || type == "Default") {
    report.at(root, Token(kType), "the kind of robot is not said", "author isaac:robotType");
  } else if (pinned != to_pin) {
    report.at(root,
              "the first joint, " + named(joint.path(), RelatedRole::Joint) +
                  (pinned ? ", holds a robot in the world that walks or drives"
                          : ", does not hold a robot that stands still"),
              pinned ? "convert it with a free base" : "hold its base by a fixed joint");
  }
}

void judge_rm_001(const Judged& judged, Report& report) {
  for (const stage::Prim& prim : judged.stage.with_shared) {
    if (!prim.is_a(Token("Material"))) {
      continue;
    }
    for (stage::Prim at = prim.parent(); at && !at.is_pseudo_root(); at = at.parent()) {
      if (at.is_a(Token("Material"))) {
        report.at(prim, "a material below another one", "put them side by side");
        break;
      }
    }
  }
}

void judge_rm_002(const Judged& judged, Report& report) {
  const stage::Prim root = judged.stage.root;
  if (!root || !root.child(Token("Looks"))) {
    return;
  }
  const Path looks = root.path().child(Token("Looks"));
  std::vector<stage::Prim> pending{root};
  while (!pending.empty()) {
    const stage::Prim at = pending.back();
    pending.pop_back();
    if (at.is_a(Token("Material")) && !(at.path().parent() == looks)) {
      report.at(at, "a material that is not in Looks", "move it there");
    }
    for (const stage::Prim& child : at.children()) {
      if (child.is_active() && child.is_loaded() && child.is_defined() && !child.is_abstract() &&
          !child.has_authored_metadata(fields::references) &&
          !child.has_authored_metadata(fields::payload) && !child.is_instance()) {
        pending.push_back(child);
      }
    }
  }
}

void judge_ros_001(const Judged& judged, Report& report) {
  const auto& prims = judged.stage.every;
  const bool found = std::any_of(prims.begin(), prims.end(), [](const stage::Prim& prim) {
    return text(prim, "node:type").starts_with("isaacsim.ros2.bridge.");
  });
  if (!found) {
    report.at_root(judged, "no OmniGraph node speaks to ROS 2",
                   "only an asset that is to publish by itself needs one");
  }
}

void judge_isa_001(const Judged& judged, Report& report) {
  if (!has_root(judged, report)) {
    return;
  }
  const stage::Prim root = judged.stage.root;
  const layer::Value kind = root.metadata(fields::kind);
  const Token* token = kind.get<Token>();
  if (token == nullptr || !(*token == "component")) {
    report.at(root, "the default prim's kind is not component", "author it");
  }
  const fs::path payloads = fs::path(judged.asset.file).parent_path() / "payloads";
  if (!judged.asset.files.exists(payloads.string())) {
    report.at_root(judged, "there is no folder payloads", "tenon structure ASSET FOLDER makes it");
  } else {
    for (const char* name : {"geometries.usd", "base.usda", "instances.usda", "materials.usda"}) {
      if (!judged.asset.files.exists((payloads / name).string())) {
        report.at_root(judged, std::string("there is no file payloads/") + name,
                       "tenon structure ASSET FOLDER makes it");
      }
    }
  }
  Path path;
  const layer::Spec* spec = root_spec(judged, path);
  const auto* references =
      spec == nullptr ? nullptr : spec->get<layer::ListOp<layer::Reference>>(fields::references);
  bool based = false;
  if (references != nullptr) {
    for (const auto* items : {&references->explicit_items, &references->prepended,
                              &references->appended, &references->added}) {
      for (const layer::Reference& item : *items) {
        based = based || item.asset_path == "./payloads/base.usda";
      }
    }
  }
  if (!based) {
    report.at(root, "the default prim does not reference ./payloads/base.usda",
              "tenon structure ASSET FOLDER makes it");
  }
  for (const stage::Prim& prim : judged.stage.plain) {
    const bool hidden_scope =
        prim.type_name() == "Scope" && (prim.name() == "Meshes" || prim.name() == "Visuals");
    if (hidden_scope && text(prim, "visibility") != "invisible") {
      report.at(prim, "the scope is visible", "author visibility = \"invisible\"");
    }
  }
}

namespace {

void judge_set(const Judged& judged, Report& report, const std::string& set) {
  if (!has_root(judged, report)) {
    return;
  }
  const stage::Prim root = judged.stage.root;
  if (!has_set(root, set)) {
    report.at(root, "the default prim has no variant set " + set,
              "one with Enabled and Disabled, which is selected");
    return;
  }
  const std::vector<std::string> variants = root.variant_names(set);
  for (const char* wanted : {"Disabled", "Enabled"}) {
    if (std::find(variants.begin(), variants.end(), wanted) == variants.end()) {
      report.at(root, "the variant set " + set + " has no " + wanted, "add it");
    }
  }
  Path path;
  const layer::Spec* spec = root_spec(judged, path);
  const auto* selections =
      spec == nullptr ? nullptr : spec->get<layer::VariantSelections>(fields::variantSelection);
  const auto selected =
      selections == nullptr ? decltype(selections->items.begin()){} : selections->items.find(set);
  if (selections == nullptr || selected == selections->items.end() ||
      selected->second != "Disabled") {
    report.at(root, "the root layer does not select Disabled of the variant set " + set,
              "select it");
  }
}

/// Asset paths of the payloads of a variant's spec.
std::vector<std::string> payloads_of(const layer::Spec& spec) {
  std::vector<std::string> found;
  if (const auto* list = spec.get<layer::ListOp<layer::Payload>>(fields::payload)) {
    for (const auto* items :
         {&list->explicit_items, &list->prepended, &list->appended, &list->added, &list->ordered}) {
      for (const layer::Payload& item : *items) {
        if (!item.asset_path.empty()) {
          found.push_back(item.asset_path);
        }
      }
    }
  } else if (const auto* one = spec.get<layer::Payload>(fields::payload)) {
    if (!one->asset_path.empty()) {
      found.push_back(one->asset_path);
    }
  }
  return found;
}

const layer::Spec* variant_spec(const Judged& judged, const std::string& set, const char* variant) {
  Path path;
  const layer::Spec* spec = root_spec(judged, path);
  return spec == nullptr ? nullptr
                         : judged.stage.stage->root_layer().find(
                               path.variant_selection(Token(set), Token(variant)));
}

void judge_payload(const Judged& judged, Report& report, const std::string& set,
                   const std::string& stem) {
  const layer::Spec* spec = variant_spec(judged, set, "Enabled");
  if (spec == nullptr) {
    return;
  }
  const std::vector<std::string> paths = payloads_of(*spec);
  bool good = !paths.empty();
  for (const std::string& path : paths) {
    const fs::path file(path);
    const std::string ending = file.extension().string();
    good = good && (path.starts_with("./") || path.starts_with("../")) &&
           path.find("runnables/physics/") != std::string::npos && file.stem() == stem &&
           (ending == ".usd" || ending == ".usda" || ending == ".usdc");
  }
  if (!good) {
    report.at(judged.stage.root,
              "the variant Enabled of " + set + " does not have runnables/physics/" + stem +
                  ".usda as its payload",
              "prepend payload = @./runnables/physics/" + stem + ".usda@");
  }
}

const layer::Dictionary* entry(const layer::Dictionary* from, const char* key) {
  const layer::Value* value = from == nullptr ? nullptr : from->find(key);
  return value == nullptr ? nullptr : value->get<layer::Dictionary>();
}

std::string said(const layer::Dictionary& from, const char* key) {
  const layer::Value* value = from.find(key);
  const Token* token = value == nullptr ? nullptr : value->get<Token>();
  return token != nullptr   ? token->str()
         : value == nullptr ? std::string()
                            : value->get_or(std::string());
}

void judge_entry(const Judged& judged, Report& report, const std::string& set) {
  if (!judged.stage.root || !has_set(judged.stage.root, set)) {
    return;
  }
  const auto* data =
      judged.stage.stage->root_layer().root().get<layer::Dictionary>(fields::customLayerData);
  const layer::Dictionary* found =
      entry(entry(entry(entry(data, "SimReady_Metadata"), "Variants"), "Physics"), set.c_str());
  const std::string prim_path = found == nullptr ? "" : said(*found, "prim");
  const stage::Prim prim =
      prim_path.empty() ? stage::Prim() : judged.stage.stage->prim(Path::from(prim_path));
  if (found == nullptr || said(*found, "variantSetName") != set ||
      said(*found, "activateOption").empty() || !prim || !has_set(prim, set)) {
    report.at_root(judged,
                   "SimReady_Metadata.Variants.Physics does not tell of the variant set " + set,
                   "author prim, variantSetName and activateOption there");
  }
}

}  // namespace

void judge_rv_001(const Judged& judged, Report& report) { judge_set(judged, report, "PhysX"); }
void judge_rv_002(const Judged& judged, Report& report) {
  judge_payload(judged, report, "PhysX", "physx");
}
void judge_rv_003(const Judged& judged, Report& report) { judge_entry(judged, report, "PhysX"); }
void judge_rv_004(const Judged& judged, Report& report) { judge_set(judged, report, "Newton"); }
void judge_rv_005(const Judged& judged, Report& report) {
  judge_payload(judged, report, "Newton", "newton");
}
void judge_rv_006(const Judged& judged, Report& report) { judge_entry(judged, report, "Newton"); }
void judge_rv_007(const Judged& judged, Report& report) { judge_set(judged, report, "MuJoCo"); }
void judge_rv_008(const Judged& judged, Report& report) {
  judge_payload(judged, report, "MuJoCo", "mujoco");
}
void judge_rv_009(const Judged& judged, Report& report) { judge_entry(judged, report, "MuJoCo"); }

void judge_rv_010(const Judged& judged, Report& report) {
  for (const std::string& set : runtimes()) {
    for (const char* variant : {"Enabled", "Disabled"}) {
      const layer::Spec* spec = variant_spec(judged, set, variant);
      if (spec == nullptr) {
        continue;
      }
      bool more = false;
      for (const Token& field :
           {fields::primChildren, fields::properties, fields::variantSetChildren}) {
        more = more || !layer::Layer::children(*spec, field).empty();
      }
      for (const Token& field : {fields::references, fields::inheritPaths, fields::specializes}) {
        more = more || spec->has(field);
      }
      const bool empty = std::string_view(variant) == "Disabled";
      if (more || (empty && !payloads_of(*spec).empty())) {
        report.at(judged.stage.root,
                  "the variant " + std::string(variant) + " of " + set +
                      (empty ? " is not empty" : " holds more than its payload"),
                  "move what it says into runnables/physics");
      }
    }
  }
}

namespace {

/// "PhysX", "Newton", "MuJoCo" by the start of a name; empty for what all share.
std::string owner_of(const std::string& name, bool schema) {
  if (name.starts_with(schema ? "Physx" : "physx")) {
    return "PhysX";
  }
  if (name.starts_with(schema ? "Newton" : "newton:")) {
    return "Newton";
  }
  return name.starts_with(schema ? "Mjc" : "mjc:") ? "MuJoCo" : "";
}

bool is_shared_with_mujoco(const std::string& name) {
  return name == "NewtonCollisionAPI" || name == "newton:contactGap" ||
         name == "newton:contactMargin";
}

/// "" where a prim holds nothing of other runtimes than `wanted`.
std::string foreign_to(const stage::Prim& prim, const std::string& wanted) {
  const auto is_foreign = [&](const std::string& name, bool schema) {
    const std::string owner = owner_of(name, schema);
    return !owner.empty() && owner != wanted &&
           !(wanted == "MuJoCo" && is_shared_with_mujoco(name));
  };
  for (const Token& api : prim.authored_api_schemas()) {
    const std::string name = api.str().substr(0, api.str().find(':'));
    if (is_foreign(name, true)) {
      return name;
    }
  }
  for (const Token& name : prim.authored_property_names()) {
    if (is_foreign(name.str(), false)) {
      return name.str();
    }
  }
  static const std::string kApproximation = "physics:approximation";
  if (is_authored(prim, kApproximation)) {
    const std::string value = text(prim, kApproximation);
    const bool hull = wanted == "MuJoCo" && has_api(prim, "MjcCollisionAPI");
    if ((wanted != "PhysX" && wanted != "MuJoCo" && value == "sdf") ||
        (hull && value != "convexHull")) {
      return kApproximation;
    }
  }
  return "";
}

}  // namespace

void judge_rv_011(const Judged& judged, Report& report) {
  const stage::Prim root = judged.stage.root;
  std::vector<std::string> selections{""};
  for (const std::string& set : runtimes()) {
    if (root && has_set(root, set)) {
      selections.push_back(set);
    }
  }
  if (selections.size() == 1) {
    return;
  }
  for (const std::string& runtime : selections) {
    const JudgedStage* stage = judged.asset.stage_of(runtime);
    if (stage == nullptr) {
      continue;
    }
    for (const stage::Prim& prim : stage->below_root) {
      const std::string found = foreign_to(prim, runtime);
      if (!found.empty()) {
        report.at(prim,
                  found + " is in the composition of " +
                      (runtime.empty() ? std::string("no runtime") : runtime),
                  "move it into the payload of its own runtime");
      }
    }
  }
}

}  // namespace tenon::check::simready
