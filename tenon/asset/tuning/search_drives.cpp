// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Scenes of a search are copies of those that the engines run: with a point mass on a body, which
// changes its mass, centre and inertia, and with its bodies at a drawn posture. Frequency and ratio
// are of the load that the table shows, that of the start without payload.
#include "tenon/asset/tuning/search_drives.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include "tenon/asset/poses/reach_targets.h"
#include "tenon/asset/tuning/search_scenes.h"
#include "tenon/base/limits/tuning_limits.h"
#include "tenon/base/text/rounded_text.h"
#include "tenon/base/text/text_number.h"
#include "tenon/dynamics/drawn_postures.h"
#include "tenon/dynamics/posture_text.h"
#include "tenon/make_simulation.h"
#include "tenon/math/inertia.h"

namespace tenon {
namespace {

using tuning::SearchScene;

std::string_view unpadded(std::string_view text) {
  while (!text.empty() && text.front() == ' ') {
    text.remove_prefix(1);
  }
  while (!text.empty() && text.back() == ' ') {
    text.remove_suffix(1);
  }
  return text;
}

/// A number that `unit` may follow.
std::optional<double> number_with(std::string_view text, std::string_view unit) {
  text = unpadded(text);
  if (text.ends_with(unit)) {
    text = unpadded(text.substr(0, text.size() - unit.size()));
  }
  const auto number = parse_double(text);
  return number && std::isfinite(*number) && *number >= 0 ? number : std::nullopt;
}

/// A point mass at `place` of the body's frame.
void add_payload(scene::Body& body, double mass, const Vec3d& place) {
  const double sum = body.mass + mass;
  const Vec3d center = (body.center_of_mass * body.mass + place * mass) * (1 / sum);
  const Mat3d own = shift_inertia(body.inertia, body.mass, center - body.center_of_mass);
  body.inertia = shift_inertia(own, mass, center - place);
  body.center_of_mass = center;
  body.mass = sum;
}

/// Where payloads are.
struct PayloadPlace {
  Path body;
  Vec3d place;  ///< in the frame of the body [m]
};

class Scenes {
 public:
  Scenes(const SearchRequest& request, const std::optional<PayloadPlace>& place)
      : request_(request), place_(place) {}

  /// All of one engine go behind the others.
  Result<void> add(const TunedEngine& engine, std::vector<SearchScene>& scenes) const {
    const scene::PhysicsScene& own = *engine.scene;
    TENON_TRY(const std::vector<dynamics::Posture> postures, postures_in(own));
    std::vector<double> payloads = request_.payloads;
    if (payloads.empty()) {
      payloads.push_back(0);
    }
    for (const double payload : payloads) {
      for (std::size_t pose = 0; pose < postures.size() + 1; ++pose) {
        auto scene = std::make_unique<scene::PhysicsScene>(
            request_.poses > 0 ? tuning::without_self_collision(own) : own);
        if (pose > 0) {
          dynamics::start_from(*scene, dynamics::Multibody(*scene), postures[pose - 1]);
        }
        TENON_CHECK(load(*scene, payload));
        SearchScene& made = scenes.emplace_back();
        made.engine = engine.engine;
        made.name = name_of(engine.engine, payload, pose);
        made.rows = drive_rows_of(*scene);
        made.scene = std::move(scene);
        made.make = [name = engine.engine](const scene::PhysicsScene& of,
                                           const engines::SimulationOptions& simulation) {
          Diagnostics ignored;  // those of the asset are told where it opens
          return make_simulation(name, of, simulation, ignored);
        };
      }
    }
    return {};
  }

 private:
  Result<std::vector<dynamics::Posture>> postures_in(const scene::PhysicsScene& scene) const {
    const dynamics::Multibody multibody(scene);
    const dynamics::DrawnPostures drawn(multibody);
    std::vector<dynamics::Posture> postures;
    for (std::uint64_t i = 0; i < limits::kDrawnForPoses && postures.size() < request_.poses; ++i) {
      dynamics::Posture posture = drawn.draw(request_.seed, i);
      if (drawn.is_possible(posture)) {
        postures.push_back(std::move(posture));
      }
    }
    if (postures.size() < request_.poses) {
      return Error(ErrorCode::Invalid, "too few drawn poses keep its loops and limits: " +
                                           std::to_string(postures.size()) + " of " +
                                           std::to_string(limits::kDrawnForPoses))
          .with_rule("tune.search-poses")
          .with_fix("search at fewer poses");
    }
    return postures;
  }

  Result<void> load(scene::PhysicsScene& scene, double payload) const {
    if (!place_ || payload == 0) {
      return {};
    }
    for (scene::Body& body : scene.bodies) {
      if (body.path == place_->body) {
        add_payload(body, payload, place_->place);
        return {};
      }
    }
    return Error(ErrorCode::NotFound, "the engine's variant has no such body")
        .with_prim(place_->body.str())
        .with_rule("tune.search-body")
        .with_fix("name a link that all engines have");
  }

  std::string name_of(const std::string& engine, double payload, std::size_t pose) const {
    std::string name = engine;
    name += request_.payloads.empty() ? "" : ", " + rounded_text(payload, 4) + " kg";
    name += request_.poses == 0 ? "" : pose == 0 ? ", start" : ", pose " + std::to_string(pose);
    return name;
  }

