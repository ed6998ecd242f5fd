// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Rules map paths to what they bring along, and the nearest rule at or above a path decides. They
// are read depth first on an explicit stack. A collection's own excludes come after all that it
// includes, and the later of two rules for a path wins. The smaller map is moved into the larger
// one, so deep inclusion stays cheap. A collection that leads back to an open one adds nothing, and
// visits and items are limited. Without any rule the membership expression decides, with references
// replaced by what they name. Members by rules come from walks that stop where the same rule has
// led before.
#include "tenon/stage/collections/collection.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "tenon/base/limits/limits.h"
#include "tenon/base/limits/work_limits.h"

namespace tenon::stage {
namespace {

using layer::ExpressionReference;
using layer::PathExpressionTree;
using Rule = Collection::Rule;
using Rules = Collection::Rules;

constexpr std::string_view kPrefix = "collection:";

Token property(Token collection, std::string_view part) {
  return Token(std::string(kPrefix) + collection.str() + ":" + std::string(part));
}

Path collection_path(const Prim& prim, Token name) {
  return prim.path().property(Token(std::string(kPrefix) + name.str()));
}

/// "lights" of "collection:lights"; nullopt for other properties, those of a collection included.
std::optional<Token> collection_name(Path path) {
  const std::string_view name = path.name().view();
  if (!path.is_property() || !name.starts_with(kPrefix)) {
    return std::nullopt;
  }
  const std::string_view last = name.substr(name.rfind(':') + 1);
  for (const std::string_view part :
       {"includes", "excludes", "expansionRule", "includeRoot", "membershipExpression"}) {
    if (last == part) {
      return std::nullopt;
    }
  }
  return Token(name.substr(kPrefix.size()));
}

Rule expansion_rule(const Prim& prim, Token name) {
  const Token rule =
      prim.attribute(property(name, "expansionRule")).get().get_or<Token>("expandPrims");
  if (rule == "explicitOnly") {
    return Rule::ExplicitOnly;
  }
  return rule == "expandPrimsAndProperties" ? Rule::ExpandPrimsAndProperties : Rule::ExpandPrims;
}

/// Reads the rules of a collection and of those that it includes.
class RuleReader {
 public:
  explicit RuleReader(std::size_t most) : most_(most) {}

  Rules read(const Prim& prim, Token name) {
    open(prim, name);
    while (true) {
      Frame& frame = frames_.back();
      if (frame.next < frame.includes.size()) {
        include(frame.includes[frame.next++]);
        continue;
      }
      finish(frame);
      Rules rules = std::move(frame.rules);
      open_.erase(frame.path);
      frames_.pop_back();
      if (frames_.empty()) {
        return rules;
      }
      merge(frames_.back().rules, std::move(rules));
    }
  }

  /// A limit was met, and there are more rules than were read.
  bool is_cut() const { return is_cut_ || is_exhausted(); }

  std::size_t work() const { return items_ + kVisit * visits_; }

 private:
  static constexpr std::size_t kVisit = 20;  // work of a collection beside its targets

  struct Frame {
    Prim prim;
    Token name;
    Path path;
    Rule rule = Rule::ExpandPrims;
    std::vector<Path> includes;
    std::size_t next = 0;
    Rules rules;
  };

  bool is_exhausted() const { return items_ > limits::kCollectionItems || work() > most_; }

  void open(const Prim& prim, Token name) {
    ++visits_;
    open_.insert(collection_path(prim, name));
    if (is_exhausted()) {
      frames_.push_back({prim, name, collection_path(prim, name), Rule::ExplicitOnly, {}, 0, {}});
      return;
    }
    frames_.push_back({prim,
                       name,
                       collection_path(prim, name),
                       expansion_rule(prim, name),
                       prim.relationship(property(name, "includes")).targets(),
                       0,
                       {}});
    items_ += frames_.back().includes.size();
  }

  void include(Path path) {
    const std::optional<Token> name = collection_name(path);
    if (!name) {
      frames_.back().rules[path] = frames_.back().rule;
      return;
    }
    const Prim prim = frames_.back().prim.prim_at(path.parent());
    if (prim && !open_.contains(collection_path(prim, *name))) {
      is_cut_ = is_cut_ || visits_ >= limits::kCollectionVisits;
      if (visits_ < limits::kCollectionVisits) {
        open(prim, *name);
      }
    }
  }

  void finish(Frame& frame) {
    if (is_exhausted()) {
      return;
    }
    if (frame.rule != Rule::ExplicitOnly &&
        frame.prim.attribute(property(frame.name, "includeRoot")).get().get_or(false)) {
      frame.rules[Path::absolute_root()] = frame.rule;
    }
    for (const Path path : frame.prim.relationship(property(frame.name, "excludes")).targets()) {
      frame.rules[path] = Rule::Exclude;
      ++items_;
    }
  }

  /// The later ones win; the smaller map is moved into the larger one.
  static void merge(Rules& rules, Rules later) {
    if (rules.size() < later.size()) {
      rules.swap(later);
      for (const auto& [path, rule] : later) {
        rules.try_emplace(path, rule);
      }
      return;
    }
    for (const auto& [path, rule] : later) {
      rules[path] = rule;
    }
  }

  std::size_t most_;
  std::vector<Frame> frames_;
  std::unordered_set<Path> open_;  // of the frames
  std::size_t visits_ = 0;
  std::size_t items_ = 0;  // included and excluded
  bool is_cut_ = false;
};

class ExpressionResolver {
 public:
  PathExpressionTree resolve(const Prim& prim, Token name) {
    if (!prim) {
      return {};
    }
    const Path path = collection_path(prim, name);
    if (const auto it = known_.find(path); it != known_.end()) {
      return it->second;
    }
    const bool leads_back = std::find(open_.begin(), open_.end(), path) != open_.end();
    if (leads_back || open_.size() >= limits::kCollectionDepth ||
        visits_ >= limits::kCollectionVisits) {
      return {};
    }
    ++visits_;
    open_.push_back(path);
    PathExpressionTree result = read(prim, name);
    open_.pop_back();
    known_.emplace(path, result);
    return result;
  }

