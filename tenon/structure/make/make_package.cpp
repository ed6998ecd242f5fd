// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The views of the source are changed, split into files and stored. Then each variant is composed
// from the stored layers and compared with its view: a difference is an error, and nothing is made.
#include "tenon/structure/make/make_package.h"

#include <algorithm>
#include <optional>

#include "tenon/stage/stage.h"
#include "tenon/structure/layer_tree.h"
#include "tenon/structure/make/change_source.h"
#include "tenon/structure/make/child_order.h"
#include "tenon/structure/make/collect_assets.h"
#include "tenon/structure/make/interface_layer.h"
#include "tenon/structure/make/local_materials.h"
#include "tenon/structure/make/mesh_wrappers.h"
#include "tenon/structure/make/robot_metadata.h"
#include "tenon/structure/make/runtimes.h"
#include "tenon/structure/make/sleeping_colliders.h"
#include "tenon/structure/make/source_views.h"
#include "tenon/structure/make/split.h"
#include "tenon/structure/proof/content.h"
#include "tenon/structure/proof/proof.h"

namespace tenon::structure {
namespace {

using layer::Layer;

/// One variant of "Physics" in the making.
struct View {
  std::string variant;
  Role role = Role::Base;     ///< Base for "none"
  Layer plain;                ///< what the source has of it
  Layer content;              ///< with wrappers, local materials and robot metadata
  std::optional<Layer> over;  ///< its own layer; none: nothing to say
};

/// The physics of the source for one runtime, and what of it is said over the neutral one.
struct RuntimeView {
  const Runtime* runtime;
  Layer content;
  Layer over;
};

/// Whose content a variant holds. A variant of another name is for an unknown engine.
RoleSet roles_in(Role role) {
  switch (role) {
    case Role::Base:
      return RoleSet();
    case Role::Engine:
      return RoleSet(Role::Physics, Role::Physx, Role::Mujoco, Role::Newton);
    default:
      return RoleSet(Role::Physics, role);
  }
}

/// Wrappers and local materials: the same for all contents.
Result<void> prepare(const MeshMoves& moves, Names names, Layer& content) {
  content = moves.apply(content);
  return localize_materials(content, instance_material_scope(names));
}

View* view_of(std::vector<View>& views, std::string_view variant) {
  const auto found = std::find_if(views.begin(), views.end(),
                                  [&](const View& view) { return view.variant == variant; });
  return found == views.end() ? nullptr : &*found;
}

std::vector<const Layer*> contents_of(const std::vector<View>& views) {
  std::vector<const Layer*> all;
  for (const View& view : views) {
    if (view.role != Role::Base) {
      all.push_back(&view.content);
    }
  }
  all.push_back(&views.front().content);
  return all;
}

/// The originals to verify a package against.
struct Wanted {
  const AssetSource& source;
  const SourceViews& sources;
  const std::vector<View>& views;
  const std::vector<RuntimeView>& runtimes;
  const MeshMoves& moves;
  const std::set<Path>& colliders;
  const KinematicOrder& order;
  const CollectedAssets& assets;
  Names names;
};

/// Opens a package under each variant and compares content and physics with the originals.
class Prover {
 public:
  Prover(const StructuredAsset& asset, const Wanted& wanted, const ContentPhysics& physics)
      : asset_(asset), wanted_(wanted), physics_(physics) {}

  Result<void> run() const {
    for (const View& view : wanted_.views) {
      TENON_CHECK(prove(view));
    }
    for (const RuntimeView& runtime : wanted_.runtimes) {
      TENON_CHECK(prove(runtime));
    }
    for (const OtherVariant& other : wanted_.sources.others) {
      TENON_CHECK(prove(other));
    }
    return {};
  }

 private:
  std::string chosen_variant() const {
    const std::string& chosen = wanted_.sources.physics[wanted_.sources.chosen].variant;
    return chosen.empty() ? asset_.selection : chosen;
  }

  Result<stage::Stage> open_view(const std::string& set, const std::string& variant) const {
    std::map<std::string, std::string> selections;
    for (const std::string& other : wanted_.sources.set_order) {
      selections[other] = "";
    }
    selections[std::string(kPhysicsSet)] = chosen_variant();
    selections[set] = variant;
    return open_package(asset_.package, selections, wanted_.source.max_work);
  }