  const SearchRequest& request_;
  const std::optional<PayloadPlace>& place_;
};

Result<void> check_count(const SearchRequest& request, std::size_t engines) {
  const std::size_t payloads = std::max<std::size_t>(request.payloads.size(), 1);
  if (payloads > limits::kSearchScenes || request.poses >= limits::kSearchScenes ||
      engines * payloads * (request.poses + 1) > limits::kSearchScenes) {
    return Error(ErrorCode::Limit, "payloads, poses and engines make more than " +
                                       std::to_string(limits::kSearchScenes) + " scenes")
        .with_rule("tune.search-scenes")
        .with_fix("give fewer --payload or --poses, or one --engine");
  }
  return {};
}

/// The row of a scene that is of this drive.
std::optional<std::size_t> row_in(const SearchScene& scene, const TunedDrive& drive) {
  for (std::size_t r = 0; r < scene.rows.size(); ++r) {
    const tuning::DriveRow& row = scene.rows[r];
    if (scene.scene->joints[row.joint].path == drive.joint && row.dof == drive.row.dof &&
        row.position_drive()) {
      return r;
    }
  }
  return std::nullopt;
}

/// Which drives are searched, by their place in the table; the rows of each in all scenes.
std::vector<tuning::SearchedDrive> searched_drives(const TunedAsset& tuned,
                                                   const std::vector<SearchScene>& scenes,
                                                   std::vector<SearchedRow>& found) {
  std::vector<tuning::SearchedDrive> drives;
  for (std::size_t i = 0; i < tuned.drives.size(); ++i) {
    const TunedDrive& drive = tuned.drives[i];
    if (!drive.asked || !drive.row.position_drive()) {
      continue;
    }
    tuning::SearchedDrive searched{drive.row.load, {}};
    bool any = false;
    for (const SearchScene& scene : scenes) {
      searched.rows.push_back(row_in(scene, drive));
      any = any || searched.rows.back();
    }
    if (any) {
      found.push_back({i, {}});
      drives.push_back(std::move(searched));
    }
  }
  return drives;
}

tuning::SearchOptions search_options(const TuneOptions& options, const TunedAsset& tuned,
                                     const std::vector<SearchedRow>& rows) {
  tuning::SearchOptions search;
  search.goal = options.search->goal;
  search.time_step = options.time_step;
  search.amplitude = options.test_options.amplitude.value_or(search.amplitude);
  search.go_on = options.listener.go_on;
  if (options.listener.next_part) {
    search.next_drive = [&](std::size_t i) {
      options.listener.next_part("searching gains of " +
                                 tuned.drives[rows[i].drive].joint.name().str());
    };
  }
  return search;
}

}  // namespace

bool TunedSearch::all_met() const {
  return std::all_of(drives.begin(), drives.end(),
                     [](const SearchedRow& row) { return row.found.met; });
}

Result<double> overshoot_named(const std::string& text) {
  const auto percent = number_with(text, "%");
  if (!percent || *percent >= 100) {
    return Error(ErrorCode::Invalid, "\"" + text + "\" is no overshoot from 0 to below 100 %")
        .with_rule("usage.value")
        .with_fix("write 1 or 1% of the step");
  }
  return *percent / 100;
}

Result<std::vector<double>> payloads_named(const std::vector<std::string>& texts) {
  std::vector<double> payloads;
  for (const std::string& text : texts) {
    const auto payload = number_with(text, "kg");
    if (!payload || *payload > 1e6) {
      return Error(ErrorCode::Invalid, "\"" + text + "\" is no payload of 0 to 1000000 kg")
          .with_rule("usage.value")
          .with_fix("write masses with commas between, such as 0,0.5");
    }
    payloads.push_back(*payload);
  }
  return payloads;
}

Result<TunedSearch> search_drives(const TuneOptions& options, const stage::Stage& stage,
                                  const TunedAsset& tuned,
                                  const std::vector<TunedEngine>& engines) {
  TunedSearch search;
  search.request = *options.search;
  TENON_CHECK(check_count(search.request, engines.size()));
  std::optional<PayloadPlace> place;
  if (!search.request.at.empty()) {
    TENON_TRY(const PlacedPrim prim, placed_prim(stage, *tuned.scene, search.request.at));
    place = PayloadPlace{tuned.scene->bodies[prim.target.body].path, prim.target.frame.position};
  }
  std::vector<SearchScene> scenes;
  for (const TunedEngine& engine : engines) {
    search.engines.push_back(engine.engine);
    TENON_CHECK(Scenes(search.request, place).add(engine, scenes));
  }
  search.scene_count = scenes.size();
  const auto drives = searched_drives(tuned, scenes, search.drives);
  if (drives.empty()) {
    return Error(ErrorCode::NotFound, "no joint that was asked for has a drive with a stiffness")
        .with_rule("tune.nothing-to-search")
        .with_fix("give it one first: tenon set ASSET --drive JOINT=stiffness:100,damping:10");
  }
  TENON_TRY(tuning::GainSearchResult result,
            tuning::search_gains(scenes, drives, search_options(options, tuned, search.drives)));
  search.interrupted = result.interrupted;
  for (std::size_t i = 0; i < result.drives.size(); ++i) {
    search.drives[i].found = std::move(result.drives[i]);
  }
  if (search.interrupted) {
    search.drives.clear();
  }
  return search;
}

}  // namespace tenon
