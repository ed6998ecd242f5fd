// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "batch.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "tenon/asset/physics_options.h"
#include "tenon/asset/simulating/engine_choice.h"
#include "tenon/base/limits/engine_limits.h"
#include "tenon/make_simulation.h"
#include "tenon/physics/read_physics.h"
#include "tenon/scene/fields/scale_field.h"

namespace tenon::python {
namespace {

/// A drive that pushes away from its target is nothing to simulate.
Result<void> check_drives(const Diagnostics& found) {
  for (const Diagnostic& finding : found) {
    if (finding.rule == "drive.negative-gain") {
      return Error(ErrorCode::Invalid, finding);
    }
  }
  return {};
}

bool needs_models(const std::vector<Variation>& variations) {
  return std::any_of(variations.begin(), variations.end(), [](const Variation& variation) {
    return variation.place == VariationPlace::Field;
  });
}

/// The scene with the fields that environment i drew.
Result<std::shared_ptr<scene::PhysicsScene>> drawn_scene(const Batch& batch, std::size_t i) {
  auto own = std::make_shared<scene::PhysicsScene>(*batch.scene);
  for (std::size_t v = 0; v < batch.variations.size(); ++v) {
    if (batch.variations[v].place == VariationPlace::Field) {
      TENON_CHECK(vary_scene(batch.variations[v], batch.drawn[i][v].front(), *own));
    }
  }
  return own;
}

/// One model for each environment, of a scene of its own.
Result<engines::Environments> make_each(Batch& batch, const BatchOptions& options) {
  std::vector<engines::World> worlds;
  for (std::size_t i = 0; i < options.count; ++i) {
    TENON_TRY(auto own, drawn_scene(batch, i));
    Diagnostics again;  // what there is to say the first one says
    TENON_TRY(engines::World world, make_world(batch.engine, *own, options.simulation,
                                               i == 0 ? batch.diagnostics : again));
    batch.own_scenes.push_back(std::move(own));
    worlds.push_back(std::move(world));
  }
  return engines::Environments::of_worlds(std::move(worlds), *batch.scene, options.threads);
}

Result<engines::Environments> make_all(Batch& batch, const BatchOptions& options) {
  if (needs_models(batch.variations)) {
    return make_each(batch, options);
  }
  return make_environments(
      batch.engine, *batch.scene,
      {.count = options.count, .threads = options.threads, .simulation = options.simulation},
      batch.diagnostics);
}

Result<void> draw_all(Batch& batch, const BatchOptions& options) {
  if (options.count == 0 || options.count > limits::kEnvironments) {
    return Error(ErrorCode::Limit, std::to_string(options.count) +
                                       " environments are not between 1 and " +
                                       std::to_string(limits::kEnvironments))
        .with_rule("engine.environments");
  }
  for (const std::string& text : options.variations) {
    TENON_TRY(Variation variation, read_variation(text));
    batch.variations.push_back(std::move(variation));
  }
  batch.drawn.resize(options.count);
  for (std::size_t i = 0; i < options.count; ++i) {
    for (std::size_t v = 0; v < batch.variations.size(); ++v) {
      batch.drawn[i].push_back(tenon::drawn(batch.variations[v], options.seed, i, v));
    }
  }
  return {};
}

void list_coordinates(Batch& batch) {
  for (scene::Index j = 0; j < batch.scene->joints.size(); ++j) {
    const std::size_t count = batch.world(0).joint_state(j).position.size();
    for (std::size_t part = 0; part < count; ++part) {
      batch.coordinates.push_back({j, part});
    }
    for (std::size_t drive = 0; drive < batch.scene->joints[j].drives.size(); ++drive) {
      batch.drives.push_back({j, drive});
    }
  }
}

Result<void> write_fields(const std::vector<FieldKey>& fields, std::span<const double> row,
                          scene::PhysicsScene& scene) {
  std::size_t at = 0;
  for (const FieldKey& key : fields) {
    const Path object = Path::from(key.object);
    if (scene::set_field(key.list, key.field, object, row.subspan(at, key.count), scene) == 0) {
      return Error(ErrorCode::NotFound,
                   "<" + key.object + "> has no field " + key.field + " of as many numbers")
          .with_rule("vary.no-object")
          .with_fix("tenon physics --json lists what there is");
    }
    at += key.count;
  }
  return {};
}

}  // namespace

Result<std::unique_ptr<Batch>> Batch::make(const std::string& path, const OpenOptions& open,
                                           const physics::Readings& readings,
                                           const BatchOptions& options) {
  auto batch = std::make_unique<Batch>();
  batch->path = path;
  batch->open = with_readings(open, readings);
  TENON_TRY(stage::Stage stage, tenon::open(path, batch->open, batch->diagnostics));
  batch->stage = std::make_unique<stage::Stage>(std::move(stage));
  batch->scene = std::make_unique<scene::PhysicsScene>(
      physics::read_physics(*batch->stage, read_options(readings), batch->diagnostics));
  TENON_CHECK(check_drives(batch->diagnostics));
  TENON_CHECK(dynamics::apply_masks(options.masks, *batch->scene, batch->diagnostics));
  batch->engine = choose_engine(options.engine, *batch->stage, batch->diagnostics);
  batch->engine_version = engine_info(batch->engine).version;
  batch->simulation = options.simulation;
  batch->threads = options.threads;
  TENON_CHECK(draw_all(*batch, options));
  TENON_TRY(batch->environments, make_all(*batch, options));
  list_coordinates(*batch);
  for (std::size_t i = 0; i < batch->size(); ++i) {
    TENON_CHECK(batch->vary(i));
  }
  return batch;
}

Result<void> Batch::vary(std::size_t i) {
  for (std::size_t v = 0; v < variations.size(); ++v) {
    TENON_CHECK(vary_world(variations[v], drawn[i][v], *scene, world(i)));
  }
  return {};
}

Result<void> Batch::set_drawn(std::size_t i, std::vector<std::vector<double>> numbers) {
  const auto bad = [](const std::string& what) {
    return Error(ErrorCode::Invalid, what).with_rule("vary.bad-numbers");
  };
  if (numbers.size() != variations.size()) {
    return bad(std::to_string(numbers.size()) + " rows of numbers for " +
               std::to_string(variations.size()) + " variations");
  }
  for (std::size_t v = 0; v < numbers.size(); ++v) {
    if (numbers[v].size() != drawn[i][v].size() ||
        !std::all_of(numbers[v].begin(), numbers[v].end(),
                     [](double number) { return std::isfinite(number); })) {
      return bad("the numbers of " + variations[v].text + " are not " +
                 std::to_string(drawn[i][v].size()) + ", or not finite");
    }
    if (variations[v].place == VariationPlace::Field && numbers[v] != drawn[i][v]) {
      return bad(variations[v].text +
                 " belongs to the model, which is built once: it cannot be drawn again");
    }
  }
  drawn[i] = std::move(numbers);
  return {};
}

Result<void> Batch::set_fields(const std::vector<FieldKey>& fields,
                               std::span<const double> values) {
  const std::size_t wide = values.size() / size();
  const auto row = [&](std::size_t i) { return values.subspan(i * wide, wide); };
  const bool alike = !needs_models(variations);
  std::vector<std::shared_ptr<scene::PhysicsScene>> made;
  std::vector<engines::Environments> parts;
  for (std::size_t begin = 0, end = 0; begin < size(); begin = end) {
    do {
      ++end;
    } while (alike && end < size() && std::ranges::equal(row(end), row(begin)));
    TENON_TRY(const auto own, drawn_scene(*this, begin));
    TENON_CHECK(write_fields(fields, row(begin), *own));
    Diagnostics again;  // said when the batch was made
    TENON_TRY(auto part,
              make_environments(
                  engine, *own,
                  {.count = end - begin, .threads = threads, .simulation = simulation}, again));
    made.resize(end, own);
    parts.push_back(std::move(part));
  }
  TENON_TRY(environments, engines::Environments::joined(std::move(parts), *scene, threads));
  own_scenes = std::move(made);
  for (std::size_t i = 0; i < size(); ++i) {
    TENON_CHECK(vary(i));
  }
  return {};
}

Result<void> Batch::reset(std::size_t i) {
  TENON_CHECK(environments->reset(i));
  return vary(i);
}

}  // namespace tenon::python
