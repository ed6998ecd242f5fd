// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/stage/collection.h"

#include <algorithm>
#include <set>

namespace tenon::stage {
namespace {

constexpr std::string_view kPrefix = "collection:";

std::string property(Token collection, std::string_view part) {
  return std::string(kPrefix) + collection.str() + ":" + std::string(part);
}

bool is_collection(Path path) {
  return path.is_property() && path.name().view().starts_with(kPrefix);
}

}  // namespace

// Includes and excludes of a collection and of those that it includes; each is read once.
class CollectionReader {
 public:
  explicit CollectionReader(Collection& result) : result_(result) {}

  void read(const Prim& prim, Token name) {
    pending_.push_back({prim, name});
    while (!pending_.empty()) {
      const Source source = pending_.back();
      pending_.pop_back();
      const Path path =
          source.prim.path().property(Token(std::string(kPrefix) + source.name.str()));
      if (source.prim && seen_.insert(path).second) {
        read_one(source.prim, source.name);
      }
    }
  }

 private:
  using Rule = Collection::Rule;
  struct Source {
    Prim prim;
    Token name;
  };

  Rule expansion(const Prim& prim, Token name) {
    const Token rule =
        prim.attribute(Token(property(name, "expansionRule"))).get().get_or<Token>("expandPrims");
    if (rule == "explicitOnly") {
      return Rule::ExplicitOnly;
    }
    return rule == "expandPrimsAndProperties" ? Rule::ExpandPrimsAndProperties : Rule::ExpandPrims;
  }

  void read_one(const Prim& prim, Token name) {
    const Rule rule = expansion(prim, name);
    const auto includes = prim.relationship(Token(property(name, "includes"))).targets();
    for (const Path path : includes) {
      if (is_collection(path)) {
        const std::string_view full = path.name().view();
        pending_.push_back({prim.prim_at(path.parent()), Token(full.substr(kPrefix.size()))});
      } else {
        result_.rules_.try_emplace(path, rule);
      }
    }
    if (prim.attribute(Token(property(name, "includeRoot"))).get().get_or(false)) {
      result_.rules_.try_emplace(Path::absolute_root(), rule);
    }
    for (const Path path : prim.relationship(Token(property(name, "excludes"))).targets()) {
      result_.rules_.insert_or_assign(path, Rule::Exclude);
    }
  }

  Collection& result_;
  std::vector<Source> pending_;
  std::set<Path> seen_;
};

Collection Collection::read(const Prim& prim, Token name) {
  Collection result;
  if (!prim) {
    return result;
  }
  CollectionReader(result).read(prim, name);
  const layer::Value expression =
      prim.attribute(Token(property(name, "membershipExpression"))).get();
  if (const auto* text = expression.get<layer::PathExpression>(); text && result.rules_.empty()) {
    result.expression_ = text->text;
    result.anchor_ = prim.path();
  }
  return result;
}

bool Collection::contains(Path path) const {
  if (rules_.empty()) {
    return !expression_.empty() && expression_matches(expression_, anchor_, path);
  }
  for (Path at = path; !at.empty(); at = at.parent()) {
    const auto it = rules_.find(at);
    if (it == rules_.end() || (it->second == Rule::ExplicitOnly && at != path)) {
      continue;
    }
    if (it->second == Rule::ExpandPrims && at != path && !path.is_prim()) {
      return false;
    }
    return it->second != Rule::Exclude;
  }
  return false;
}

std::vector<Path> Collection::members(const Stage& stage) const {
  const bool properties =
      std::any_of(rules_.begin(), rules_.end(), [](const auto& rule) {
        return rule.second == Rule::ExpandPrimsAndProperties || rule.first.is_property();
      });
  std::vector<Path> result;
  std::vector<Prim> pending = stage.pseudo_root().children();
  while (!pending.empty()) {
    const Prim prim = pending.back();
    pending.pop_back();
    if (contains(prim.path())) {
      result.push_back(prim.path());
    }
    if (properties) {
      for (const Token name : prim.property_names()) {
        if (contains(prim.path().property(name))) {
          result.push_back(prim.path().property(name));
        }
      }
    }
    const std::vector<Prim> children = prim.children();
    pending.insert(pending.end(), children.begin(), children.end());
  }
  std::sort(result.begin(), result.end());
  return result;
}

}  // namespace tenon::stage
