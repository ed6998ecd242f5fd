// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The asset is read once. Variations that engines can set while they run leave one compiled model
// for all; a variation of a field of the scene gives each environment a scene and a model of its
// own, which are kept as long as its simulation. The digest runs over the bits of all states at
// the end, environment by environment, and so tells any difference between two runs.
#include "tenon/asset/many_environments/bench_asset.h"

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <cmath>
#include <ctime>
#include <memory>
#include <utility>

#include "tenon/asset/physics_options.h"
#include "tenon/asset/simulating/engine_choice.h"
#include "tenon/asset/simulating/simulate_asset.h"
#include "tenon/base/content_digest.h"
#include "tenon/base/parallel.h"
#include "tenon/base/system/resident_memory.h"
#include "tenon/base/text/text_number.h"
#include "tenon/make_simulation.h"
#include "tenon/physics/read_physics.h"

namespace tenon {
namespace {

using answers::Json;
using Clock = std::chrono::steady_clock;
using SceneList = std::vector<std::unique_ptr<scene::PhysicsScene>>;

double elapsed_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

bool needs_models(const BenchOptions& options) {
  return std::any_of(
      options.variations.begin(), options.variations.end(),
      [](const Variation& variation) { return variation.place == VariationPlace::Field; });
}

engines::EnvironmentOptions environment_options(const BenchOptions& options) {
  engines::EnvironmentOptions result;
  result.count = options.environments;
  result.threads = options.threads;
  result.simulation.time_step = options.time_step;
  result.simulation.methods = options.methods;
  return result;
}

/// One model for each environment, of a scene of its own.
Result<engines::Environments> make_each(const std::string& engine, const BenchOptions& options,
                                        const scene::PhysicsScene& scene, SceneList& scenes,
                                        const std::vector<EnvironmentEnd>& ends,
                                        Diagnostics& diagnostics) {
  const engines::SimulationOptions simulation = environment_options(options).simulation;
  std::vector<engines::World> worlds;
  for (std::size_t i = 0; i < options.environments; ++i) {
    scenes.push_back(std::make_unique<scene::PhysicsScene>(scene));
    for (std::size_t v = 0; v < options.variations.size(); ++v) {
      if (options.variations[v].place == VariationPlace::Field) {
        TENON_CHECK(vary_scene(options.variations[v], ends[i].numbers[v].front(), *scenes.back()));
      }
    }
    Diagnostics again;  // what there is to say the first one says
    TENON_TRY(engines::World world,
              make_world(engine, *scenes.back(), simulation, i == 0 ? diagnostics : again));
    worlds.push_back(std::move(world));
  }
  return engines::Environments::of_worlds(std::move(worlds), scene, options.threads);
}

Result<void> vary_all(const BenchOptions& options, const scene::PhysicsScene& scene,
                      const std::vector<EnvironmentEnd>& ends,
                      engines::Environments& environments) {
  for (std::size_t i = 0; i < environments.size(); ++i) {
    for (std::size_t v = 0; v < options.variations.size(); ++v) {
      TENON_CHECK(vary_world(options.variations[v], ends[i].numbers[v], scene, environments[i]));
    }
  }
  return {};
}

void add_bits(const Vec3d& v, std::string& bits) {
  for (const double number : v.v) {
    const auto word = std::bit_cast<std::array<char, sizeof(double)>>(number);
    bits.append(word.data(), word.size());
  }
}

std::uint64_t digest_of(const engines::Environments& environments,
                        const scene::PhysicsScene& scene) {
  std::string digests;
  for (std::size_t i = 0; i < environments.size(); ++i) {
    std::string bits;
    for (scene::Index b = 0; b < scene.bodies.size(); ++b) {
      const engines::BodyState state = environments[i].body_state(b);
      const Quatd& q = state.pose.orientation;
      add_bits(state.pose.position, bits);
      add_bits({{q.w, q.x, q.y}}, bits);
      add_bits({{q.z, 0, 0}}, bits);
      add_bits(state.linear_velocity, bits);
      add_bits(state.angular_velocity, bits);
    }
    const std::uint64_t digest = content_digest(bits);
    digests += std::to_string(digest) + "\n";
  }
  return content_digest(digests);
}

void step_all(const BenchOptions& options, std::size_t steps, engines::Environments& environments,
              BenchedAsset& benched) {
  const std::size_t per_call = options.steps_per_call == 0 ? steps : options.steps_per_call;
  const auto start = Clock::now();
  const std::clock_t cpu = std::clock();
  for (std::size_t done = 0; done < steps; done += per_call) {
    environments.step(std::min(per_call, steps - done));
  }
  benched.wall_seconds = elapsed_since(start);
  benched.cpu_seconds = static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC;
  for (std::size_t i = 0; i < environments.size(); ++i) {
    EnvironmentEnd& end = benched.environments[i];
    end.time = environments[i].time();
    if (const Error* failure = environments.failure(i)) {
      end.failure = *failure;
    }
    benched.steps += static_cast<std::size_t>(std::llround(end.time / benched.time_step));
  }
}

Result<std::size_t> steps_of(const BenchedAsset& benched) {
  const auto steps = static_cast<std::size_t>(std::llround(benched.duration / benched.time_step));
  if (steps == 0 && benched.duration > 0) {
    return Error(ErrorCode::Invalid, "a time step of " + shortest(benched.time_step) +
                                         " s is longer than the " + shortest(benched.duration) +
                                         " s to simulate")
        .with_rule("sim.time-step")
        .with_fix("give a smaller --dt or a longer --duration");
  }
  return steps;
}

Result<engines::Environments> make_all(const BenchOptions& options,
                                       const scene::PhysicsScene& scene, SceneList& scenes,
                                       BenchedAsset& benched, Diagnostics& diagnostics) {
  if (needs_models(options)) {
    benched.scenes = options.environments;
    return make_each(benched.engine, options, scene, scenes, benched.environments, diagnostics);
  }
  return make_environments(benched.engine, scene, environment_options(options), diagnostics);
}

}  // namespace

std::size_t BenchedAsset::failed() const {
  return static_cast<std::size_t>(
      std::count_if(environments.begin(), environments.end(),
                    [](const EnvironmentEnd& end) { return end.failure.has_value(); }));
}

Result<BenchedAsset> bench_asset(const std::string& path, const BenchOptions& options,
                                 Diagnostics& diagnostics) {
  const OpenOptions open = with_readings(options.open, options.readings);
  TENON_TRY(const stage::Stage stage, tenon::open(path, open, diagnostics));
  scene::PhysicsScene scene =
      physics::read_physics(stage, read_options(options.readings), diagnostics);
  TENON_CHECK(dynamics::apply_masks(options.masks, scene, diagnostics));
  BenchedAsset benched;
  benched.engine = choose_engine(options.engine, stage, diagnostics);
  benched.engine_version = engine_info(benched.engine).version;
  benched.environments.resize(options.environments);
  for (std::size_t i = 0; i < options.environments; ++i) {
    for (std::size_t v = 0; v < options.variations.size(); ++v) {
      benched.environments[i].numbers.push_back(drawn(options.variations[v], options.seed, i, v));
    }
  }
  const std::optional<double> before = resident_memory();
  const auto start = Clock::now();
  SceneList scenes;
  TENON_TRY(engines::Environments environments,
            make_all(options, scene, scenes, benched, diagnostics));
  TENON_CHECK(vary_all(options, scene, benched.environments, environments));
  benched.setup_seconds = elapsed_since(start);
  benched.threads = std::clamp<std::size_t>(
      options.threads == 0 ? usable_processors() : options.threads, 1, options.environments);
  benched.time_step = environments[0].time_step();
  benched.duration = run_duration(options.duration, scene);
  TENON_TRY(const std::size_t steps, steps_of(benched));
  step_all(options, steps, environments, benched);
  if (const std::optional<double> after = resident_memory(); before && after) {
    benched.bytes_per_environment = (*after - *before) / static_cast<double>(options.environments);
  }
  benched.digest = digest_of(environments, scene);
  return benched;
}

Json benched_json(const BenchedAsset& benched, const BenchOptions& options) {
  const auto per = [&](double seconds) {
    return seconds > 0 ? Json(static_cast<double>(benched.steps) / seconds) : Json(nullptr);
  };
  Json each = Json::array();
  for (const EnvironmentEnd& end : benched.environments) {
    each.push_back(
        {{"time", end.time},
         {"failure", end.failure ? Json(end.failure->diagnostic().message) : Json(nullptr)},
         {"numbers", end.numbers}});
  }
  Json variations = Json::array();
  for (const Variation& variation : options.variations) {
    variations.push_back(variation.text);
  }
  const double simulated = static_cast<double>(benched.steps) * benched.time_step;
  return {{"engine", benched.engine},
          {"engineVersion", benched.engine_version},
          {"environments", benched.environments.size()},
          {"threads", benched.threads},
          {"timeStep", benched.time_step},
          {"duration", benched.duration},
          {"steps", benched.steps},
          {"scenes", benched.scenes},
          {"setupSeconds", benched.setup_seconds},
          {"stepsPerSecond", per(benched.wall_seconds)},
          {"stepsPerCpuSecond", per(benched.cpu_seconds)},
          {"realTimeFactor",
           benched.wall_seconds > 0 ? Json(simulated / benched.wall_seconds) : Json(nullptr)},
          {"bytesPerEnvironment",
           benched.bytes_per_environment ? Json(*benched.bytes_per_environment) : Json(nullptr)},
          {"digest", std::to_string(benched.digest)},
          {"failed", benched.failed()},
          {"variations", std::move(variations)},
          {"each", std::move(each)}};
}

}  // namespace tenon
