// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A cause is a pair of setups without it. What an engine cannot express is reset in both scenes by
// the name that the engine gives it; what layers say differently is taken over from one to the
// other, in the other direction where that changes nothing (an engine may not read the field);
// what an engine chose is undone on its side; and of the step the half is taken, whose gain counts
// twice, as the error of every engine here is of first order. A motion that a trial leaves as it
// was is not run again.
#include "tenon/motions/reasons.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tenon/base/function.h"
#include "tenon/motions/engine_choices.h"
#include "tenon/motions/gaps.h"
#include "tenon/scene/check_scene.h"
#include "tenon/scene/fields/scene_difference.h"
#include "tenon/scene/fields/scene_patch.h"

namespace tenon::motions {
namespace {

struct Sides {
  Setup a;
  Setup b;
  bool a_changed = false;
  bool b_changed = false;
};

/// Takes a cause away; false where it cannot.
using TakeAway = Function<bool(Sides& sides)>;

struct Cause {
  Reason reason;
  std::vector<TakeAway> ways;  ///< the next one where one does not matter
  double gain = 1;             ///< of what the distance loses
  std::size_t best = 0;        ///< into ways
};

// ---- what an engine cannot express

struct MissingGroup {
  std::string property;
  std::string why;
  std::vector<Path> prims;
};

std::vector<MissingGroup> missing_of(const Motion& one, const Motion& other) {
  const auto other_lacks = [&other](const engines::NotMapped& item) {
    return std::any_of(other.not_mapped.begin(), other.not_mapped.end(),
                       [&](const engines::NotMapped& its) {
                         return its.prim == item.prim && its.property == item.property;
                       });
  };
  std::vector<MissingGroup> groups;
  for (const engines::NotMapped& item : one.not_mapped) {
    if (other_lacks(item)) {
      continue;
    }
    auto found = std::find_if(groups.begin(), groups.end(), [&](const MissingGroup& group) {
      return group.property == item.property && group.why == item.why;
    });
    if (found == groups.end()) {
      found = groups.insert(groups.end(), {item.property, item.why, {}});
    }
    found->prims.push_back(item.prim);
  }
  return groups;
}

/// "torsionalFriction, rollingFriction" are two.
std::vector<std::string> properties_of(const std::string& list) {
  std::vector<std::string> properties;
  std::size_t begin = 0;
  while (begin <= list.size()) {
    const std::size_t comma = std::min(list.find(", ", begin), list.size());
    properties.push_back(list.substr(begin, comma - begin));
    begin = comma + 2;
  }
  return properties;
}

bool reset_all(const MissingGroup& group, scene::PhysicsScene& scene) {
  bool done = false;
  for (const Path prim : group.prims) {
    for (const std::string& property : properties_of(group.property)) {
      for (const scene::FieldPatch& patch : scene::fields_named(scene, prim, property)) {
        done = scene::reset(patch, scene) || done;
      }
    }
  }
  return done;
}

void add_missing(const Setup& setup, const Motion& one, const Motion& other,
                 std::vector<Cause>& causes) {
  for (const MissingGroup& group : missing_of(one, other)) {
    Cause cause;
    cause.reason = {ReasonKind::NotMapped, setup.name,  group.why,
                    group.property,        group.prims, std::nullopt};
    cause.ways.push_back([group](Sides& sides) {
      sides.a_changed = reset_all(group, sides.a.scene);
      sides.b_changed = reset_all(group, sides.b.scene);
      return sides.a_changed || sides.b_changed;
    });
    causes.push_back(std::move(cause));
  }
}

// ---- what the layers say

std::string side_text(const scene::Fact& fact) {
  const std::string text = fact_text(fact);
  const std::size_t name = fact.name.size();
  return fact.name.empty() ? "nothing" : text.size() > name ? text.substr(name + 1) : "none";
}

/// What taking it over changes, in words: the first fact and how many more there are.
std::string patch_text(const scene::FieldPatch& patch, const Setup& a, const Setup& b,
                       const scene::PhysicsScene& patched) {
  const auto facts = scene::scene_differences(patched, b.scene, {.motion_alone = true});
  std::string field = patch.field.empty() ? patch.list : patch.list + " " + patch.field;
  if (facts.empty()) {
    return field;
  }
  const scene::SceneDifference& first = facts.front();
  const std::string& name = first.before.name.empty() ? first.after.name : first.before.name;
  const std::string more =
      facts.size() > 1 ? " (and " + std::to_string(facts.size() - 1) + " more)" : "";
  if (name.empty()) {
    return first.object + " that " + (first.change == Change::Removed ? a.name : b.name) +
           "'s layer alone has" + more;
  }
  return name + ": " + side_text(first.before) + " for " + a.name + ", " + side_text(first.after) +
         " for " + b.name + more;
}

void add_layers(const Setup& a, const Setup& b, std::vector<Cause>& causes) {
  for (const scene::FieldPatch& patch : scene::field_patches(a.scene, b.scene)) {
    Sides sides{a, b};
    const bool can = scene::take_over(patch, sides.a.scene, sides.b.scene);
    Cause cause;
    const std::string what = patch.field.empty() && can
                                 ? patch.list + " that one of the layers alone has"
                                 : patch_text(patch, a, b, sides.b.scene);
    const std::string property = patch.field.empty() ? patch.list : patch.list + "." + patch.field;
    cause.reason = {ReasonKind::Layer, "", what, property, patch.objects, std::nullopt};
    if (can) {
      cause.ways.push_back([patch](Sides& both) {
        both.a_changed = patch.field.empty();
        both.b_changed = true;
        return scene::take_over(patch, both.a.scene, both.b.scene);
      });
      cause.ways.push_back([patch](Sides& both) {
        both.b_changed = patch.field.empty();
        both.a_changed = true;
        return scene::take_over(patch, both.b.scene, both.a.scene);
      });
    }
    causes.push_back(std::move(cause));
  }
}

// ---- what engines chose, and the step

/// What both chose alike is no cause.
void add_choices(const Setup& setup, const Setup& other, const Motion& motion, bool of_a,
                 std::vector<Cause>& causes) {
  for (const EngineChoice& choice : engine_choices()) {
    const bool made = choice.engine == setup.engine && choice.is_made(setup);
    if (!made || (other.engine == setup.engine && choice.is_made(other))) {
      continue;
    }
    Cause cause;
    cause.reason = {ReasonKind::EngineChoice,     setup.name, std::string(choice.what),
                    std::string(choice.property), {},         std::nullopt};
    cause.ways.push_back([&choice, of_a, step = motion.time_step](Sides& sides) {
      choice.undo(of_a ? sides.a : sides.b, step);
      (of_a ? sides.a_changed : sides.b_changed) = true;
      return true;
    });
    causes.push_back(std::move(cause));
  }
}

void add_step(const Motion& a, const Motion& b, std::vector<Cause>& causes) {
  Cause cause;
  cause.reason = {ReasonKind::TimeStep, "", "the time step: half of it halves the gap", "--dt", {},
                  std::nullopt};
  cause.gain = 2;
  cause.ways.push_back([a_step = a.time_step, b_step = b.time_step](Sides& sides) {
    sides.a.options.time_step = a_step / 2;
    sides.b.options.time_step = b_step / 2;
    sides.a_changed = sides.b_changed = true;
    return true;
  });
  causes.push_back(std::move(cause));
}

// ---- trials

class Trials {
 public:
  Trials(const Setup& a, const Motion& a_motion, const Setup& b, const Motion& b_motion,
         const MotionPlan& plan, Explanation& explanation)
      : a_(a), a_motion_(a_motion), b_(b), b_motion_(b_motion), plan_(plan), told_(explanation) {
    plan_.duration = std::min(plan.duration, told_.until + 1 / plan.frames_per_second);
  }

