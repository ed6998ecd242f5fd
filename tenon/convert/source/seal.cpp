// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The structure of Asset Structure 3.0 moves things: meshes go one level down and take the names of
// equal ones, materials go into scopes of their own and are written once. So a digest goes without
// paths, without names where a name may change, and materials count as a set.
#include "tenon/convert/source/seal.h"

#include <algorithm>
#include <array>
#include <set>
#include <type_traits>
#include <utility>

#include "tenon/base/content_digest.h"
#include "tenon/layer/lists/list_op.h"

namespace tenon::convert {
namespace {

using layer::AssetPath;
using layer::Duration;
using layer::PathExpression;
using layer::TimeCode;
using layer::Value;
namespace fields = layer::fields;

/// Of engines that need not be there under every variant.
constexpr std::string_view kEngines[] = {"mjc", "newton", "physx"};

bool starts_with_any(std::string_view text, std::initializer_list<std::string_view> starts) {
  return std::any_of(starts.begin(), starts.end(),
                     [&](std::string_view start) { return text.starts_with(start); });
}

/// Properties about which MuJoCo's format has nothing to say, or which structures change.
bool is_skipped(std::string_view property) {
  return starts_with_any(property,
                         {"isaac", "urdf", "ui:", "omni", "tenon:mjcf:", "info:", "outputs:"}) ||
         property == "extent";
}

/// What is said of cameras and lights counts apart from what is said of others, so that each edit
/// of them is known by its prim.
std::string_view seen_as(Token type) {
  return type == "Camera"                 ? "Camera."
         : type.view().ends_with("Light") ? "Light."
                                          : std::string_view();
}

/// Properties of cameras and lights that MuJoCo does not support.
bool is_skipped_there(std::string_view property) {
  return starts_with_any(
      property,
      {"clippingRange", "clippingPlanes", "fStop", "focusDistance", "shutter:", "exposure",
       "stereoRole", "light", "collection:", "inputs:diffuse", "inputs:specular",
       "inputs:enableColorTemperature", "inputs:colorTemperature", "inputs:shadow:distance",
       "inputs:shadow:falloff", "inputs:shadow:color", "purpose"});
}

bool is_look(Token type) { return type == "Material" || type == "Shader"; }

template <class T>
void append_bytes(const T& value, std::string& out) {
  if constexpr (std::is_same_v<T, std::string>) {
    out += value + '\0';
  } else if constexpr (std::is_same_v<T, Token>) {
    out += value.str() + '\0';
  } else if constexpr (std::is_trivially_copyable_v<T>) {
    out.append(reinterpret_cast<const char*>(&value), sizeof(T));
  }
}

template <class T>
bool append_if(const Value& value, std::string& out) {
  if (const T* one = value.get<T>()) {
    append_bytes(*one, out);
    return true;
  }
  if (const auto* many = value.get<layer::Array<T>>()) {
    for (auto&& one : *many) {
      append_bytes<T>(one, out);
    }
    return true;
  }
  return false;
}

std::string bytes_of(const Value& value) {
  std::string out;
#define TENON_SCALAR(enumerator, type, name, crate_id) \
  if (append_if<type>(value, out)) {                   \
    return out;                                        \
  }
#include "tenon/layer/value_types.def"
  return out;
}

/// Of bodies, joints, actuators and scenes, and which shape touches with which material.
constexpr std::string_view kWithParts[] = {"physics:mass",
                                           "physics:centerOfMass",
                                           "physics:diagonalInertia",
                                           "newton:inertia",
                                           "tenon:gravityScale",
                                           "physics:principalAxes",
                                           "physics:lowerLimit",
                                           "physics:upperLimit",
                                           "newton:armature",
                                           "newton:damping",
                                           "newton:friction",
                                           "newton:timeStepsPerSecond",
                                           "mjc:armature",
                                           "mjc:damping",
                                           "mjc:frictionloss",
                                           "mjc:stiffness",
                                           "mjc:springref",
                                           "mjc:solreflimit",
                                           "mjc:solimplimit",
                                           "mjc:solreffriction",
                                           "mjc:solimpfriction",
                                           "mjc:gainPrm",
                                           "mjc:biasPrm",
                                           "mjc:gear",
                                           "mjc:ctrlRange:min",
                                           "mjc:ctrlRange:max",
                                           "mjc:forceRange:min",
                                           "mjc:forceRange:max",
                                           "mjc:option:timestep",
                                           "physics:gravityDirection",
                                           "physics:gravityMagnitude",
                                           "drive:angular:physics:stiffness",
                                           "drive:angular:physics:damping",
                                           "drive:angular:physics:maxForce",
                                           "drive:linear:physics:stiffness",
                                           "drive:linear:physics:damping",
                                           "drive:linear:physics:maxForce",
                                           "material:binding",
                                           "material:binding:physics"};

/// "mjc" of "mjc:solref" and "api:MjcJointAPI"; empty: of all engines.
std::string_view engine_of(std::string_view key) {
  std::string_view name = key;
  for (const std::string_view what : {"api:", "type:"}) {
    name = name.starts_with(what) ? name.substr(what.size()) : name;
  }
  if (starts_with_any(name, {"mjc", "Mjc", "tenon:mujoco:sensor", "TenonMujoco"})) {
    return kEngines[0];
  }
  if (starts_with_any(name, {"physx", "Physx"})) {
    return kEngines[2];
  }
  return starts_with_any(name, {"newton", "Newton"}) ? kEngines[1] : std::string_view();
}

std::string digits_of(std::uint64_t digest) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text(16, '0');
  for (std::size_t i = text.size(); i-- > 0; digest >>= 4u) {
    text[i] = kDigits[digest & 15u];
  }
  return text;
}

}  // namespace

