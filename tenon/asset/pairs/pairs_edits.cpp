// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A request becomes pairs of paths, by words, by two names, or by a file. Pairs whose colliders
// filters keep apart, self-collision that is off aside, are taken out; the others become filtered
// pairs of the first prim. A removal is asked of all variants of "Physics", since any of them may
// have the filter. Where it is the last one of its prim, the schema goes, too. Links of SRDF are
// found by the names of the bodies' prims, which therefore must be of one body each.
#include "tenon/asset/pairs/pairs_edits.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "tenon/answers/json.h"
#include "tenon/asset/authoring/remove_edits.h"
#include "tenon/asset/pairs/link_names.h"
#include "tenon/asset/pairs/self_collision_edits.h"
#include "tenon/asset/typed_edits.h"
#include "tenon/base/limits/pair_limits.h"
#include "tenon/base/text/nearest_name.h"
#include "tenon/urdf/srdf.h"

namespace tenon {
namespace {

using scene::Index;

constexpr std::array<std::string_view, 4> kWords{"always", "often", "adjacent", "default"};
using PathPair = std::pair<Path, Path>;  // the lower path first

PathPair in_order(Path a, Path b) { return b < a ? PathPair(b, a) : PathPair(a, b); }

bool is_file(const std::string& text) { return text.ends_with(".srdf") || text.ends_with(".json"); }

std::vector<std::string> at_commas(const std::string& text) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  while (begin <= text.size()) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

bool is_word(const std::string& text) {
  return std::find(kWords.begin(), kWords.end(), text) != kWords.end();
}

/// Two names with a comma between, of which none is a word, are a pair, and so are two paths.
bool is_pair(const std::string& text) {
  const std::vector<std::string> parts = at_commas(text);
  return text.starts_with('/') ||
         (parts.size() == 2 && std::none_of(parts.begin(), parts.end(), is_word));
}

bool is_words(const std::string& text) { return !is_file(text) && !is_pair(text); }

Error unknown_word(const std::string& word) {
  const std::string_view near =
      word.size() > 100 ? std::string_view() : nearest_name(word, {kWords.begin(), kWords.end()});
  return Error(ErrorCode::Invalid, "\"" + word + "\" is no word for pairs")
      .with_rule("pairs.unknown-word")
      .with_fix((near.empty() ? "" : "did you mean \"" + std::string(near) + "\"? ") +
                std::string("Give always, often, adjacent or default, with commas between, two "
                            "bodies as in /hand/palm,/hand/thumb, or a .srdf or .json file"));
}

/// The colliders that a path means: those of a body, or one.
class NamedSides {
 public:
  NamedSides(const scene::PhysicsScene& scene, const physics::Provenance& provenance)
      : scene_(scene), provenance_(provenance) {
    for (Index i = 0; i < scene.colliders.size(); ++i) {
      const scene::Collider& collider = scene.colliders[i];
      sides_[collider.path].push_back(i);
      if (collider.body) {
        sides_[scene.bodies[*collider.body].path].push_back(i);
      }
    }
    for (const scene::Body& body : scene.bodies) {
      sides_.try_emplace(body.path);
      names_[body.path.name().str()].push_back(body.path);
    }
  }

  bool has(Path path) const { return sides_.contains(path); }

  /// All colliders of the one are kept from all of the other, whether self-collision is on or off;
  /// also where one has none.
  bool are_apart(Path a, Path b) const {
    const std::vector<Index>& own = sides_.at(a);
    const std::vector<Index>& other = sides_.at(b);
    return std::all_of(own.begin(), own.end(), [&](Index i) {
      return std::all_of(other.begin(), other.end(), [&](Index j) { return never_meet(i, j); });
    });
  }

