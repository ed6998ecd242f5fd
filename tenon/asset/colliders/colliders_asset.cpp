// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Physics is read as the asset is; once more with every mesh as triangles, for what colliders stand
// for; and again for each other approximation, as it would be read after the edit. A budget asks
// for what is cheap first, and for convex decompositions, which take seconds each, only of meshes
// that nothing cheaper keeps to.
#include "tenon/asset/colliders/colliders_asset.h"

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include "tenon/asset/colliders/resting_depths.h"
#include "tenon/asset/physics_options.h"
#include "tenon/asset/simulating/engine_choice.h"
#include "tenon/base/text/name_pattern.h"
#include "tenon/make_simulation.h"
#include "tenon/physics/contents/read_approximated.h"
#include "tenon/used_shapes.h"

namespace tenon {
namespace {

using engines::UsedShape;
using scene::Approximation;
using scene::Collider;
using scene::PhysicsScene;
using Choices = std::map<Path, Approximation>;

/// The rows of one engine.
class ColliderTable {
 public:
  ColliderTable(const stage::Stage& stage, const CollidersOptions& options)
      : stage_(stage), options_(options), reading_(read_options()) {}

  Result<CollidersOfEngine> run(const std::string& engine, Diagnostics& diagnostics) {
    result_.engine = engine;
    result_.version = engine_info(engine).version;
    add_rows(physics::read_physics(stage_, reading_, diagnostics));
    TENON_CHECK(select());
    read_meshes();
    Choices choices;
    if (options_.instead) {
      for (const ColliderRow& row : result_.rows) {
        if (row.is_mesh) {
          choices.emplace(row.path, *options_.instead);
        }
      }
    } else if (options_.budget) {
      TENON_TRY(choices, choose());
    }
    TENON_CHECK(fill(choices));
    return std::move(result_);
  }

 private:
  void add_rows(const PhysicsScene& scene) {
    for (const Collider& collider : scene.colliders) {
      ColliderRow row;
      row.path = collider.path;
      if (collider.body) {
        row.body = scene.bodies[*collider.body].path;
      }
      row.moves = scene.is_dynamic(collider.body);
      row.asked = collider.approximation;
      result_.rows.push_back(std::move(row));
    }
  }

  /// Leaves the rows that patterns mean.
  Result<void> select() {
    if (options_.colliders.empty()) {
      return {};
    }
    std::set<Path> meant;
    for (const std::string& text : options_.colliders) {
      TENON_TRY(const NamePattern pattern, NamePattern::parse(text));
      const std::size_t before = meant.size();
      bool any = false;
      for (const ColliderRow& row : result_.rows) {
        if (pattern.matches(row.path) || (!row.body.empty() && pattern.matches(row.body))) {
          meant.insert(row.path);
          any = true;
        }
      }
      if (!any && meant.size() == before) {
        return Error(ErrorCode::NotFound, "no collider, and no body of one, is \"" + text + "\"")
            .with_rule("colliders.none")
            .with_fix("give a name, a path, or a regular expression for the whole of either");
      }
    }
    std::erase_if(result_.rows, [&](const ColliderRow& row) { return !meant.contains(row.path); });
    return {};
  }

  PhysicsScene read_as(const physics::AskedApproximation& asked) const {
    Diagnostics told_already;
    return physics::read_approximated(stage_, reading_, asked, told_already);
  }
  PhysicsScene read_as(const Choices& choices) const {
    return read_as([&choices](const stage::Prim& prim) -> std::optional<Approximation> {
      const auto found = choices.find(prim.path());
      return found == choices.end() ? std::nullopt : std::optional(found->second);
    });
  }

  void read_meshes() {
    const PhysicsScene scene = read_as([](const stage::Prim&) { return Approximation::None; });
    std::map<Path, const Collider*> colliders;
    for (const Collider& collider : scene.colliders) {
      colliders[collider.path] = &collider;
    }
    for (ColliderRow& row : result_.rows) {
      const auto found = colliders.find(row.path);
      if (found == colliders.end() || !found->second->approximation) {
        continue;
      }
      row.is_mesh = true;
      const MeshOfCollider mesh = mesh_of_collider(*found->second, scene);
      row.size = approximate::diagonal_of(mesh.mesh);
      meshes_.emplace(row.path, mesh);
    }
  }

  /// The figures of the rows in a scene that was read for them, by path; of what engines use.
  Result<std::map<Path, ColliderFigures>> figures(const PhysicsScene& scene,
                                                  const std::set<Path>& wanted) const {
    TENON_TRY(const std::vector<UsedShape> shapes, used_shapes(result_.engine, scene));
    std::map<Path, ColliderFigures> found;
    for (std::size_t i = 0; i < scene.colliders.size(); ++i) {
      const Collider& collider = scene.colliders[i];
      if (!wanted.contains(collider.path)) {
        continue;
      }
      const auto mesh = meshes_.find(collider.path);
      found[collider.path] = collider_figures(collider, scene, shapes[i],
                                              mesh == meshes_.end() ? nullptr : &mesh->second);
      if (options_.progress) {
        options_.progress(found.size(), wanted.size());
      }
    }
    return found;
  }

  // ---- a budget

  bool keeps_to_budget(const ColliderRow& row, const ColliderFigures& figures) const {
    const double gap = options_.budget->gap.value_or(kGapShare * row.size);
    return figures.used != "none" && figures.cost <= options_.budget->cost && figures.gap &&
           figures.gap->largest() + figures.gap->error <= gap;
  }

  struct Chosen {
    Approximation as = Approximation::None;
    std::size_t cost = 0;
  };

