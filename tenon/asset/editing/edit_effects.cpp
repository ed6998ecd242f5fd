// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A wish has an effect when engines receive something else without its edits. Reading the physics
// once for each wish would take long where there are hundreds, so they are removed together, in
// rounds in which no two are about one prim: a difference of an object is due to the wish about its
// prim, that of a pair of colliders to the one about a prim that lists one of them for the other.
// The rest is then removed all at once: where nothing differs then, none of it has an effect; else
// each half is looked at by itself. A property that composes to the value that was there before is
// not judged: it is as requested.
#include "tenon/asset/editing/edit_effects.h"

#include <algorithm>
#include <map>
#include <string_view>
#include <utility>

#include "tenon/asset/editing/edit_reason.h"
#include "tenon/asset/physics_options.h"
#include "tenon/physics/strip.h"
#include "tenon/physics/vendors/vendor_attributes.h"
#include "tenon/structure/layout.h"

namespace tenon {
namespace {

using SceneDifferences = std::vector<scene::SceneDifference>;

constexpr std::string_view kBetween = " and ";  // the two paths of a pair

/// Lists of unread properties do not affect motion.
SceneDifferences differences_between(const scene::PhysicsScene& before,
                                     const scene::PhysicsScene& after) {
  SceneDifferences found = scene::scene_differences(before, after);
  std::erase_if(found, [](const scene::SceneDifference& one) { return one.object == "not read"; });
  return found;
}

/// Under a variant that is to have physics.
bool is_composed(const EditedPlace& place, const PhysicsView& view) {
  return view.variant.empty() || (view.variant != structure::kNoVariant &&
                                  std::find(place.variants.begin(), place.variants.end(),
                                            view.variant) != place.variants.end());
}

/// Says that an edit changes nothing under a variant, once for each reason.
void tell_of(const AssetEdit& edit, const PhysicsView& view, bool elsewhere,
             Diagnostics& diagnostics) {
  Diagnostic finding = no_effect_finding(view, edit, elsewhere);
  finding.severity = elsewhere ? Severity::Warning : Severity::Error;
  finding.rule = elsewhere ? "edit.no-effect-in-variant" : "edit.no-effect";
  if (std::find(diagnostics.begin(), diagnostics.end(), finding) == diagnostics.end()) {
    diagnostics.add(std::move(finding));
  }
}

/// The prim of an object that differs, without another; of a pair of colliders each with the other.
std::vector<std::pair<Path, Path>> ends_of(const scene::SceneDifference& difference) {
  const std::size_t between = difference.path.find(kBetween);
  if (between == std::string::npos) {
    const auto path = Path::parse(difference.path);
    return path ? std::vector{std::pair(*path, Path())} : std::vector<std::pair<Path, Path>>();
  }
  const auto a = Path::parse(difference.path.substr(0, between));
  const auto b = Path::parse(difference.path.substr(between + kBetween.size()));
  return a && b ? std::vector{std::pair(*a, *b), {*b, *a}} : std::vector<std::pair<Path, Path>>();
}

/// What prims list as physics:filteredPairs, under any variant.
class FilteredPairs {
 public:
  explicit FilteredPairs(const std::vector<PhysicsView>& views) : views_(views) {}

  /// `prim` lists `other`, or something above it.
  bool lists(Path prim, Path other) {
    const auto [listed, made] = listed_.try_emplace(prim);
    for (std::size_t v = 0; made && v < views_.size(); ++v) {
      const stage::Prim at = views_[v].stage->prim(prim);
      const std::vector<Path> targets =
          at ? at.relationship(Token("physics:filteredPairs")).targets() : std::vector<Path>();
      listed->second.insert(listed->second.end(), targets.begin(), targets.end());
    }
    return std::any_of(listed->second.begin(), listed->second.end(),
                       [&](Path target) { return other.has_prefix(target); });
  }