  /// The part of the distance that goes with these ways; none where a run fails.
  std::optional<double> share(const std::vector<TakeAway>& ways) {
    Sides sides{a_, b_};
    bool a_changed = false;
    bool b_changed = false;
    for (const TakeAway& way : ways) {
      sides.a_changed = sides.b_changed = false;
      if (!way(sides)) {
        return std::nullopt;
      }
      a_changed = a_changed || sides.a_changed;
      b_changed = b_changed || sides.b_changed;
    }
    std::optional<Motion> a_run;
    std::optional<Motion> b_run;
    if ((a_changed && !run(sides.a, a_run)) || (b_changed && !run(sides.b, b_run))) {
      return std::nullopt;
    }
    const double left = distance(sides.a, a_run ? *a_run : a_motion_, sides.b,
                                 b_run ? *b_run : b_motion_, told_.until);
    return 1 - left / told_.distance;
  }

  /// The best of the ways of a cause; stops at the first one that matters.
  void measure(Cause& cause) {
    for (std::size_t i = 0; i < cause.ways.size(); ++i) {
      const auto found = share({cause.ways[i]});
      if (!found) {
        continue;
      }
      const double part = std::min(1.0, *found * cause.gain);
      if (!cause.reason.share || part > *cause.reason.share) {
        cause.reason.share = part;
        cause.best = i;
      }
      if (part >= kShareThatMatters) {
        return;
      }
    }
  }

