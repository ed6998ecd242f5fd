// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Requirements on materials: what is bound, which surfaces they have, inputs of shaders, colour
// spaces of textures. The nodes of UsdPreviewSurface are a table here; of MaterialX' nodes only the
// names of OpenPBR's inputs are known, so that types of others stay open.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>

#include "tenon/check/simready/judges.h"
#include "tenon/check/simready/reading.h"
#include "tenon/check/simready/shading.h"
#include "tenon/layer/field_values.h"
#include "tenon/layer/fields.h"
#include "tenon/layer/type_names.h"
#include "tenon/physics/attribute_values.h"
#include "tenon/stage/property_errors.h"

namespace tenon::check::simready {
namespace {

constexpr const char* kOpenPbr = "ND_open_pbr_surface_surfaceshader";

/// An input of a node: its type, whether it may be connected, which tokens it takes.
struct Input {
  const char* type;
  bool connects = true;
  std::set<std::string> tokens{};
};
using Node = std::map<std::string, Input>;

Node reader_node(const char* type) {
  return {{"fallback", {type}}, {"varname", {"string", false}}};
}

const std::map<std::string, Node>& preview_nodes() {
  static const std::set<std::string> kWraps{"black", "clamp", "repeat", "mirror", "useMetadata"};
  static const std::map<std::string, Node> kNodes{
      {"UsdPreviewSurface",
       {{"clearcoat", {"float"}},
        {"clearcoatRoughness", {"float"}},
        {"diffuseColor", {"color3f"}},
        {"displacement", {"float"}},
        {"emissiveColor", {"color3f"}},
        {"ior", {"float"}},
        {"metallic", {"float"}},
        {"normal", {"normal3f"}},
        {"occlusion", {"float"}},
        {"opacity", {"float"}},
        {"opacityMode", {"token", false, {"transparent", "presence"}}},
        {"opacityThreshold", {"float", false}},
        {"roughness", {"float"}},
        {"specularColor", {"color3f"}},
        {"useSpecularWorkflow", {"int", false}}}},
      {"UsdUVTexture",
       {{"bias", {"float4", false}},
        {"fallback", {"float4"}},
        {"file", {"asset", false}},
        {"scale", {"float4", false}},
        {"sourceColorSpace", {"token", false, {"raw", "sRGB", "auto"}}},
        {"st", {"float2"}},
        {"wrapS", {"token", false, kWraps}},
        {"wrapT", {"token", false, kWraps}}}},
      {"UsdTransform2d",
       {{"in", {"float2"}},
        {"rotation", {"float", false}},
        {"scale", {"float2", false}},
        {"translation", {"float2", false}}}},
      {"UsdPrimvarReader_float", reader_node("float")},
      {"UsdPrimvarReader_float2", reader_node("float2")},
      {"UsdPrimvarReader_float3", reader_node("float3")},
      {"UsdPrimvarReader_float4", reader_node("float4")},
      {"UsdPrimvarReader_int", reader_node("int")},
      {"UsdPrimvarReader_matrix", reader_node("matrix4d")},
      {"UsdPrimvarReader_normal", reader_node("normal3f")},
      {"UsdPrimvarReader_point", reader_node("point3f")},
      {"UsdPrimvarReader_string", reader_node("string")},
      {"UsdPrimvarReader_vector", reader_node("vector3f")}};
  return kNodes;
}

/// Types of the outputs of preview nodes; empty where no output has that name.
std::string output_type(const std::string& node, const std::string& output) {
  if (node == "UsdPreviewSurface") {
    return output == "surface" || output == "displacement" ? "token" : "";
  }
  if (node == "UsdUVTexture") {
    static const std::set<std::string> kChannels{"r", "g", "b", "a"};
    return output == "rgb" ? "float3" : kChannels.contains(output) ? "float" : "";
  }
  if (output != "result") {
    return "";
  }
  const auto found = preview_nodes().find(node);
  if (node == "UsdTransform2d" || found == preview_nodes().end()) {
    return "float2";
  }
  return found->second.at("fallback").type;
}

const Node* preview_node(const stage::Prim& shader) {
  const auto found = preview_nodes().find(text(shader, "info:id"));
  return found == preview_nodes().end() ? nullptr : &found->second;
}

bool is_material(const stage::Prim& prim) { return prim.is_a(Token("Material")); }

bool is_connected(const stage::Prim& material, const char* terminal) {
  const stage::Attribute output = material.attribute(Token(terminal));
  return output.is_authored() && !output.connections().empty();
}

bool is_connected_at_all(const stage::Prim& material) {
  return is_connected(material, kPreview) || is_connected(material, kMaterialX) ||
         is_connected(material, kMdl);
}

/// Prims of active content at and below a prim, what instances share included.
std::vector<stage::Prim> below(const stage::Prim& prim) {
  std::vector<stage::Prim> found;
  std::vector<stage::Prim> pending{prim};
  while (!pending.empty()) {
    const stage::Prim at = pending.back();
    pending.pop_back();
    found.push_back(at);
    for (const stage::Prim& child : at.children()) {
      if (child.is_active() && child.is_loaded() && child.is_defined() && !child.is_abstract()) {
        pending.push_back(child);
      }
    }
  }
  return found;
}

/// Materials of all rendered shapes, each once, without those for contacts alone.
std::vector<stage::Prim> rendered_materials(const Judged& judged) {
  std::vector<stage::Prim> found;
  std::set<Path> seen;
  for (const stage::Prim& prim : judged.stage.with_shared) {
    if (!is_rendered(prim)) {
      continue;
    }
    for (const stage::Prim& material : bound_materials(prim)) {
      if (!is_physics_only(material) && seen.insert(material.path()).second) {
        found.push_back(material);
      }
    }
  }
  return found;
}

/// An asset whose shapes are all shared or not drawn needs the terminal at one of its materials.
void judge_library(const Judged& judged, Report& report, const char* terminal) {
  const auto& prims = judged.stage.plain;
  if (std::any_of(prims.begin(), prims.end(), is_rendered)) {
    return;
  }
  bool any = false;
  bool connected = false;
  for (const stage::Prim& prim : prims) {
    if (prim.type_name() == "Material" && !is_physics_only(prim)) {
      any = true;
      connected = connected || is_connected(prim, terminal);
    }
  }
  if (any && !connected) {
    report.at_root(judged, std::string("no material connects ") + terminal, "connect it");
  }
}

void judge_surface(const Judged& judged, Report& report, const char* terminal, const char* fix) {
  judge_library(judged, report, terminal);
  for (const stage::Prim& material : rendered_materials(judged)) {
    if (!is_connected(material, terminal)) {
      report.at(material, std::string("the material does not connect ") + terminal, fix);
    }
  }
}

std::vector<double> numbers_in(const layer::Value& value) {
  std::vector<double> found;
  const auto take = [&](const auto* held) {
    if (held != nullptr) {
      for (const auto x : held->v) {
        found.push_back(static_cast<double>(x));
      }
    }
  };
  take(value.get<Vec2f>());
  take(value.get<Vec3f>());
  take(value.get<Vec4f>());
  take(value.get<Vec2d>());
  take(value.get<Vec3d>());
  take(value.get<Vec4d>());
  if (found.empty() && !value.holds<bool>()) {
    if (const auto number = physics::number_of(value)) {
      found.push_back(*number);
    }
  }
  return found;
}

/// Where a connection leads to nothing; empty where all lead somewhere.
std::string dangling(const stage::Prim& prim, const stage::Attribute& attribute) {
  for (const Path path : attribute.connections()) {
    const stage::Prim source = prim.prim_at(path.prim());
    if (!source || (path.is_property() && !source.attribute(path.name()).is_defined())) {
      return path.str();
    }
  }
  return "";
}

bool is_same_type(const Token& type, const char* wanted, bool by_role) {
  const layer::TypeName* own = layer::find_type_name(type);
  const layer::TypeName* other = layer::find_type_name(Token(wanted));
  if (own == nullptr || other == nullptr) {
    return false;
  }
  const auto plain = [](layer::ValueType kind) {
    return kind == layer::ValueType::Token ? layer::ValueType::String : kind;
  };
  return by_role ? own->is_array == other->is_array && own->role == other->role &&
                       plain(own->type) == plain(other->type)
                 : own->is_array == other->is_array && own->type == other->type;
}

}  // namespace

void judge_vm_mat_001(const Judged& judged, Report& report) {
  for (const stage::Prim& prim : judged.stage.with_shared) {
    for (const Token& name : prim.authored_property_names()) {
      if (name.str().starts_with("material:binding:collection:")) {
        report.at(prim, name, "a material is bound by a collection", "bind it directly");
      }
    }
    if (!is_rendered(prim)) {
      continue;
    }
    std::vector<stage::Prim> parts = bound_subsets(prim);
    if (parts.empty()) {
      parts.push_back(prim);
    }
    for (const stage::Prim& part : parts) {
      if (bound_materials(part).empty()) {
        report.at(part, "no material is bound", "bind one");
      }
    }
  }
}

void judge_vm_ps_002(const Judged& judged, Report& report) {
  judge_surface(judged, report, kPreview, "connect a UsdPreviewSurface");
}

void judge_vm_mdl_003(const Judged& judged, Report& report) {
  judge_surface(judged, report, kMdl, "only an asset for Omniverse alone needs a MDL surface");
}

void judge_vm_pbr_001(const Judged& judged, Report& report) {
  judge_library(judged, report, kMaterialX);
  for (const stage::Prim& material : rendered_materials(judged)) {
    if (!is_connected(material, kMaterialX)) {
      if (is_connected_at_all(material)) {
        report.at(material, "the material has no OpenPBR surface", "connect one beside the others");
      }
      continue;
    }
    const stage::Prim shader = terminal_shader(material, kMaterialX);
    if (shader && text(shader, "info:id") != kOpenPbr) {
      report.at(shader, "the MaterialX surface is not OpenPBR", "use open_pbr_surface");
    }
  }
}

void judge_vm_pbr_002(const Judged& judged, Report& report) {
  static const std::set<std::string> kUnit{"base_weight",
                                           "base_metalness",
                                           "base_diffuse_roughness",
                                           "specular_weight",
                                           "specular_roughness",
                                           "specular_roughness_anisotropy",
                                           "transmission_weight",
                                           "subsurface_weight",
                                           "coat_weight",
                                           "coat_roughness",
                                           "coat_roughness_anisotropy",
                                           "coat_darkening",
                                           "thin_film_weight",
                                           "fuzz_weight",
                                           "fuzz_roughness",
                                           "geometry_opacity",
                                           "base_color",
                                           "specular_color",
                                           "transmission_color",
                                           "subsurface_color",
                                           "coat_color",
                                           "fuzz_color",
                                           "emission_color"};
  static const std::set<std::string> kIor{"specular_ior", "coat_ior"};
  for (const stage::Prim& material : materials_in(judged)) {
    const stage::Prim shader = terminal_shader(material, kMaterialX);
    if (!shader || text(shader, "info:id") != kOpenPbr) {
      continue;
    }
    for (const std::string& name : inputs_of(shader)) {
      for (const double x : numbers_in(input_of(shader, name).get())) {
        const bool bad = (kUnit.contains(name) && (x < 0 || x > 1)) ||
                         (kIor.contains(name) && (x < 1 || x > 3)) ||
                         (name == "emission_luminance" && x < 0);
        if (bad) {
          report.at(shader, Token("inputs:" + name), "a value outside of what OpenPBR takes",
                    "correct it");
        }
      }
    }
  }
}

void judge_vm_pbr_003(const Judged& judged, Report& report) {
  for (const stage::Prim& material : materials_in(judged)) {
    if (is_physics_only(material)) {
      continue;
    }
    for (const stage::Prim& shader : below(material)) {
      if (!is_shader(shader)) {
        continue;
      }
      const std::string id = text(shader, "info:id");
      const Node* node = preview_node(shader);
      if (id.starts_with("ND_")) {
        report.leave_open("types of MaterialX' nodes are not known here");
      } else if (node == nullptr && !is_mdl_shader(shader)) {
        report.at(shader, "there is no node " + id, "correct info:id");
        continue;
      }
      for (const std::string& name : inputs_of(shader)) {
        const std::string lost = dangling(shader, input_of(shader, name));
        if (!lost.empty()) {
          report.at(shader, Token("inputs:" + name), "the connection to " + lost + " leads nowhere",
                    "correct or remove it");
        }
        const auto wanted = node == nullptr ? Node::const_iterator{} : node->find(name);
        if (node != nullptr && wanted != node->end() &&
            !is_same_type(input_of(shader, name).type_name(), wanted->second.type, false)) {
          report.at(shader, Token("inputs:" + name),
                    std::string("the type is not ") + wanted->second.type, "correct it");
        }
      }
    }
    if (!is_connected_at_all(material)) {
      report.at(material, "the material has no surface", "connect outputs:surface");
    }
    for (const char* terminal : {kPreview, kMaterialX, kMdl}) {
      const std::string lost = dangling(material, material.attribute(Token(terminal)));
      if (!lost.empty()) {
        report.at(material, Token(terminal), "the connection to " + lost + " leads nowhere",
                  "correct or remove it");
      }
    }
  }
}

void judge_vm_bind_001(const Judged& judged, Report& report) {
  for (const Diagnostic& found : stage::property_errors(*judged.stage.stage)) {
    if (found.rule == "compose.invalid-external-target-path" &&
        found.property.starts_with("material:binding")) {
      report.at(judged.stage.stage->prim(Path::from(found.prim)), Token(found.property),
                "the material lies outside of what the arc brings", "bind one that it brings");
    }
  }
}

void judge_vm_bind_002(const Judged& judged, Report& report) {
  for (const stage::Prim& shader : judged.stage.with_shared) {
    if (shader.type_name() != Token("Shader")) {
      continue;
    }
    const Node* node = preview_node(shader);
    const bool mdl = shader.attribute(Token("info:mdl:sourceAsset")).is_authored();
    if (!shader.attribute(Token("info:id")).is_authored() && !mdl) {
      report.at(shader, "the shader has neither info:id nor info:mdl:sourceAsset", "author one");
    } else if (!mdl && text(shader, "info:id").starts_with("ND_")) {
      report.leave_open("types of MaterialX' nodes are not known here");
    }
    for (const std::string& name : inputs_of(shader)) {
      const stage::Attribute input = input_of(shader, name);
      const auto wanted = node == nullptr ? Node::const_iterator{} : node->find(name);
      if (mdl || node == nullptr || wanted == node->end()) {
        continue;
      }
      const std::vector<double> numbers = numbers_in(input.get());
      const bool finite =
          std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); });
      if (!is_same_type(input.type_name(), wanted->second.type, false)) {
        report.at(shader, Token("inputs:" + name),
                  std::string("the type is not ") + wanted->second.type, "correct it");
      } else if (!finite) {
        report.at(shader, Token("inputs:" + name), "a number that is not finite", "correct it");
      }
    }
  }
}