 private:
  const std::vector<PhysicsView>& views_;
  std::map<Path, std::vector<Path>> listed_;
};

/// Being applied is all that these say.
bool makes_an_object(Token api) {
  return api == "PhysicsRigidBodyAPI" || api == "PhysicsCollisionAPI" ||
         api == "PhysicsArticulationRootAPI";
}

}  // namespace

EditEffects::EditEffects(AssetEditor& editor, const std::vector<AssetEdit>& edits)
    : editor_(editor), edits_(edits), options_(read_options()) {
  options_.mesh_cache = &meshes_;
}

PhysicsView EditEffects::look_at(const AssetEditor::View& view) {
  PhysicsView seen{view.variant, view.stage, {}, {}};
  seen.scene = physics::read_physics(*view.stage, options_, seen.findings);
  return seen;
}

Result<EditEffects::Views> EditEffects::look() {
  TENON_TRY(const auto stages, editor_.working_views());
  Views views;
  for (const AssetEditor::View& one : stages) {
    views.push_back(look_at(one));
    views.back().stage.reset();
  }
  return views;
}

Result<void> EditEffects::look_before() {
  TENON_TRY(before_, look());
  return {};
}

/// Vendors' attributes that are listed as not read, or are known to have no influence, are no
/// wishes about what engines receive; nor is all that belongs to no physics, nor tidying up.
bool EditEffects::is_about_physics(const AssetEdit& edit) const {
  if (edit.is_about_prim() || edit.may_rest) {
    return false;
  }
  // Plain MuJoCo bounds controls by it; where a servo is read as a drive, nothing here does.
  if (edit.object.is_property() && edit.object.name().view().starts_with("mjc:ctrlRange:")) {
    return false;
  }
  if (edit.is_about_api()) {
    return edit.kind == AssetEdit::Kind::ApplyApi && makes_an_object(edit.api);
  }
  const Token name = edit.object.name();
  if (edit.kind == AssetEdit::Kind::ClearProperty || !physics::is_physics_property(name.view())) {
    return false;
  }
  for (const PhysicsView& view : after_) {
    const stage::Prim prim = view.stage->prim(edit.object.prim());
    if (prim && physics::is_vendor_attribute(prim, name)) {
      return physics::use_of_vendor_attribute(prim, name) == physics::VendorUse::Read;
    }
  }
  return true;
}

/// A reader complains about the property before and not after: as a finding of `tenon check` says
/// to, a value is corrected that was replaced by the same one while it was wrong.
bool EditEffects::is_correction(const AssetEdit& edit) const {
  const auto complains = [&](const Views& views) {
    return std::any_of(views.begin(), views.end(), [&](const PhysicsView& view) {
      return std::any_of(view.findings.begin(), view.findings.end(), [&](const Diagnostic& found) {
        return found.severity != Severity::Info && found.prim == edit.object.prim().str() &&
               found.property == edit.object.name().view();
      });
    });
  };
  return !edit.is_about_api() && complains(before_) && !complains(after_);
}

void EditEffects::find_wishes(const EditedAsset& asset) {
  std::map<std::size_t, std::size_t> index;  // of wishes that have a number
  wish_of_.resize(edits_.size());
  for (std::size_t i = 0; i < edits_.size(); ++i) {
    const std::optional<std::size_t> number = edits_[i].wish;
    const auto known = number ? index.find(*number) : index.end();
    wish_of_[i] = known == index.end() ? wishes_.size() : known->second;
    if (known == index.end()) {
      wishes_.emplace_back();
    }
    if (number) {
      index.emplace(*number, wish_of_[i]);
    }
    wishes_[wish_of_[i]].edits.push_back(i);
    wishes_[wish_of_[i]].prims.insert(edits_[i].object.prim());
  }
  // What is edited again later counts as it is in the end.
  std::map<std::pair<Path, Token>, std::pair<const EditedPlace*, const EditedPlace*>> first_last;
  for (const EditedPlace& place : asset.places) {
    const AssetEdit& edit = edits_[place.edit];
    first_last.try_emplace({edit.object, edit.api}, &place, &place).first->second.second = &place;
  }
  for (const auto& [object, places] : first_last) {
    const AssetEdit& edit = edits_[places.second->edit];
    const bool new_value = edit.is_about_api() || places.first->before != places.second->after;
    if (new_value && is_about_physics(edit) && !is_correction(edit)) {
      judged_.insert(places.second->edit);
      wishes_[wish_of_[places.second->edit]].judged = true;
      wishes_[wish_of_[places.second->edit]].has_value |= !edit.is_about_api();
    }
  }
}

/// Each wish goes to the first round that has none of its prims yet.
std::vector<EditEffects::Wishes> EditEffects::rounds() const {
  std::vector<Wishes> rounds;
  std::map<Path, std::size_t> next;  // round of the next wish about a prim
  for (std::size_t i = 0; i < wishes_.size(); ++i) {
    std::size_t round = 0;
    for (const Path prim : wishes_[i].prims) {
      round = std::max(round, next[prim]);
    }
    for (const Path prim : wishes_[i].prims) {
      next[prim] = round + 1;
    }
    rounds.resize(std::max(rounds.size(), round + 1));
    rounds[round].push_back(i);
  }
  return rounds;
}

std::optional<EditEffects::Views> EditEffects::look_without(const Wishes& left_out) {
  std::set<std::size_t> gone;
  for (const std::size_t wish : left_out) {
    gone.insert(wishes_[wish].edits.begin(), wishes_[wish].edits.end());
  }
  std::vector<AssetEdit> others;
  for (std::size_t i = 0; i < edits_.size(); ++i) {
    if (!gone.contains(i)) {
      others.push_back(edits_[i]);
    }
  }
  editor_.undo();
  moved_ = true;
  Diagnostics ignored;
  if (!editor_.edit(others, ignored)) {
    return std::nullopt;
  }
  auto views = look();
  return views ? std::optional(*std::move(views)) : std::nullopt;
}

/// The wishes of a round that the differences are due to.
std::set<std::size_t> EditEffects::causes(const Wishes& round,
                                          const SceneDifferences& found) const {
  std::map<Path, std::size_t> wish_at;  // no two are about one prim
  for (const std::size_t wish : round) {
    for (const Path prim : wishes_[wish].prims) {
      wish_at[prim] = wish;
    }
  }
  std::set<std::size_t> causes;
  FilteredPairs filtered(after_);
  for (const scene::SceneDifference& one : found) {
    for (const auto& [path, other] : ends_of(one)) {
      // Bodies list each other with all that is below them.
      for (Path at = path; !at.empty(); at = other.empty() ? Path() : at.parent()) {
        const auto wish = wish_at.find(at);
        if (wish != wish_at.end() && (other.empty() || filtered.lists(at, other))) {
          causes.insert(wish->second);
        }
      }
    }
  }
  return causes;
}

/// `alone`: nothing but the round was edited, so that what was before is what is without it.
void EditEffects::judge_round(const Wishes& round, bool alone) {
  std::optional<Views> made;
  if (!alone) {
    made = look_without(round);
    if (!made) {
      return;  // judged one by one
    }
  }
  const Views& without = alone ? before_ : *made;
  for (std::size_t v = 0; v < after_.size(); ++v) {
    const SceneDifferences found =
        alone ? effects_[v].differences : differences_between(without[v].scene, after_[v].scene);
    const bool one_for_all = round.size() == 1 && !found.empty();
    for (const std::size_t i :
         one_for_all ? std::set(round.begin(), round.end()) : causes(round, found)) {
      wishes_[i].variants.insert(after_[v].variant);
    }
  }
}

/// Finds those that have an effect after all.
void EditEffects::judge_suspects(const Wishes& suspects) {
  if (suspects.empty()) {
    return;
  }
  const std::optional<Views> without = look_without(suspects);
  bool differs = !without;
  for (std::size_t v = 0; without && v < after_.size(); ++v) {
    if (!differences_between((*without)[v].scene, after_[v].scene).empty()) {
      differs = true;
      if (suspects.size() == 1) {
        wishes_[suspects.front()].variants.insert(after_[v].variant);
      }
    }
  }
  if (!differs) {
    return;
  }
  if (suspects.size() == 1) {
    wishes_[suspects.front()].needed = !without;
    return;
  }
  const auto middle = suspects.begin() + static_cast<std::ptrdiff_t>(suspects.size() / 2);
  judge_suspects(Wishes(suspects.begin(), middle));
  judge_suspects(Wishes(middle, suspects.end()));
}

Result<void> EditEffects::judge_wishes() {
  const bool any = std::any_of(effects_.begin(), effects_.end(),
                               [](const PhysicsEffect& one) { return !one.differences.empty(); });
  if (!any) {
    return {};
  }
  const std::vector<Wishes> all = rounds();
  for (const Wishes& round : all) {
    const bool wanted =
        std::any_of(round.begin(), round.end(), [&](std::size_t i) { return wishes_[i].judged; });
    if (wanted) {
      judge_round(round, all.size() == 1);
    }
  }
  Wishes suspects;
  for (std::size_t i = 0; i < wishes_.size(); ++i) {
    if (wishes_[i].judged && !wishes_[i].has_effect()) {
      suspects.push_back(i);
    }
  }
  if (wishes_.size() > 1) {
    judge_suspects(suspects);
  }
  if (moved_) {
    editor_.undo();
    Diagnostics ignored;
    TENON_CHECK(editor_.edit(edits_, ignored));
  }
  return {};
}

Result<void> EditEffects::judge(EditedAsset& asset, Diagnostics& diagnostics) {
  TENON_TRY(const auto stages, editor_.views());
  for (const AssetEditor::View& one : stages) {
    after_.push_back(look_at(one));
  }
  for (std::size_t v = 0; v < after_.size(); ++v) {
    effects_.push_back({after_[v].variant, differences_between(before_[v].scene, after_[v].scene)});
  }
  find_wishes(asset);
  TENON_CHECK(judge_wishes());
  tell(asset, diagnostics);
  asset.physics = std::move(effects_);
  return {};
}

void EditEffects::tell(EditedAsset& asset, Diagnostics& diagnostics) const {
  std::set<std::pair<std::size_t, std::string>> told;  // wish, variant
  for (EditedPlace& place : asset.places) {
    const Wish& wish = wishes_[wish_of_[place.edit]];
    const AssetEdit& edit = edits_[place.edit];
    if (!judged_.contains(place.edit) || wish.needed) {
      continue;
    }
    if (!wish.has_effect()) {
      asset.without_effect.push_back(place.edit);
    }
    for (const PhysicsView& view : after_) {
      const bool vain = !wish.variants.contains(view.variant) && is_composed(place, view) &&
                        (!edit.is_about_api() || !wish.has_value);
      if (vain && told.emplace(wish_of_[place.edit], view.variant).second) {
        tell_of(edit, view, wish.has_effect(), diagnostics);
      }
    }
    std::erase_if(place.variants,
                  [&](const std::string& one) { return !wish.variants.contains(one); });
  }
}

}  // namespace tenon