 private:
  PathExpressionTree read(const Prim& prim, Token name) {
    const layer::Value value = prim.attribute(property(name, "membershipExpression")).get();
    const auto* text = value.get<layer::PathExpression>();
    auto tree = PathExpressionTree::parse(text == nullptr ? std::string_view() : text->text);
    if (!tree) {
      return {};
    }
    return tree
        ->resolved([&](const ExpressionReference& found) {
          if (found.is_weaker()) {
            return PathExpressionTree();
          }
          const Prim owner = found.path.empty() ? prim : prim.prim_at(found.path);
          return resolve(owner, Token(found.name));
        })
        .value_or(PathExpressionTree());
  }

  std::vector<Path> open_;
  std::unordered_map<Path, PathExpressionTree> known_;
  std::size_t visits_ = 0;
};

/// Met by a traversal that asks for nothing special.
bool is_traversed(const Prim& prim) {
  return prim.is_active() && prim.is_loaded() && prim.is_defined() && !prim.is_abstract();
}

/// Calls `visit` for the prim and its traversed descendants, parents first; descendants of a prim
/// are skipped where `visit` returns false.
template <class Visit>
void traverse(const Prim& start, Visit visit) {
  std::vector<Prim> pending{start};
  while (!pending.empty()) {
    const Prim prim = pending.back();
    pending.pop_back();
    const bool is_root = prim.is_pseudo_root();
    if ((!is_root && (!is_traversed(prim) || !visit(prim))) || prim.is_instance()) {
      continue;
    }
    const std::vector<Prim> children = prim.children();
    pending.insert(pending.end(), children.rbegin(), children.rend());
  }
}

}  // namespace

layer::PathExpressionTree complete_membership_expression(const Prim& prim, Token name) {
  return ExpressionResolver().resolve(prim, name);
}

Collection Collection::read(const Prim& prim, Token name, std::size_t most) {
  Collection result;
  if (!prim) {
    return result;
  }
  RuleReader reader(most);
  result.rules_ = reader.read(prim, name);
  result.is_cut_ = reader.is_cut();
  result.work_ = reader.work();
  result.top_rule_ = expansion_rule(prim, name);
  // An expression that cannot be evaluated matches nothing.
  if (auto matcher = PathMatcher::make(complete_membership_expression(prim, name), prim)) {
    result.matcher_ = std::move(*matcher);
  }
  return result;
}

bool Collection::contains(Path path) const {
  return rules_.empty() ? matcher_.matches(path) : included_by_rules(path);
}

bool Collection::included_by_rules(Path path) const {
  if (!path.is_prim() && !path.is_property()) {
    return false;
  }
  for (Path at = path; !at.empty(); at = at.parent()) {
    const auto it = rules_.find(at);
    if (it == rules_.end()) {
      continue;
    }
    if (it->second == Rule::Exclude) {
      return false;
    }
    // What has a rule of its own is included; else the rule has to reach down to it.
    const bool reaches = path.is_prim() ? it->second != Rule::ExplicitOnly
                                        : it->second == Rule::ExpandPrimsAndProperties;
    if (at == path || reaches) {
      return true;
    }
  }
  return false;
}

void Collection::add_by_rule(const Stage& stage, Path path, Rule rule,
                             std::unordered_set<Path>& visited, std::vector<Path>& members) const {
  const Prim prim = stage.prim(path.is_property() ? path.parent() : path);
  if (!prim) {
    return;
  }
  if (path.is_property()) {
    if (prim.has_property(path.name())) {
      members.push_back(path);
    }
    return;
  }
  traverse(prim, [&](const Prim& at) {
    if (rule == Rule::ExplicitOnly) {
      members.push_back(at.path());
      return false;
    }
    if (!included_by_rules(at.path()) || !visited.insert(at.path()).second) {
      return false;
    }
    members.push_back(at.path());
    if (rule == Rule::ExpandPrimsAndProperties) {
      for (const Token name : at.property_names()) {
        const auto own = rules_.find(at.path().property(name));
        if (own == rules_.end() || own->second != Rule::Exclude) {
          members.push_back(at.path().property(name));
        }
      }
    }
    return true;
  });
}

void Collection::add_by_expression(const Stage& stage, std::vector<Path>& members) const {
  traverse(stage.pseudo_root(), [&](const Prim& at) {
    if (matcher_.matches(at.path())) {
      members.push_back(at.path());
    }
    if (top_rule_ == Rule::ExpandPrimsAndProperties) {
      for (const Token name : at.property_names()) {
        if (matcher_.matches(at.path().property(name))) {
          members.push_back(at.path().property(name));
        }
      }
    }
    return true;
  });
}

std::vector<Path> Collection::members(const Stage& stage) const {
  std::vector<Path> result;
  std::array<std::unordered_set<Path>, 4> visited;  // by rule: where one above led already
  for (const auto& [path, rule] : rules_) {
    if (rule != Rule::Exclude) {
      add_by_rule(stage, path, rule, visited[static_cast<std::size_t>(rule)], result);
    }
  }
  if (rules_.empty() && !matcher_.is_empty() && top_rule_ != Rule::ExplicitOnly) {
    add_by_expression(stage, result);
  }
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

}  // namespace tenon::stage
