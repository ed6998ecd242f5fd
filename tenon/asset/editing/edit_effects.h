// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "tenon/asset/edit_asset.h"
#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/physics/colliders/mesh_cache.h"
#include "tenon/physics/read_physics.h"
#include "tenon/scene/physics_scene.h"
#include "tenon/stage/stage.h"

/// What edits change in what engines receive. Internal to the wiring.
namespace tenon {

/// What engines receive under one selection of "Physics".
struct PhysicsView {
  std::string variant;
  std::shared_ptr<const stage::Stage> stage;  ///< with the edits; null before them
  scene::PhysicsScene scene;
  Diagnostics findings;  ///< of reading it
};

/// Looks at the physics under every variant before and after a call of AssetEditor::edit.
class EditEffects {
 public:
  /// Both have to live as long as this does. The editor is one that has edited nothing yet.
  EditEffects(AssetEditor& editor, const std::vector<AssetEdit>& edits);

  /// Before the edits are made. Errors: those of composing.
  Result<void> look_before();
  /// When they are made, with `asset.places` known: fills in `asset.physics`, the variants of the
  /// places and `asset.without_effect`, and says why in `diagnostics`. Tries on the way how the
  /// asset is without some of the edits; they are in force again when it returns.
  Result<void> judge(EditedAsset& asset, Diagnostics& diagnostics);

 private:
  using Views = std::vector<PhysicsView>;
  /// Edits that are made for one reason.
  struct Wish {
    std::vector<std::size_t> edits;
    std::set<Path> prims;
    bool judged = false;
    bool has_value = false;          ///< that is judged: it speaks for the schemas with it
    bool needed = false;             ///< others cannot be made without it
    std::set<std::string> variants;  ///< under which it has an effect

    bool has_effect() const { return needed || !variants.empty(); }
  };
  using Wishes = std::vector<std::size_t>;

  void find_wishes(const EditedAsset& asset);
  bool is_about_physics(const AssetEdit& edit) const;
  bool is_correction(const AssetEdit& edit) const;
  std::vector<Wishes> rounds() const;
  PhysicsView look_at(const AssetEditor::View& view);
  /// The physics as it is now, without the stages, which later edits change.
  Result<Views> look();
  /// The physics without the edits of some wishes; nullopt: the others cannot be made alone.
  std::optional<Views> look_without(const Wishes& left_out);
  Result<void> judge_wishes();
  void judge_round(const Wishes& round, bool alone);
  void judge_suspects(const Wishes& suspects);
  std::set<std::size_t> causes(const Wishes& round,
                               const std::vector<scene::SceneDifference>& found) const;
  void tell(EditedAsset& asset, Diagnostics& diagnostics) const;

  AssetEditor& editor_;
  const std::vector<AssetEdit>& edits_;
  physics::ReadOptions options_;
  physics::MeshCache meshes_;
  Views before_;
  Views after_;
  std::vector<PhysicsEffect> effects_;
  std::vector<Wish> wishes_;
  std::vector<std::size_t> wish_of_;  ///< (edit_count)
  std::set<std::size_t> judged_;      ///< edits of the physics that say something new
  bool moved_ = false;                ///< edits were taken back on the way
};

}  // namespace tenon