  /// Offers an approximation to rows without one, or that have a dearer one.
  Result<void> offer(Approximation as, const std::set<Path>& rows,
                     std::map<Path, Chosen>& chosen) const {
    if (rows.empty()) {
      return {};
    }
    Choices choices;
    for (const Path& path : rows) {
      choices.emplace(path, as);
    }
    TENON_TRY(const auto found, figures(read_as(choices), rows));
    for (const ColliderRow& row : result_.rows) {
      const auto it = found.find(row.path);
      if (it == found.end() || !keeps_to_budget(row, it->second)) {
        continue;
      }
      const auto [known, is_new] = chosen.try_emplace(row.path, Chosen{as, it->second.cost});
      if (!is_new && it->second.cost < known->second.cost) {
        known->second = {as, it->second.cost};
      }
    }
    return {};
  }

  template <class Wanted>
  std::set<Path> rows_where(Wanted wanted) const {
    std::set<Path> paths;
    for (const ColliderRow& row : result_.rows) {
      // Of what an instancer repeats there is no prim to edit.
      if (row.is_mesh && stage_.prim(row.path) && wanted(row)) {
        paths.insert(row.path);
      }
    }
    return paths;
  }

  Result<Choices> choose() {
    std::map<Path, Chosen> chosen;
    const std::set<Path> all = rows_where([](const ColliderRow&) { return true; });
    for (const Approximation as :
         {Approximation::BoundingSphere, Approximation::BoundingCube, Approximation::ConvexHull}) {
      TENON_CHECK(offer(as, all, chosen));
    }
    for (const Approximation as : {Approximation::ConvexDecomposition,
                                   Approximation::MeshSimplification, Approximation::None}) {
      const bool of_all = as == Approximation::ConvexDecomposition;
      TENON_CHECK(offer(as, rows_where([&](const ColliderRow& row) {
                          return !chosen.contains(row.path) && (of_all || !row.moves);
                        }),
                        chosen));
    }
    Choices choices;
    for (ColliderRow& row : result_.rows) {
      const auto found = chosen.find(row.path);
      if (found != chosen.end()) {
        choices.emplace(row.path, found->second.as);
      } else {
        row.over_budget = all.contains(row.path);
      }
    }
    return choices;
  }

  // ---- what is printed

  Result<void> fill(const Choices& choices) {
    const PhysicsScene scene = read_as(choices);
    std::set<Path> paths;
    for (const ColliderRow& row : result_.rows) {
      paths.insert(row.path);
    }
    TENON_TRY(auto found, figures(scene, paths));
    const std::vector<RestingDepth> depths = resting_depths(scene);
    std::map<Path, std::size_t> index;
    for (std::size_t i = 0; i < scene.colliders.size(); ++i) {
      index[scene.colliders[i].path] = i;
    }
    for (ColliderRow& row : result_.rows) {
      const auto choice = choices.find(row.path);
      row.as = choice == choices.end() ? row.asked : std::optional(choice->second);
      row.figures = std::move(found[row.path]);
      const auto at = index.find(row.path);
      if (depths.empty() || at == index.end()) {
        continue;
      }
      const RestingDepth& depth = depths[at->second];
      row.penetration = depth.depth;
      if (depth.depth > 0) {
        row.penetrated = scene.colliders[depth.with].path;
      }
    }
    return {};
  }

  const stage::Stage& stage_;
  const CollidersOptions& options_;
  physics::ReadOptions reading_;
  std::map<Path, MeshOfCollider> meshes_;
  CollidersOfEngine result_;
};

Result<std::vector<std::string>> engines_to_ask(const CollidersOptions& options,
                                                const stage::Stage& stage,
                                                Diagnostics& diagnostics) {
  if (options.engine != "all") {
    return std::vector<std::string>{choose_engine(options.engine, stage, diagnostics)};
  }
  if (options.budget) {
    return Error(ErrorCode::Invalid, "a budget chooses by the shapes of one engine, not of all")
        .with_rule("colliders.engines")
        .with_fix("name one with --engine");
  }
  return available_engines();
}

}  // namespace

bool ColliderRow::changes() const {
  if (!asked || !as || *as == *asked) {
    return false;
  }
  // Of a body that moves these are its hull as they are.
  const bool was_hull =
      moves && (*asked == Approximation::None || *asked == Approximation::MeshSimplification);
  return !(was_hull && *as == Approximation::ConvexHull);
}

Result<CollidersOfAsset> colliders_of_asset(const std::string& path,
                                            const CollidersOptions& options,
                                            Diagnostics& diagnostics) {
  TENON_TRY(const stage::Stage stage, tenon::open(path, options.open, diagnostics));
  TENON_TRY(const std::vector<std::string> engines, engines_to_ask(options, stage, diagnostics));
  CollidersOfAsset found;
  found.budget = options.budget;
  for (const std::string& engine : engines) {
    OpenOptions open = options.open;
    const std::string variant = select_own_variant(engine, stage, open);
    Diagnostics told_already;
    std::optional<stage::Stage> own;  // where the engine has a variant of its own
    if (variant != options.open.physics_variant) {
      TENON_TRY(own, tenon::open(path, open, told_already));
    }
    Diagnostics& findings = found.engines.empty() ? diagnostics : told_already;
    TENON_TRY(CollidersOfEngine one,
              ColliderTable(own ? *own : stage, options).run(engine, findings));
    one.variant = variant;
    found.engines.push_back(std::move(one));
  }
  return found;
}

std::vector<std::string> collider_requests(const CollidersOfAsset& found) {
  std::vector<std::string> requests;
  if (!found.budget) {
    return requests;
  }
  for (const CollidersOfEngine& engine : found.engines) {
    for (const ColliderRow& row : engine.rows) {
      if (row.changes()) {
        requests.push_back(row.path.str() + "=" + std::string(scene::approximation_name(*row.as)));
      }
    }
  }
  return requests;
}

}  // namespace tenon