namespace {

/// "" where an input of a preview node is as the specification says.
std::string fault_of_input(const stage::Prim& shader, const std::string& name,
                           const Input& wanted) {
  const stage::Attribute input = input_of(shader, name);
  if (!is_same_type(input.type_name(), wanted.type, true)) {
    return std::string("the type is not ") + wanted.type;
  }
  const std::vector<Path> connections = input.connections();
  if (!connections.empty()) {
    const stage::Prim source = shader.prim_at(connections.front().prim());
    const bool from_graph =
        source && is_graph(source) && connections.front().name().str().starts_with("inputs:");
    if (source && !wanted.connects && !from_graph) {
      return "it takes no connection";
    }
    if (connections.size() > 1) {
      return "it has several connections";
    }
  }
  const layer::Value connectability = input.metadata(Token("connectability"));
  if (const Token* said = connectability.get<Token>()) {
    if (!(*said == (wanted.connects ? "full" : "interfaceOnly"))) {
      return "its connectability is wrong";
    }
  }
  const std::string value = text(shader, "inputs:" + name);
  return !wanted.tokens.empty() && !value.empty() && !wanted.tokens.contains(value)
             ? "\"" + value + "\" is no value of it"
             : "";
}

}  // namespace

void judge_vm_ps_001(const Judged& judged, Report& report) {
  for (const stage::Prim& prim : judged.stage.with_shared) {
    if (!is_material(prim) || prim.is_instance() || prim.is_instance_proxy()) {
      continue;
    }
    for (const stage::Prim& shader : below(prim)) {
      const Node* node = is_shader(shader) ? preview_node(shader) : nullptr;
      if (node == nullptr || shader.is_instance_proxy()) {
        continue;
      }
      for (const std::string& name : inputs_of(shader)) {
        const auto wanted = node->find(name);
        const std::string fault =
            wanted != node->end() ? fault_of_input(shader, name, wanted->second)
            : input_of(shader, name).connections().empty() ? ""
                                                           : "it is connected, and unknown";
        if (!fault.empty()) {
          report.at(shader, Token("inputs:" + name), "of the input " + name + ", " + fault,
                    "write it as UsdPreviewSurface has it");
        }
      }
      for (const Token& name : shader.authored_property_names()) {
        const std::string start = "outputs:";
        const std::string type =
            name.str().starts_with(start)
                ? output_type(text(shader, "info:id"), name.str().substr(start.size()))
                : "";
        if (!type.empty() &&
            !is_same_type(shader.attribute(name).type_name(), type.c_str(), true)) {
          report.at(shader, name, "the output's type is not " + type, "correct it");
        }
      }
    }
  }
}