bool has_parts(std::string_view property) {
  return starts_with_any(property, {"Camera.", "Light."}) ||
         std::find(std::begin(kWithParts), std::end(kWithParts), property) != std::end(kWithParts);
}

void SealMaker::add(Path prim, Token type, const std::string& key, const std::string& contents) {
  // Where a mesh stands may have gone to a prim around it, of another name.
  const bool of_mesh =
      type == "Mesh" || (key.starts_with("xform") && type == "Xform" && !bodies_.contains(prim));
  const bool named = prim != root_ && !of_mesh && !is_look(type);
  const std::string name = named ? prim.name().str() : std::string();
  const std::uint64_t digest = content_digest(name + '\0' + contents);
  if (!is_look(type) && has_parts(key)) {
    constexpr std::uint64_t kHalf = 0xffffffff;
    parts_[key].push_back({prim, content_digest(name) << 32u | (digest & kHalf)});
  }
  if (is_look(type)) {
    looks_[key].insert(digest);
    for (Path around = prim; !around.empty() && !around.is_absolute_root();
         around = around.parent()) {
      look_sums_[around] += content_digest(key + '\0' + contents);
    }
  } else {
    seal_[key] += digest;
  }
}

void SealMaker::add_prim(Path prim, Token type, const std::vector<Token>& apis) {
  const std::string_view word = type.view();
  if (starts_with_any(word, {"Physics", "Mjc", "Newton", "TenonMujoco"})) {
    add(prim, type, "type:" + type.str(), "");
  }
  for (const Token api : apis) {
    if (api == "PhysicsRigidBodyAPI") {
      bodies_.insert(prim);
    }
    if (starts_with_any(api.view(), {"Physics", "Mjc", "Newton", "Physx"})) {
      add(prim, type, "api:" + api.str(), "");
    }
  }
}

void SealMaker::add_value(Path prim, Token type, Token property, const Value& value) {
  const std::string_view seen = seen_as(type);
  if (!is_skipped(property.view()) && !value.holds<layer::AssetPath>() && !value.empty() &&
      (seen.empty() || !is_skipped_there(property.view()))) {
    add(prim, type, std::string(seen) + property.str(), bytes_of(value));
  }
}

void SealMaker::add_targets(Path prim, Token type, Token relationship,
                            const std::vector<Path>& targets) {
  const std::string_view seen = seen_as(type);
  if (is_skipped(relationship.view()) || (!seen.empty() && is_skipped_there(relationship.view()))) {
    return;
  }
  if (relationship.view().starts_with("material:binding")) {
    for (const Path target : targets) {
      bindings_.push_back({prim, type, relationship, target});
    }
    return;
  }
  std::string names;
  for (const Path target : targets) {
    names += target.name().str() + '\0';
  }
  add(prim, type, std::string(seen) + relationship.str(), names);
}

Seal SealMaker::take() {
  for (const Binding& binding : std::exchange(bindings_, {})) {
    const auto look = look_sums_.find(binding.target);
    add(binding.prim, binding.type, binding.relationship.str(),
        look == look_sums_.end() ? std::string() : digits_of(look->second));
  }
  for (const auto& [key, digests] : looks_) {
    for (const std::uint64_t digest : digests) {
      seal_[key] += digest;
    }
  }
  looks_.clear();
  return std::move(seal_);
}