  /// A path, or the name of one body.
  Result<Path> read(const std::string& text) const {
    const auto path = Path::parse(text);
    if (path && has(*path)) {
      return *path;
    }
    const auto named_so = names_.find(text);
    if (named_so != names_.end() && named_so->second.size() == 1) {
      return named_so->second.front();
    }
    if (named_so != names_.end()) {
      return Error(ErrorCode::Invalid, "the name \"" + text + "\" is of more than one body")
          .with_rule("pairs.same-name")
          .with_fix("give its path, such as " + named_so->second.front().str());
    }
    return Error(ErrorCode::NotFound, "\"" + text + "\" is neither a body nor a collider")
        .with_rule("pairs.no-body")
        .with_fix(advice(text));
  }

 private:
  bool never_meet(Index i, Index j) const {
    constexpr std::string_view kSelfCollision = "S-115";
    if (scene_.may_meet(i, j)) {
      return false;
    }
    const auto reasons = physics::why_apart(scene_, provenance_, i, j);
    return reasons.empty() || std::any_of(reasons.begin(), reasons.end(), [&](const auto& reason) {
             return reason.rule != kSelfCollision;
           });
  }

  std::string advice(const std::string& text) const {
    constexpr std::size_t kMostNames = 10'000;
    constexpr std::size_t kLongest = 500;
    std::vector<std::string> names;
    for (const auto& [path, colliders] : sides_) {
      std::string name = text.starts_with('/') ? path.str() : path.name().str();
      if (names.size() < kMostNames && name.size() <= kLongest) {
        names.push_back(std::move(name));
      }
    }
    const std::string_view near = text.size() > kLongest
                                      ? std::string_view()
                                      : nearest_name(text, {names.begin(), names.end()});
    return near.empty() ? "tenon tree ASSET --show physics lists the bodies"
                        : "did you mean " + std::string(near) + "?";
  }

  const scene::PhysicsScene& scene_;
  const physics::Provenance& provenance_;
  std::map<Path, std::vector<Index>> sides_;
  std::map<std::string, std::vector<Path>> names_;  // of bodies
};

/// Turns a request into pairs of paths.
class PairChoice {
 public:
  PairChoice(const PairsOfAsset& pairs, const EditOptions& options, Diagnostics& diagnostics)
      : pairs_(pairs),
        options_(options),
        diagnostics_(diagnostics),
        sides_(*pairs.scene, pairs.provenance) {}

  const NamedSides& sides() const { return sides_; }

  Result<std::set<PathPair>> read(const std::vector<std::string>& filters) {
    for (const std::string& text : filters) {
      if (text.ends_with(".srdf")) {
        TENON_CHECK(add_srdf(text));
      } else if (text.ends_with(".json")) {
        TENON_CHECK(add_json(text));
      } else if (is_pair(text)) {
        TENON_TRY(const PathPair pair, read_pair(text));
        chosen_.insert(pair);
      } else {
        TENON_CHECK(add_words(text));
      }
    }
    return std::move(chosen_);
  }

  /// "A,B".
  Result<PathPair> read_pair(const std::string& text) const {
    const std::vector<std::string> parts = at_commas(text);
    if (parts.size() != 2) {
      return Error(ErrorCode::Invalid, "\"" + text + "\" is not two bodies with a comma between")
          .with_rule("edit.bad-argument")
          .with_fix("write two, as in /hand/palm,/hand/thumb");
    }
    return read_two(parts[0], parts[1]);
  }

 private:
  Result<PathPair> read_two(const std::string& first, const std::string& second) const {
    TENON_TRY(const Path a, sides_.read(first));
    TENON_TRY(const Path b, sides_.read(second));
    if (a == b) {
      return Error(ErrorCode::Invalid, "both are " + named(a, RelatedRole::Body))
          .with_rule("edit.bad-argument")
          .with_fix("name two bodies");
    }
    return in_order(a, b);
  }

  Result<void> add_words(const std::string& text) {
    for (const std::string& word : at_commas(text)) {
      if (!is_word(word)) {
        return unknown_word(word);
      }
      if ((word == "always" || word == "often") && pairs_.found.counted() == 0) {
        return Error(ErrorCode::Invalid,
                     "no posture was looked at, so nothing is known to touch " + word)
            .with_rule("pairs.no-postures")
            .with_fix("draw some: --sample 1000");
      }
      for (const BodyPair& pair : pairs_.found.pairs) {
        if (is_meant(pair, word)) {
          add_found(pair);
        }
      }
    }
    return {};
  }