  Result<void> prove(const View& view) const {
    TENON_TRY(const stage::Stage stage, open_view(std::string(kPhysicsSet), view.variant));
    {
      TENON_TRY(const Layer found, content_of(stage));  // as large as the asset
      const Layer wanted = with_collected_assets(view.content, wanted_.assets);
      if (const auto where = compare_contents(wanted, found)) {
        return differs("Physics=" + view.variant, *where, "the stage");
      }
    }
    if (view.role == Role::Base) {
      return {};  // has none
    }
    TENON_TRY(const scene::PhysicsScene before, physics_.of(view.plain));
    const auto where = compare_physics(before, physics_.of(stage),
                                       [this](Path path) { return wanted_.moves.moved(path); });
    return where ? Result<void>(differs("Physics=" + view.variant, *where, "the physics"))
                 : Result<void>();
  }

  Result<void> prove(const RuntimeView& view) const {
    const std::string set(view.runtime->set);
    std::map<std::string, std::string> selections{
        {std::string(kPhysicsSet), std::string(role_name(Role::Physics))},
        {set, std::string(kEnabled)}};
    for (const std::string& other : wanted_.sources.set_order) {
      selections.emplace(other, "");
    }
    TENON_TRY(const stage::Stage stage,
              open_package(asset_.package, selections, wanted_.source.max_work));
    TENON_TRY(Layer found, content_of(stage));
    const auto where = compare_contents(with_collected_assets(view.content, wanted_.assets), found);
    return where ? Result<void>(differs(set + "=" + std::string(kEnabled), *where, "the stage"))
                 : Result<void>();
  }

  Result<void> prove(const OtherVariant& other) const {
    const std::string chosen = chosen_variant();
    const auto view = std::find_if(wanted_.views.begin(), wanted_.views.end(),
                                   [&](const View& at) { return at.variant == chosen; });
    const Role role = view == wanted_.views.end() ? Role::Base : view->role;
    Layer plain = other.content;
    TENON_CHECK(prepare(wanted_.moves, wanted_.names, plain));
    keep_roles(plain, roles_in(role));
    add_robot_metadata(plain, wanted_.order);
    if (role == Role::Base) {
      put_to_sleep(plain, wanted_.colliders);
    }
    TENON_TRY(const stage::Stage stage, open_view(other.set, other.variant));
    TENON_TRY(Layer found, content_of(stage));
    keep_roles(found, roles_in(role));
    if (!wanted_.runtimes.empty()) {  // which Newton's schemas are in
      drop_newton(plain);
      drop_newton(found);
    }
    const auto where = compare_contents(with_collected_assets(plain, wanted_.assets), found);
    return where ? Result<void>(differs(other.set + "=" + other.variant, *where, "the stage"))
                 : Result<void>();
  }

  const StructuredAsset& asset_;
  const Wanted& wanted_;
  const ContentPhysics& physics_;
};

class Maker {
 public:
  Maker(const AssetSource& source, const StructureOptions& options, Diagnostics& diagnostics)
      : source_(source), options_(options), diagnostics_(diagnostics), physics_(source) {}

  Result<StructuredAsset> run() {
    TENON_TRY(sources_, read_views(source_, diagnostics_));
    add_engines();
    TENON_CHECK(change_generation(sources_, options_.schema, physics_, diagnostics_));
    TENON_TRY(links_, move_links(sources_, options_.links, physics_, diagnostics_));
    if (options_.simready) {
      TENON_TRY(united_, change_for_simready(sources_, physics_));
    }
    make_views();
    make_runtimes();
    TENON_CHECK(give_wrappers());
    make_base();
    make_overs();
    TENON_CHECK(make_other_variants());
    TENON_CHECK(make_files());
    make_interface();
    list_moves();
    assets_ = collect_assets(source_, options_.names, asset_.package, diagnostics_);
    TENON_CHECK(store_layers(asset_.package));
    drop_parts();
    const Wanted wanted{source_,    sources_, views_,  runtimes_,     *moves_,
                        colliders_, order_,   assets_, options_.names};
    TENON_CHECK(Prover(asset_, wanted, physics_).run());
    return std::move(asset_);
  }

 private:
  // The variants and what the source has of them.

  void add_view(const std::string& variant, Role role, const Layer& from) {
    View& view = views_.emplace_back(View{variant, role, from, Layer(from.identifier()), {}});
    keep_roles(view.plain, roles_in(role));
    view.content = view.plain;
  }

  const SourceView& chosen() const { return sources_.physics[sources_.chosen]; }

  /// A view of the source with content of this owner, the chosen one first.
  const SourceView* view_with(Role owner) const {
    if (has_content_of(chosen().content, owner)) {
      return &chosen();
    }
    for (const SourceView& view : sources_.physics) {
      if (has_content_of(view.content, owner)) {
        return &view;
      }
    }
    return nullptr;
  }