Seal seal_of(const layer::Layer& layer, SealParts* parts) {
  SealMaker maker(Path::absolute_root().child(layer.default_prim()));
  for (const layer::Layer::Entry& entry : layer.entries()) {
    const Path path = entry.path;
    if (path.empty() || path.is_absolute_root()) {
      continue;
    }
    const layer::Spec* prim = layer.find(path.prim());
    const auto* type = prim == nullptr ? nullptr : prim->get<Token>(fields::typeName);
    const Token type_name = type == nullptr ? Token() : *type;
    if (!path.is_property()) {
      const auto* apis = entry.spec.get<layer::ListOp<Token>>(fields::apiSchemas);
      std::vector<Token> list;
      if (apis != nullptr) {
        apis->apply_to(list);
      }
      maker.add_prim(path, type_name, list);
    } else if (const auto* targets = entry.spec.get<layer::ListOp<Path>>(fields::targetPaths)) {
      std::vector<Path> list;
      targets->apply_to(list);
      maker.add_targets(path.prim(), type_name, path.name(), list);
    } else if (const Value* value = entry.spec.find(fields::default_value)) {
      maker.add_value(path.prim(), type_name, path.name(), *value);
    }
  }
  Seal seal = maker.take();
  if (parts != nullptr) {
    *parts = maker.take_parts();
  }
  return seal;
}

std::vector<std::string> seal_words(const Seal& seal) {
  std::vector<std::string> words;
  for (const auto& [key, digest] : seal) {
    words.push_back(key + " " + digits_of(digest));
  }
  return words;
}

std::vector<std::string> part_words(const SealParts& parts) {
  std::vector<std::string> words;
  for (const auto& [key, list] : parts) {
    std::vector<std::uint64_t> digests;
    for (const SealPart& part : list) {
      digests.push_back(part.digest);
    }
    std::sort(digests.begin(), digests.end());
    std::string word = key;
    for (const std::uint64_t digest : digests) {
      word += " " + digits_of(digest);
    }
    words.push_back(std::move(word));
  }
  return words;
}

std::optional<std::vector<Path>> edited_prims(const std::vector<std::string>& words,
                                              const std::string& property, const SealParts& now) {
  const auto word = std::find_if(words.begin(), words.end(), [&](const std::string& line) {
    return line == property || line.starts_with(property + " ");
  });
  const auto parts = now.find(property);
  if (parts == now.end() || words.empty()) {
    return std::nullopt;
  }
  std::multiset<std::string> before;
  std::multiset<std::string> names;
  for (std::size_t at = property.size() + 1; word != words.end() && at < word->size(); at += 17) {
    before.insert(word->substr(at, 16));
  }
  std::vector<Path> edited;
  for (const SealPart& part : parts->second) {
    const std::string digits = digits_of(part.digest);
    const auto same = before.find(digits);
    if (same != before.end()) {
      before.erase(same);
    } else {
      edited.push_back(part.prim);
      names.insert(digits.substr(0, 8));
    }
  }
  for (const std::string& gone : before) {  // what it was before the edit of a prim of that name
    const auto same = names.find(gone.substr(0, 8));
    if (same == names.end()) {
      return std::nullopt;
    }
    names.erase(same);
  }
  std::sort(edited.begin(), edited.end());
  return edited.empty() ? std::nullopt : std::optional(std::move(edited));
}

std::vector<std::string> changed_since(const std::vector<std::string>& words, const Seal& now) {
  std::set<std::string_view> engines;  // of which something is there
  for (const auto& [key, digest] : now) {
    engines.insert(engine_of(key));
  }
  std::set<std::string> changed;
  std::set<std::string_view> known;
  for (const std::string& word : words) {
    const std::size_t space = std::min(word.rfind(' '), word.size());
    const std::string key = word.substr(0, space);
    known.insert(std::string_view(word).substr(0, space));
    const auto at = now.find(key);
    const std::string_view engine = engine_of(key);
    const bool is_absent = at == now.end() && !engine.empty() && !engines.contains(engine);
    if (!is_absent && (at == now.end() || word != key + " " + digits_of(at->second))) {
      changed.insert(key);
    }
  }
  for (const auto& [key, digest] : now) {
    if (!known.contains(key)) {
      changed.insert(key);
    }
  }
  return {changed.begin(), changed.end()};
}

}  // namespace tenon::convert