  static bool is_meant(const BodyPair& pair, const std::string& word) {
    return word == "adjacent"  ? pair.adjacent
           : word == "default" ? pair.start_depth.has_value()
                               : pair.often && pair_class_name(*pair.often) == word;
  }

  /// Bodies that a point instancer makes are no prims.
  void add_found(const BodyPair& pair) {
    const bool are_prims = pairs_.stage->prim(pair.a) && pairs_.stage->prim(pair.b);
    if (are_prims) {
      chosen_.insert(in_order(pair.a, pair.b));
      return;
    }
    diagnostics_.add({Severity::Warning, "pairs.instance",
                      "the pair with " + named(pair.b, RelatedRole::Body) +
                          " is not filtered: point instances are no prims that could say so",
                      pair.a.str(), "", "filter prims of the prototypes"});
  }

  Result<void> add_srdf(const std::string& file) {
    TENON_TRY(const auto disabled, urdf::read_srdf(file, options_.open.files, diagnostics_));
    TENON_TRY(const LinkNames names, LinkNames::of(*pairs_.scene));
    for (const urdf::DisabledCollision& one : disabled) {
      Path ends[2];
      for (const auto& [name, end] : {std::pair(&one.link1, &ends[0]), {&one.link2, &ends[1]}}) {
        const std::optional<Path> body = names.find(*name);
        if (!body) {
          return Error(ErrorCode::NotFound, "no body has the name \"" + *name + "\"")
              .in_file(file)
              .at(one.place.line, one.place.column)
              .with_rule("pairs.no-body")
              .with_fix(names.advice(*name));
        }
        *end = *body;
      }
      if (ends[0] != ends[1]) {
        chosen_.insert(in_order(ends[0], ends[1]));
      }
    }
    return {};
  }

  Result<void> add_json(const std::string& file) {
    bytes::FileRules rules;
    rules.max_bytes = limits::kPairFileBytes;
    TENON_TRY(const auto contents, options_.open.files->open(file, rules));
    TENON_TRY(const answers::Json json,
              answers::parsed_file(contents->text(),
                                   [&](const std::string& why) { return bad_json(file, why); }));
    const bool has_pairs = json.is_object() && json.contains("pairs") && json["pairs"].is_array();
    if (!has_pairs) {
      return bad_json(file, "it has no list \"pairs\"");
    }
    for (const answers::Json& pair : json["pairs"]) {
      const auto text = [&](const char* key) {
        const bool has = pair.is_object() && pair.contains(key) && pair[key].is_string();
        return has ? pair[key].get<std::string>() : std::string();
      };
      const std::string a = text("bodyA");
      const std::string b = text("bodyB");
      if (a.empty() || b.empty()) {
        return bad_json(file, "a pair of it has no \"bodyA\" or \"bodyB\"");
      }
      auto both = read_two(a, b);
      if (!both) {
        return std::move(both).error().in_file(file);
      }
      chosen_.insert(*both);
    }
    return {};
  }

  static Error bad_json(const std::string& file, const std::string& why) {
    return Error(ErrorCode::Parse, "no pairs can be read from this: " + why)
        .in_file(file)
        .with_rule("pairs.file")
        .with_fix(
            "tenon pairs ASSET --json shows the form: {\"pairs\": [{\"bodyA\": \"/hand/palm\", "
            "\"bodyB\": \"/hand/thumb\"}]}");
  }

  const PairsOfAsset& pairs_;
  const EditOptions& options_;
  Diagnostics& diagnostics_;
  NamedSides sides_;
  std::set<PathPair> chosen_;
};

const Token& filtered_pairs() {
  static const Token name("physics:filteredPairs");
  return name;
}

/// Paths with commas between.
std::string joined(const std::set<Path>& paths) {
  std::string text;
  for (const Path path : paths) {
    text += (text.empty() ? "" : ",") + path.str();
  }
  return text;
}

/// Takes filtered pairs away.
class PairRemoval {
 public:
  PairRemoval(const PairsOfAsset& pairs, const Stages& stages, const EditOptions& options)
      : pairs_(pairs), stages_(stages), options_(options) {}