void judge_vm_mdl_001(const Judged& judged, Report& report) {
  for (const stage::Prim& material : materials_in(judged)) {
    for (const stage::Prim& shader : material.children()) {
      if (shader.type_name() != Token("Shader") ||
          text(shader, "info:implementationSource") != "sourceAsset") {
        continue;
      }
      const layer::Value value = shader.attribute(Token("info:mdl:sourceAsset")).get();
      const auto* asset = value.get<layer::AssetPath>();
      const std::string path = asset == nullptr ? "" : asset->authored;
      const std::string name = std::filesystem::path(path).filename().string();
      const bool built_in = name.starts_with("Omni") || name == "UsdPreviewSurface.mdl" ||
                            name == "core_definitions.mdl";
      const bool anchored =
          path.starts_with("./") || path.starts_with("../") || path.starts_with("/");
      if (!path.ends_with(".mdl") || (!built_in && (!anchored || asset->resolved.empty()))) {
        report.at(shader, Token("info:mdl:sourceAsset"),
                  "the MDL shader names no .mdl file that is there",
                  "name one from ./ on, or a module of Omniverse");
      }
    }
  }
}

void judge_vm_mdl_002(const Judged& judged, Report& report) {
  for (const stage::Prim& prim : judged.stage.with_shared) {
    if (is_shader(prim) && text(prim, "info:implementationSource") == "mdlMaterial") {
      report.at(prim, Token("info:implementationSource"), "an old form of MDL shaders",
                "author sourceAsset and info:mdl:sourceAsset");
    }
  }
}

}  // namespace tenon::check::simready
