// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Each engine opens the asset for itself, because each may select a variant of its own; what their
// findings have in common is reported once. All run for the same time, which the first one decides.
#include "tenon/asset/comparing_engines/compare_engines.h"

#include <algorithm>
#include <cstdint>
#include <set>
#include <utility>

#include "tenon/asset/physics_options.h"
#include "tenon/asset/poses/start_pose.h"
#include "tenon/asset/simulating/engine_choice.h"
#include "tenon/base/limits/run_limits.h"
#include "tenon/base/text/comma_list.h"
#include "tenon/base/text/text_number.h"
#include "tenon/bytes/files.h"
#include "tenon/make_simulation.h"
#include "tenon/math/angle.h"
#include "tenon/physics/read_physics.h"
#include "tenon/watches/report_faults.h"

namespace tenon {
namespace {

using motions::Metric;

// ---- bounds

struct UnitRow {
  std::string_view text;
  double si;
  std::vector<Metric> bare;  ///< what a number with this unit alone bounds
};

const std::vector<UnitRow>& unit_rows() {
  static const std::vector<UnitRow> kRows = {
      {"um", 1e-6, {Metric::Position, Metric::JointTravel}},
      {"mm", 1e-3, {Metric::Position, Metric::JointTravel}},
      {"cm", 1e-2, {Metric::Position, Metric::JointTravel}},
      {"deg", kRadians, {Metric::Orientation, Metric::JointAngle}},
      {"rad", 1, {Metric::Orientation, Metric::JointAngle}},
      {"m", 1, {Metric::Position, Metric::JointTravel}},
      {"J", 1, {Metric::Energy}},
      {"", 1, {}},
  };
  return kRows;
}

Error bad_bound(const std::string& text) {
  const std::string names = comma_list(motions::metrics(), &motions::MetricInfo::name);
  return Error(ErrorCode::Invalid, "\"" + text + "\" is not a bound for a gap")
      .with_rule("usage.value")
      .with_fix("write a number with its unit (5mm, 1deg), or NAME=NUMBER of " + names);
}

// ---- engines

struct Wanted {
  std::string engine;
  std::string variant;
  bool has_variant = false;
};

std::vector<Wanted> wanted_engines(const CompareEnginesOptions& options) {
  std::vector<Wanted> wanted;
  for (const std::string& text : options.engines) {
    const std::size_t colon = text.find(':');
    wanted.push_back(colon == std::string::npos
                         ? Wanted{text, "", false}
                         : Wanted{text.substr(0, colon), text.substr(colon + 1), true});
  }
  const std::string first_name(options.first.empty() ? kUsualEngine : options.first);
  if (wanted.empty()) {
    for (const engines::EngineInfo& info : list_engines()) {
      if (info.available) {
        const bool first = info.name == first_name;  // what others are compared with
        wanted.insert(first ? wanted.begin() : wanted.end(), Wanted{info.name, "", false});
      }
    }
    if (!options.first.empty() && (wanted.empty() || wanted.front().engine != options.first)) {
      wanted.insert(wanted.begin(), Wanted{options.first, "", false});  // making it says why not
    }
  }
  return wanted;
}

/// Adds what is not known yet.
void add_new(const Diagnostics& found, Diagnostics& diagnostics) {
  for (const Diagnostic& finding : found) {
    const bool known =
        std::any_of(diagnostics.begin(), diagnostics.end(), [&](const Diagnostic& other) {
          return other.rule == finding.rule && other.message == finding.message &&
                 other.prim == finding.prim && other.file == finding.file &&
                 other.line == finding.line;
        });
    if (!known) {
      diagnostics.add(finding);
    }
  }
}

Result<ComparedEngine> open_for(const std::string& path, const CompareEnginesOptions& options,
                                const Wanted& wanted, Diagnostics& diagnostics) {
  Diagnostics found;
  OpenOptions open = with_readings(options.open, options.readings);
  TENON_TRY(stage::Stage stage, tenon::open(path, open, found));
  ComparedEngine compared;
  compared.variant = wanted.variant;
  const bool chosen = !open.physics_variant.empty() || !open.physics_of.empty();
  if (!wanted.has_variant) {
    compared.variant = chosen ? open.physics_variant : own_variant(wanted.engine, stage);
  }
  if (!compared.variant.empty() && compared.variant != open.physics_variant) {
    found = Diagnostics();
    open.physics_variant = compared.variant;
    open.physics_below = true;
    TENON_TRY(stage, tenon::open(path, open, found));
  }
  compared.setup.engine = wanted.engine;
  compared.setup.options.time_step = options.time_step;
  compared.setup.scene = physics::read_physics(stage, read_options(options.readings), found);
  TENON_CHECK(start_at(stage, compared.setup.scene, options.pose));
  TENON_CHECK(dynamics::apply_masks(options.masks, compared.setup.scene, found));
  compared.version = engine_info(wanted.engine).version;
  add_new(found, diagnostics);
  return compared;
}

/// Names that are unique: with the variant, else with a number.
void give_names(std::vector<ComparedEngine>& engines) {
  std::set<std::string> given;
  for (ComparedEngine& one : engines) {
    const std::string engine = one.setup.engine;
    const bool alone = std::count_if(engines.begin(), engines.end(), [&](const auto& other) {
                         return other.setup.engine == engine;
                       }) == 1;
    const std::string name = alone || one.variant.empty() ? engine : engine + ":" + one.variant;
    one.setup.name = name;
    for (int i = 2; !given.insert(one.setup.name).second; ++i) {
      one.setup.name = name + " (" + std::to_string(i) + ")";
    }
  }
}

// ---- runs

Result<void> check_size(const std::vector<ComparedEngine>& engines, double frames) {
  for (const ComparedEngine& one : engines) {
    const auto objects =
        static_cast<double>(one.setup.scene.bodies.size() + one.setup.scene.joints.size());
    TENON_CHECK(check_recorded_states(frames * objects));
  }
  return {};
}

Result<motions::MotionPlan> make_plan(const CompareEnginesOptions& options,
                                      const ComparedEngines& compared) {
  motions::MotionPlan plan;
  plan.make = [](const std::string& engine, const scene::PhysicsScene& scene,
                 const engines::SimulationOptions& simulation, Diagnostics& diagnostics) {
    return make_simulation(engine, scene, simulation, diagnostics);
  };
  plan.duration = compared.duration;
  plan.frames_per_second = compared.frames_per_second;
  if (!options.commands.empty()) {
    bytes::FileRules rules;
    rules.max_bytes = limits::kCommandBytes;
    TENON_TRY(const auto file, options.open.files->open(options.commands, rules));
    plan.commands = [file, name = options.commands](
                        const scene::PhysicsScene& scene,
                        const engines::Simulation& simulation) -> Result<bake::Commands> {
      auto commands = bake::read_commands(file, scene, simulation);
      return commands ? std::move(commands) : std::move(commands).error().in_file(name);
    };
  }
  if (options.listener.go_on) {
    plan.go_on = [&options, duration = compared.duration](double seconds) {
      return options.listener.go_on(seconds, duration);
    };
  }
  return plan;
}

void tell_next(const CompareEnginesOptions& options, const std::string& what) {
  if (options.listener.next_part) {
    options.listener.next_part(what);
  }
}

Result<void> run_all(const CompareEnginesOptions& options, const motions::MotionPlan& plan,
                     ComparedEngines& compared, Diagnostics& diagnostics) {
  for (ComparedEngine& one : compared.engines) {
    tell_next(options, "simulating on " + one.setup.name);
    Diagnostics found;
    TENON_TRY(one.motion, motions::run_motion(one.setup, plan, found));
    add_new(found, diagnostics);
    watches::report_faults(one.setup.scene, one.motion.run.faults, one.motion.run.events,
                           diagnostics, one.setup.name);
    if (one.motion.run.failure) {
      diagnostics.add(one.motion.run.failure->diagnostic());
    }
    if (one.motion.run.interrupted) {
      return {};
    }
  }
  return {};
}

void add_exceeded(const CompareEnginesOptions& options, const EnginePair& pair,
                  ComparedEngines& compared) {
  for (const GapBound& bound : options.bounds) {
    const bool over = std::any_of(pair.gaps.begin(), pair.gaps.end(), [&](const auto& gap) {
      return gap.metric == bound.metric && !(gap.largest <= bound.most);
    });
    const bool known = std::any_of(
        compared.exceeded.begin(), compared.exceeded.end(),
        [&](const GapBound& one) { return one.metric == bound.metric && one.most == bound.most; });
    if (over && !known) {
      compared.exceeded.push_back(bound);
    }
  }
}

}  // namespace

Result<std::vector<GapBound>> gap_bounds(const std::string& text) {
  const std::size_t equals = text.find('=');
  const std::string name = equals == std::string::npos ? "" : text.substr(0, equals);
  const std::string rest = equals == std::string::npos ? text : text.substr(equals + 1);
  for (const UnitRow& unit : unit_rows()) {
    if (!rest.ends_with(unit.text)) {
      continue;
    }
    const auto number = parse_double(rest.substr(0, rest.size() - unit.text.size()));
    if (!number || !(*number >= 0)) {
      continue;
    }
    std::vector<Metric> bounded = unit.bare;
    if (!name.empty()) {
      const auto metric = motions::metric_named(name);
      bounded = metric ? std::vector<Metric>{*metric} : std::vector<Metric>{};
    }
    std::vector<GapBound> bounds;
    for (const Metric metric : bounded) {
      bounds.push_back({metric, *number * unit.si, text});
    }
    return bounds.empty() ? Result<std::vector<GapBound>>(bad_bound(text)) : bounds;
  }
  return bad_bound(text);
}

bool ComparedEngines::interrupted() const {
  return std::any_of(engines.begin(), engines.end(),
                     [](const ComparedEngine& one) { return one.motion.run.interrupted; });
}

const Error* ComparedEngines::failure() const {
  for (const ComparedEngine& one : engines) {
    if (one.motion.run.failure) {
      return &*one.motion.run.failure;
    }
  }
  return nullptr;
}

Result<ComparedEngines> compare_engines(const std::string& path,
                                        const CompareEnginesOptions& options,
                                        Diagnostics& diagnostics) {
  const std::vector<Wanted> wanted = wanted_engines(options);
  if (wanted.size() < 2) {
    return Error(ErrorCode::Invalid, "there is one engine, and nothing to compare it with")
        .with_rule("compare.engines")
        .with_fix(
            "name two with --engines (mujoco:physics,mujoco:mujoco compares two variants), "
            "or build more engines: tenon doctor");
  }
  ComparedEngines compared;
  for (const Wanted& one : wanted) {
    TENON_TRY(ComparedEngine opened, open_for(path, options, one, diagnostics));
    compared.engines.push_back(std::move(opened));
  }
  give_names(compared.engines);
  compared.duration = run_duration(options.duration, compared.engines.front().setup.scene);
  compared.frames_per_second = options.frames_per_second;
  TENON_CHECK(check_size(compared.engines, compared.duration * compared.frames_per_second + 2));
  TENON_TRY(const motions::MotionPlan plan, make_plan(options, compared));
  TENON_CHECK(run_all(options, plan, compared, diagnostics));
  if (compared.interrupted()) {
    return compared;
  }
  const ComparedEngine& first = compared.engines.front();
  for (std::size_t i = 1; i < compared.engines.size(); ++i) {
    const ComparedEngine& other = compared.engines[i];
    EnginePair pair;
    pair.second = i;
    pair.gaps = motions::gaps(first.setup, first.motion, other.setup, other.motion);
    if (options.trials > 0) {
      tell_next(options, "looking for reasons");
      pair.explanation = motions::explain(first.setup, first.motion, other.setup, other.motion,
                                          plan, {options.trials});
    }
    add_exceeded(options, pair, compared);
    compared.pairs.push_back(std::move(pair));
  }
  return compared;
}

}  // namespace tenon