  /// From whichever of the two lists the other.
  Result<void> add(const PathPair& pair) {
    const auto [a, b] = pair;
    const bool first = take(a, b);
    const bool second = take(b, a);
    if (first || second) {
      return {};
    }
    return Error(ErrorCode::NotFound, "neither of " + named(a, RelatedRole::Body) + " and " +
                                          named(b, RelatedRole::Body) +
                                          " lists the other in physics:filteredPairs" + who(pair))
        .with_prim(a.str())
        .with_rule("pairs.not-filtered")
        .with_fix("tenon explain ASSET " + a.str() + " tells what keeps it apart from others");
  }

  Result<std::vector<AssetEdit>> edits() const {
    std::vector<AssetEdit> edits;
    for (const auto& [prim, others] : taken_) {
      if (left(prim) == 0) {
        AuthoringRequest whole;
        whole.what = {prim.str() + "=filtered-pair"};
        TENON_TRY(std::vector<AssetEdit> all, remove_edits(stages_, whole, options_.engine));
        edits.insert(edits.end(), all.begin(), all.end());
        continue;
      }
      AssetEdit edit;
      edit.kind = AssetEdit::Kind::RemoveTargets;
      edit.object = prim.property(filtered_pairs());
      edit.tidy = true;
      edit.may_rest = true;
      edit.value = joined(others);
      edits.push_back(std::move(edit));
    }
    return edits;
  }

 private:
  std::set<Path> listed(Path prim) const {
    std::set<Path> all;
    for (const auto& stage : stages_) {
      const stage::Prim at = stage->prim(prim);
      for (const Path target :
           at ? at.relationship(filtered_pairs()).targets() : std::vector<Path>()) {
        all.insert(target);
      }
    }
    return all;
  }
  bool take(Path side, Path other) {
    const Path prim = filtered_prim(*pairs_.stage, *pairs_.scene, side);
    const Path target = filtered_prim(*pairs_.stage, *pairs_.scene, other);
    const bool has = listed(prim).contains(target);
    if (has) {
      taken_[prim].insert(target);
    }
    return has;
  }
  std::size_t left(Path prim) const { return listed(prim).size() - taken_.at(prim).size(); }

  /// What else keeps the two apart.
  std::string who(const PathPair& pair) const {
    const scene::PhysicsScene& scene = *pairs_.scene;
    const auto is_of = [&](const scene::Collider& collider, Path side) {
      return collider.path == side || (collider.body && scene.bodies[*collider.body].path == side);
    };
    const auto first_of = [&](Path side) {
      return std::find_if(scene.colliders.begin(), scene.colliders.end(),
                          [&](const scene::Collider& c) { return is_of(c, side); });
    };
    const auto a = first_of(pair.first);
    const auto b = first_of(pair.second);
    if (a == scene.colliders.end() || b == scene.colliders.end()) {
      return "";
    }
    const auto reasons = physics::why_apart(scene, pairs_.provenance,
                                            static_cast<Index>(a - scene.colliders.begin()),
                                            static_cast<Index>(b - scene.colliders.begin()));
    return reasons.empty() ? "" : "; " + reasons.front().why;
  }