  /// Engines that are asked for start with what is for all of them.
  void add_engines() {
    for (const std::string& engine : options_.engines) {
      if (sources_.find(engine) == nullptr) {
        Layer content = chosen().content;
        const Role role = role_of_physics_variant(engine);
        keep_roles(content, role == Role::Engine ? RoleSet(Role::Physics) : roles_in(role));
        sources_.physics.push_back({engine, std::move(content)});
      }
    }
  }

  void make_views() {
    const SourceView* none = sources_.find(kNoVariant);
    add_view(std::string(kNoVariant), Role::Base, (none != nullptr ? *none : chosen()).content);
    for (const Role role : {Role::Physics, Role::Mujoco, Role::Newton, Role::Physx}) {
      const std::string variant(role_name(role));
      const SourceView* view = sources_.find(variant);
      view = view != nullptr ? view : view_with(role);
      const bool wanted = options_.all_engines && (role == Role::Physx || role == Role::Mujoco);
      view = view == nullptr && wanted ? view_with(Role::Physics) : view;
      if (view != nullptr) {
        add_view(variant, role, view->content);
      }
    }
    for (const SourceView& view : sources_.physics) {
      const bool engine = role_of_physics_variant(view.variant) == Role::Engine;
      if (engine && view.variant != kNoVariant && !view.variant.empty()) {
        add_view(view.variant, Role::Engine, view.content);
      }
    }
  }

  /// Each runtime starts with its own set of the source, else with its variant of "Physics", else
  /// with what is for all engines. That is neutral from then on.
  void make_runtimes() {
    View* physics = view_of(views_, role_name(Role::Physics));
    if (!options_.simready || physics == nullptr) {
      return;
    }
    for (const Runtime& runtime : known_runtimes()) {
      const Layer* own = enabled_content(sources_.others, runtime);
      const SourceView* view = sources_.find(role_name(runtime.role));
      view = view != nullptr ? view : view_with(runtime.role);
      view = view != nullptr ? view : view_with(Role::Physics);
      Layer content = own != nullptr ? *own : view->content;
      keep_roles(content, roles_in(runtime.role));
      runtimes_.push_back({&runtime, std::move(content), Layer("anon:over.usda")});
    }
    std::erase_if(sources_.others,
                  [](const OtherVariant& other) { return is_runtime_set(other.set); });
    drop_newton(physics->plain);
    drop_newton(physics->content);
  }

  // Wrappers, local materials, metadata: the same for all.

  Result<void> give_wrappers() {
    TENON_TRY(moves_, MeshMoves::of(unite(contents_of(views_))));
    for (View& view : views_) {
      TENON_CHECK(prepare(*moves_, options_.names, view.content));
    }
    for (RuntimeView& view : runtimes_) {
      TENON_CHECK(prepare(*moves_, options_.names, view.content));
    }
    if (!runtimes_.empty()) {
      drop_material_physics(views_.front().content);
    }
    const View* physics = views_.size() > 1 ? &views_[1] : nullptr;
    if (physics == nullptr) {
      return {};
    }
    TENON_TRY(const scene::PhysicsScene scene, physics_.of(physics->content));
    order_ = kinematic_order(physics->content, scene);
    for (View& view : views_) {
      add_robot_metadata(view.content, order_);
      identify(view.content, order_, options_.robot_type, options_.simready.has_value());
    }
    for (RuntimeView& view : runtimes_) {
      add_robot_metadata(view.content, order_);
      identify(view.content, order_, options_.robot_type, options_.simready.has_value());
      view.content = runtime_content(*view.runtime, std::move(view.content));
    }
    if (options_.simready) {
      TENON_TRY(const stage::Stage stage, physics_.stage_of(physics->content));
      AssetFacts facts = *options_.simready;
      facts.name = facts.name.empty() ? interface_name() : facts.name;
      metadata_ = simready_metadata(facts, physics->content, stage, scene);
      tell_runtimes(metadata_, Path::absolute_root().child(sources_.robot));
    }
    return {};
  }

  // What all share, and what each lays over it.

  void make_base() {
    colliders_ = pure_colliders(unite(contents_of(views_)));
    base_ = views_.front().content;
    put_to_sleep(base_, colliders_);
    put_to_sleep(views_.front().content, colliders_);
    for (const View& view : views_) {
      fill_sleeping(base_, view.content, colliders_);
    }
    put_robot_order_first(base_);
    const View* physics = view_of(views_, role_name(Role::Physics));
    for (View& view : views_) {
      if (physics != nullptr && view.role != Role::Physics) {
        order_like(view.content, physics->content);  // what the engine's layer is put over
      }
      order_like(view.content, base_);
    }
    for (RuntimeView& view : runtimes_) {
      order_like(view.content, physics->content);
      order_like(view.content, base_);
    }
  }

