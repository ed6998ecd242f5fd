// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// OpenUSD's rules of material resolution: first all bindings for the purpose, then those for all
// purposes. Walking up, a binding replaces what was found below only when it says
// strongerThanDescendants; at one prim collections, in property order, win over the direct binding.
#include "tenon/stage/collections/material_binding.h"

#include <algorithm>
#include <optional>
#include <string>

#include "tenon/stage/collections/binding_rules.h"
#include "tenon/stage/collections/collection.h"

namespace tenon::stage {
namespace {

constexpr std::string_view kBinding = "material:binding";
constexpr std::string_view kCollection = "collection:";
constexpr std::string_view kCollectionBinding = "material:binding:collection:";

bool is_material(const Prim& prim, Path path) {
  static const Token material{"Material"};
  return path.is_prim() && prim.prim_at(path).is_a(material);
}

CollectionBindings::Binding read_binding(const Prim& at, Token name) {
  const Relationship relationship = at.relationship(name);
  CollectionBindings::Binding binding{name, is_stronger(relationship), {}, {}, {}};
  const std::vector<Path> targets = relationship.targets();
  if (targets.size() == 2) {
    const bool first = targets[0].is_property();
    const Path collection = targets[first ? 0 : 1];
    const Path material = targets[first ? 1 : 0];
    if (collection.is_property() && collection.name().view().starts_with(kCollection) &&
        is_material(at, material)) {
      binding.collection = collection;
      binding.material = material;
    }
  }
  return binding;
}

// The material of a collection binding of `at` when its collection contains `path`; a collection
// that is too large goes to `cut`.
std::optional<Path> collection_material(const Prim& at, CollectionBindings::Binding& binding,
                                        Path path, Path& cut) {
  if (binding.material.empty()) {
    return std::nullopt;
  }
  if (!binding.members) {
    const Token name(binding.collection.name().view().substr(kCollection.size()));
    binding.members = Collection::read(at.prim_at(binding.collection.parent()), name);
  }
  const bool contained = binding.members->contains(path);
  cut = binding.members->is_cut() ? binding.collection : cut;
  return contained ? std::optional(binding.material) : std::nullopt;
}

// "material:binding:collection:name" or, for a purpose, "...:collection:purpose:name".
bool is_collection_binding(std::string_view name, Token purpose) {
  if (!name.starts_with(kCollectionBinding)) {
    return false;
  }
  const std::string_view rest = name.substr(kCollectionBinding.size());
  const std::size_t colon = rest.find(':');
  return purpose.empty()
             ? colon == std::string_view::npos
             : colon != std::string_view::npos && rest.substr(0, colon) == purpose.view();
}

struct Search {
  const Prim& prim;
  Token purpose;
  CollectionBindings& known;
  MaterialBinding found{};

  void take(const Prim& at, const Relationship& binding, Path material) {
    const Path cut = found.cut_collection;
    found = made_binding(at, binding, material);
    found.cut_collection = cut;
  }

  void look_at(const Prim& at) {
    bool direct_here = false;
    const Token name = direct_binding_name(purpose);
    if (at.has_property(name)) {
      const Relationship binding = at.relationship(name);
      const std::optional<Path> material = direct_material(at, binding.targets());
      if (material && (found.material.empty() || is_stronger(binding))) {
        take(at, binding, *material);
        direct_here = true;
      }
    }
    for (CollectionBindings::Binding& one : known.of(at)) {
      if (!is_collection_binding(one.name.view(), purpose) ||
          (!found.material.empty() && !direct_here && !one.is_stronger)) {
        continue;
      }
      const auto material = collection_material(at, one, prim.path(), found.cut_collection);
      if (material) {
        take(at, at.relationship(one.name), *material);
        return;
      }
    }
  }

  MaterialBinding run() {
    for (Prim at = prim; at && !at.is_pseudo_root(); at = at.parent()) {
      look_at(at);
    }
    return found;
  }
};

}  // namespace

Token direct_binding_name(Token purpose) {
  static const Token of_all{kBinding};
  static const Token of_physics{std::string(kBinding) + ":physics"};
  if (purpose.empty()) {
    return of_all;
  }
  return purpose == "physics" ? of_physics : Token(std::string(kBinding) + ":" + purpose.str());
}

bool is_any_binding(Token name) { return name.view().starts_with(kBinding); }

bool is_any_collection_binding(Token name) { return name.view().starts_with(kCollectionBinding); }

bool is_stronger(const Relationship& binding) {
  static const Token how{"bindMaterialAs"};
  static const Token stronger{"strongerThanDescendants"};
  return binding.metadata(how).get_or<Token>(Token()) == stronger;
}

std::optional<Path> direct_material(const Prim& at, const std::vector<Path>& targets) {
  return targets.size() == 1 && is_material(at, targets[0]) ? std::optional(targets[0])
                                                            : std::nullopt;
}

MaterialBinding made_binding(const Prim& at, const Relationship& binding, Path material) {
  static const Token api{"MaterialBindingAPI"};
  return {material, binding.path(), !at.has_api(api), {}};
}

std::vector<CollectionBindings::Binding>& CollectionBindings::of(const Prim& prim) {
  const auto [at, is_new] = known_.try_emplace(prim.path());
  const std::vector<Token>& names = prim.unordered_property_names();
  if (is_new && std::any_of(names.begin(), names.end(), is_any_collection_binding)) {
    for (const Token name : prim.authored_property_names()) {
      if (is_any_collection_binding(name)) {
        at->second.push_back(read_binding(prim, name));
      }
    }
  }
  return at->second;
}

MaterialBinding find_material_binding(const Prim& prim, Token purpose, CollectionBindings& known) {
  MaterialBinding binding = Search{prim, purpose, known}.run();
  if (!binding.material.empty() || purpose.empty()) {
    return binding;
  }
  MaterialBinding general = Search{prim, Token(), known}.run();
  if (general.cut_collection.empty()) {
    general.cut_collection = binding.cut_collection;
  }
  return general;
}

MaterialBinding find_material_binding(const Prim& prim, Token purpose) {
  CollectionBindings known;
  return find_material_binding(prim, purpose, known);
}

Path bound_material(const Prim& prim, Token purpose, CollectionBindings& known) {
  return find_material_binding(prim, purpose, known).material;
}

Path bound_material(const Prim& prim, Token purpose) {
  return find_material_binding(prim, purpose).material;
}

}  // namespace tenon::stage