  const PairsOfAsset& pairs_;
  const Stages& stages_;
  const EditOptions& options_;
  std::map<Path, std::set<Path>> taken_;
};

Result<void> add_removals(const std::string& path, const PairsOfAsset& pairs,
                          const std::vector<PathPair>& removed, const EditOptions& options,
                          std::vector<AssetEdit>& edits) {
  if (removed.empty()) {
    return {};
  }
  Diagnostics ignored;  // of opening: edit_asset opens again and reports
  TENON_TRY(AssetEditor editor, AssetEditor::open(path, options, ignored));
  TENON_TRY(const auto views, editor.views());
  Stages stages;
  for (const AssetEditor::View& view : views) {
    stages.push_back(view.stage);
  }
  PairRemoval removal(pairs, stages, options);
  for (const PathPair& pair : removed) {
    TENON_CHECK(removal.add(pair));
  }
  TENON_TRY(std::vector<AssetEdit> more, removal.edits());
  edits.insert(edits.end(), more.begin(), more.end());
  return {};
}

/// Each prim gets the schema and all its pairs, which are one wish. `rests`: what keeps links apart
/// as well may leave nothing to change.
void add_lists(const std::map<Path, std::set<Path>>& added, bool rests,
               std::vector<AssetEdit>& edits) {
  for (const auto& [prim, others] : added) {
    const std::size_t wish = edits.size();
    AssetEdit schema;
    schema.kind = AssetEdit::Kind::ApplyApi;
    schema.object = prim;
    schema.api = Token("PhysicsFilteredPairsAPI");
    schema.wish = wish;
    schema.may_rest = rests;
    edits.push_back(std::move(schema));
    AssetEdit list;
    list.kind = AssetEdit::Kind::AddTargets;
    list.object = prim.property(filtered_pairs());
    list.value = joined(others);
    list.wish = wish;
    list.may_rest = rests;
    edits.push_back(std::move(list));
  }
}

}  // namespace

bool PairsRequest::needs_search() const {
  return std::any_of(filter.begin(), filter.end(), is_words);
}

Result<void> check_words(const PairsRequest& request) {
  for (const std::string& text : request.filter) {
    for (const std::string& word : is_words(text) ? at_commas(text) : std::vector<std::string>()) {
      if (!is_word(word)) {
        return unknown_word(word);
      }
    }
  }
  return {};
}

Result<PairsEdits> pairs_edits(const std::string& path, const PairsOfAsset& pairs,
                               const PairsRequest& request, const EditOptions& options,
                               Diagnostics& diagnostics) {
  TENON_CHECK(check_words(request));
  PairChoice choice(pairs, options, diagnostics);
  TENON_TRY(const std::set<PathPair> chosen, choice.read(request.filter));
  std::vector<PathPair> removed;
  for (const std::string& text : request.unfilter) {
    TENON_TRY(const PathPair pair, choice.read_pair(text));
    removed.push_back(pair);
  }
  PairsEdits result;
  if (request.self_collision) {
    TENON_TRY(result.edits,
              self_collision_edits(path, *pairs.scene, *request.self_collision, options));
  }
  TENON_CHECK(add_removals(path, pairs, removed, options, result.edits));
  result.chosen = chosen.size();
  std::map<Path, std::set<Path>> added;
  for (const auto& [a, b] : chosen) {
    if (choice.sides().are_apart(a, b)) {
      ++result.filtered;
      continue;
    }
    const Path first = filtered_prim(*pairs.stage, *pairs.scene, a);
    const Path second = filtered_prim(*pairs.stage, *pairs.scene, b);
    if (first == second) {
      return Error(ErrorCode::Invalid, "both of " + named(a, RelatedRole::Collider) + " and " +
                                           named(b, RelatedRole::Collider) + " are of one body")
          .with_rule("edit.bad-argument")
          .with_fix("name two bodies");
    }
    added[first].insert(second);
  }
  const std::vector<scene::Articulation>& articulations = pairs.scene->articulations;
  const bool any_off = std::any_of(articulations.begin(), articulations.end(),
                                   [](const auto& one) { return !one.self_collision; });
  add_lists(added, any_off, result.edits);
  return result;
}

Result<std::string> srdf_of(const PairsOfAsset& pairs) {
  TENON_TRY(const LinkNames names, LinkNames::of(*pairs.scene));
  std::vector<urdf::DisabledCollision> list;
  for (const BodyPair& pair : pairs.found.pairs) {
    const std::string reason = srdf_reason(pair);
    if (!reason.empty() && names.is_body(pair.a) && names.is_body(pair.b)) {
      list.push_back({pair.a.name().str(), pair.b.name().str(), reason});
    }
  }
  const stage::Prim root = pairs.stage->default_prim();
  return urdf::write_srdf(root ? root.path().name().str() : "robot", list);
}

}  // namespace tenon