  void make_overs() {
    const View* physics = view_of(views_, role_name(Role::Physics));
    Layer neutral = base_;
    for (View& view : views_) {
      if (view.role == Role::Base) {
        continue;
      }
      Layer over = difference(view.role == Role::Physics || physics == nullptr ? base_ : neutral,
                              view.content, identifier_in_package(file_of(view)));
      note_touched(over);
      // Engines of the source keep a layer, so that there is one to edit.
      const bool kept = is_engine(view.role) && sources_.find(view.variant) != nullptr &&
                        physics != nullptr && physics->over;
      if (kept || !prims_below(over).empty()) {
        view.over = std::move(over);
      }
      if (view.role == Role::Physics) {
        neutral = view.content;
        add_sleeping(neutral, base_);
      }
    }
    for (RuntimeView& view : runtimes_) {
      view.over =
          difference(neutral, view.content, identifier_in_package(std::string(view.runtime->file)));
      make_prim(view.over, Path::absolute_root().child(sources_.robot));
      note_touched(view.over);
    }
  }

  void note_touched(const Layer& over) {
    for (const Path& prim : prims_below(over)) {
      split_.touched.insert(prim);
    }
  }

  Result<void> make_other_variants() {
    if (sources_.others.empty()) {
      return {};
    }
    Layer weak = chosen().content;
    TENON_CHECK(prepare(*moves_, options_.names, weak));
    for (const OtherVariant& other : sources_.others) {
      Layer strong = other.content;
      TENON_CHECK(prepare(*moves_, options_.names, strong));
      order_like(strong, base_);
      const std::string name = file_of_variant(other.set, other.variant);
      Layer over = difference(weak, strong, identifier_in_package(name));
      note_touched(over);
      const bool empty = prims_below(over).empty();
      interface_.others.push_back({other.set, other.variant, empty ? "" : name});
      if (!empty) {
        other_files_.emplace(name, std::move(over));
      }
    }
    return {};
  }

  std::string file_of(const View& view) const {
    return file_of_variant(std::string(kPhysicsSet), view.variant);
  }

  Result<void> make_files() {
    split_.names = options_.names;
    if (options_.overridable_colliders) {
      split_.overridable = colliders_;
    }
    TENON_TRY(BaseFiles files, split_base(base_, split_));
    if (!files.robot.children(Path::absolute_root(), "primChildren").empty()) {
      files.base.root().set("subLayers", std::vector<std::string>{relative_name(
                                             Role::Base, Role::Robot, options_.names)});
    }
    put(Role::Base, std::move(files.base));
    put(Role::Robot, std::move(files.robot));
    put(Role::Instances, std::move(files.instances));
    put(Role::Geometries, std::move(files.geometries));
    put(Role::Materials, std::move(files.materials));
    const View* physics = view_of(views_, role_name(Role::Physics));
    for (View& view : views_) {
      if (!view.over) {
        continue;
      }
      if (view.role != Role::Physics && physics != nullptr && physics->over) {
        view.over->root().set("subLayers", std::vector<std::string>{"./physics.usda"});
      }
      put_file(file_of(view), *view.over, true);
    }
    for (const RuntimeView& view : runtimes_) {
      put_file(std::string(view.runtime->file), view.over, true);
    }
    for (const auto& [name, layer] : other_files_) {
      put_file(name, layer, true);
    }
    return {};
  }

  void put(Role role, Layer layer) {
    const bool empty = prims_below(layer).empty() && role != Role::Base;
    if (empty && (!options_.simready || root_scope(role).empty())) {
      return;
    }
    if (empty) {  // SimReady looks for the file
      define_prim(layer, Path::absolute_root().child(Token(std::string(root_scope(role)))),
                  "Scope");
    }
    put_file(file_name(role, options_.names), std::move(layer), root_scope(role).empty());
  }

  void put_file(const std::string& name, Layer layer, bool of_robot) {
    put_stage_metadata(base_, layer, of_robot);
    PackageFile file;
    file.format = role_of_file_name(name) == Role::Geometries ? formats::LayerFormat::Crate
                                                              : formats::LayerFormat::Text;
    file.layer = std::make_shared<Layer>(std::move(layer));
    asset_.package.files[name] = std::move(file);
  }