 private:
  bool run(const Setup& setup, std::optional<Motion>& motion) {
    if (!scene::check_scene(setup.scene)) {
      return false;  // what else belongs to the cause did not come along
    }
    Diagnostics unheard;
    auto made = run_motion(setup, plan_, unheard);
    if (!made || made->run.failure || made->run.interrupted) {
      return false;
    }
    motion = *std::move(made);
    return true;
  }

  const Setup& a_;
  const Motion& a_motion_;
  const Setup& b_;
  const Motion& b_motion_;
  MotionPlan plan_;
  const Explanation& told_;
};

void rank(std::vector<Cause>& causes, Trials& trials, Explanation& told) {
  std::stable_sort(causes.begin(), causes.end(), [](const Cause& x, const Cause& y) {
    return x.reason.share.value_or(-1) > y.reason.share.value_or(-1);
  });
  std::vector<TakeAway> all;
  for (Cause& cause : causes) {
    const std::optional<double> share = cause.reason.share;
    const bool matters = share && *share >= kShareThatMatters;
    if (matters && cause.reason.kind != ReasonKind::TimeStep) {
      all.push_back(cause.ways[cause.best]);
    }
    if (matters || (!share && cause.reason.kind != ReasonKind::EngineChoice &&
                    cause.reason.kind != ReasonKind::TimeStep)) {
      told.reasons.push_back(std::move(cause.reason));
    } else {
      ++told.no_matter;
    }
  }
  if (all.size() > 1) {
    told.together = trials.share(all);
  }
}

}  // namespace

std::string_view reason_name(ReasonKind kind) {
  constexpr std::string_view kNames[] = {"notMapped", "layer", "engineChoice", "timeStep"};
  return kNames[static_cast<std::size_t>(kind)];
}

Explanation explain(const Setup& a, const Motion& a_motion, const Setup& b, const Motion& b_motion,
                    const MotionPlan& plan, const ExplainOptions& options) {
  Explanation told;
  told.until = moment_of_largest_distance(a, a_motion, b, b_motion);
  told.distance = distance(a, a_motion, b, b_motion, told.until);
  if (!(told.distance > kNoDistance)) {
    return told;
  }
  std::vector<Cause> causes;
  add_missing(a, a_motion, b_motion, causes);
  add_missing(b, b_motion, a_motion, causes);
  add_layers(a, b, causes);
  add_choices(a, b, a_motion, true, causes);
  add_choices(b, a, b_motion, false, causes);
  add_step(a_motion, b_motion, causes);
  if (causes.size() > options.max_trials) {
    told.untried = causes.size() - options.max_trials;
    causes.resize(options.max_trials);
  }
  Trials trials(a, a_motion, b, b_motion, plan, told);
  for (Cause& cause : causes) {
    trials.measure(cause);
  }
  rank(causes, trials, told);
  return told;
}

}  // namespace tenon::motions