  /// The file that a variant's payload leads to; empty for none.
  std::string payload_of(const View& view) {
    const View* physics = view_of(views_, role_name(Role::Physics));
    const bool engine = view.role != Role::Base && physics != nullptr && physics->over;
    return view.over ? file_of(view) : (engine ? file_of(*physics) : "");
  }

  std::string interface_name() const {
    return options_.name.empty() ? sources_.robot.str() : options_.name;
  }

  void make_interface() {
    interface_.robot = sources_.robot;
    interface_.base = file_name(Role::Base, options_.names);
    for (const View& view : views_) {
      interface_.physics.push_back({std::string(kPhysicsSet), view.variant, payload_of(view)});
      asset_.physics_variants.push_back(view.variant);
    }
    asset_.selection = selection();
    for (const OtherVariant& other : sources_.others) {  // sets of no variant have no place
      const auto selected = sources_.other_selections.find(other.set);
      if (selected != sources_.other_selections.end()) {
        interface_.selections.insert(*selected);
      }
    }
    interface_.selections[std::string(kPhysicsSet)] = asset_.selection;
    for (const RuntimeView& view : runtimes_) {
      const std::string set(view.runtime->set);
      interface_.runtimes.push_back({set, std::string(kDisabled), ""});
      interface_.runtimes.push_back({set, std::string(kEnabled), std::string(view.runtime->file)});
      interface_.selections[set] = kDisabled;
    }
    const std::string name = interface_name();
    asset_.package.interface = name + ".usda";
    Layer layer = interface_layer(base_, interface_, identifier_in_package(name + ".usda"));
    if (options_.simready) {
      add_metadata(layer, metadata_);
    }
    PackageFile file;
    file.layer = std::make_shared<Layer>(std::move(layer));
    asset_.package.files[asset_.package.interface] = std::move(file);
  }

  /// Below the default prim came what was beside it, then links moved, then meshes got wrappers.
  void list_moves() {
    const std::map<Path, Path> moved = links_ ? links_->all() : std::map<Path, Path>();
    const std::map<Path, Path> links = first_places(moved);
    const std::map<Path, Path> tops = first_places(sources_.moved);
    for (const auto& [from, to] : moved) {
      asset_.moved.emplace(first_place(from, tops), to);
    }
    for (const auto& [from, to] : united_) {
      asset_.moved.emplace(first_place(first_place(from, links), tops), moves_->moved(to));
    }
    for (const auto& [from, to] : moves_->all()) {
      asset_.moved.emplace(first_place(first_place(from, links), tops), to);
    }
    for (const auto& [from, to] : sources_.moved) {
      asset_.moved.emplace(from, links_ ? links_->moved(to) : to);
    }
  }

  /// The source's, where it leads to something; else the strongest that does.
  std::string selection() {
    if (!runtimes_.empty()) {
      return std::string(role_name(Role::Physics));  // for no engine, as each has its own set
    }
    if (view_of(views_, sources_.selection) != nullptr) {
      return sources_.selection;
    }
    for (const std::string_view variant : known_physics_variants()) {
      std::string name(variant);
      const View* view = view_of(views_, name);
      if (view != nullptr && view->over && !prims_below(*view->over).empty()) {
        return name;
      }
    }
    return views_.back().over ? views_.back().variant : std::string(kNoVariant);
  }

  /// Layers that the proof does not need.
  void drop_parts() {
    for (SourceView& view : sources_.physics) {
      view.content = Layer("");
    }
    base_ = views_.front().plain = Layer("");
    other_files_.clear();
  }

  const AssetSource& source_;
  const StructureOptions& options_;
  Diagnostics& diagnostics_;
  SourceViews sources_;
  std::vector<View> views_;  // "none" first, then "physics" where it is
  std::vector<RuntimeView> runtimes_;
  layer::Dictionary metadata_;
  std::optional<LinkMoves> links_;
  std::map<Path, Path> united_;  // colliders and what is drawn in their place
  std::optional<MeshMoves> moves_;
  std::set<Path> colliders_;
  KinematicOrder order_;
  Layer base_{"anon:base.usda"};
  SplitOptions split_;
  std::map<std::string, Layer> other_files_;
  InterfaceParts interface_;
  CollectedAssets assets_;
  StructuredAsset asset_;
  ContentPhysics physics_;
};

}  // namespace

Result<StructuredAsset> make_package(const AssetSource& source, const StructureOptions& options,
                                     Diagnostics& diagnostics) {
  return Maker(source, options, diagnostics).run();
}

}  // namespace tenon::structure
