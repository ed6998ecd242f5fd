// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tenon/asset/edited_file.h"
#include "tenon/base/diagnostics.h"
#include "tenon/base/path.h"
#include "tenon/base/result.h"
#include "tenon/layer/arcs.h"
#include "tenon/layer/layer.h"
#include "tenon/mesh/mesh_scene.h"
#include "tenon/open_stage.h"
#include "tenon/scene/fields/scene_difference.h"
#include "tenon/stage/stage.h"

/// Edits of assets in files: each goes to the file that owns the changed property.
namespace tenon {

/// What an arc brings to a prim.
struct AssetArc {
  enum class Kind : unsigned char { Reference, Payload, Inherit, Specialize };

  Kind kind = Kind::Reference;
  std::string file{};           ///< absolute; the layer names it from its own folder. Empty: the
                                ///< stage itself, as for inherits and specializes
  Path prim{};                  ///< empty: the default prim of the file
  layer::LayerOffset offset{};  ///< of references and payloads: their time in that of the stage
  bool first = false;           ///< stronger than those of its kind that the layer has; else weaker
};

/// A variant that an edit goes into, whichever is selected. The variant may be new.
struct VariantPlace {
  Path prim;
  std::string set;
  std::string variant;
};

/// The geometry of a prim of type Mesh that is made.
struct MeshGeometry {
  mesh::PolygonMesh shape;    ///< in units and axes of the stage
  std::vector<Vec3f> colors;  ///< linear; none, one for all, or (face_count)
  std::string about;          ///< where it comes from, in words
};

/// One edit of something of the composed scene.
struct AssetEdit {
  enum class Kind : unsigned char {
    SetProperty,
    ClearProperty,
    ApplyApi,
    RemoveApi,
    AddTargets,        ///< to what a relationship has
    RemoveTargets,     ///< of a relationship, also from weaker layers; from `layer` where tidy
    Connect,           ///< an attribute to `targets`, all that feed it then
    DefinePrim,        ///< of type `type_name`, below a prim that is there, with what `arc` brings
    AddVariant,        ///< `value` is SET=VARIANT
    AddArc,            ///< `arc`
    RemoveArc,         ///< the same, whatever its offset; from the strongest file that has it
    SelectVariant,     ///< `value` is SET=VARIANT; SET= for none, SET for what weaker files select
    OrderChildren,     ///< `names` come first, in this order
    OrderProperties,   ///< the same
    SetMetadata,       ///< `field`, or its entry `key`, of a prim or property, to `value`
    ClearMetadata,     ///< the same, in the strongest file that says it
    RemoveVariant,     ///< the same, from all own files; a set goes with its last one
    RemovePrim,        ///< from all own files, and from every list of targets in them
    RenamePrim,        ///< `value` is the new name, also for all that names the prim in own files
    RenameProperty,    ///< the same of a property
    SetStageMetadata,  ///< `field` of the root layer; the object is "/"
  };

  Kind kind = Kind::SetProperty;
  Path object;        ///< a property; for API schemas, prims and variants a prim
  std::string value;  ///< of an attribute as text layers print it, quotes and @ optional,
                      ///< "None" blocks; of a relationship: paths, all that it has then, or those
                      ///< to add or remove
  Token api;          ///< "PhysicsMassAPI", "PhysicsDriveAPI:angular"
  Token field;        ///< of the stage: "metersPerUnit"; of a prim or property: "kind"
  Token type_name;    ///< of an attribute that no schema and no layer knows: makes it; of a prim
  std::string engine{};  ///< its file alone, whatever EditOptions::engine says
  std::string layer{};   ///< this file alone, by its identifier, its path or the end of it
  /// Edits of one number are one wish, which has an effect when one of them has one; none: a wish
  /// of its own.
  std::optional<std::size_t> wish{};

  std::optional<double> time{};  ///< [time codes] SetProperty, ClearProperty: of this sample alone
  std::string key{};             ///< of metadata: an entry, "a:b" for b in the dictionary a
  std::vector<Path> targets{};   ///< absolute
  std::vector<Token> names{};
  std::optional<VariantPlace> inside{};  ///< in the file that has the variant
  std::optional<AssetArc> arc{};
  std::shared_ptr<const MeshGeometry> mesh{};  ///< what a prim of type Mesh that is made shows
  bool tidy = false;                           ///< removing takes specs along that say nothing then
  bool may_rest = false;  ///< nothing that engines receive has to change by it alone

  bool is_about_api() const { return kind == Kind::ApplyApi || kind == Kind::RemoveApi; }
  bool is_about_metadata() const {
    return kind == Kind::SetMetadata || kind == Kind::ClearMetadata;
  }
  /// About a prim or its variants as a whole.
  bool is_about_prim() const {
    return kind >= Kind::DefinePrim && kind != Kind::RenameProperty &&
           !(is_about_metadata() && object.is_property());
  }
  /// About what a property or metadata has, which is proved to be so.
  bool is_about_value() const {
    return (kind <= Kind::Connect && !is_about_api()) || is_about_metadata();
  }
  /// In all files of the asset at once.
  bool is_about_specs() const { return kind >= Kind::RemoveVariant; }
};

struct EditOptions {
  OpenOptions open;   ///< with a physics_variant the edit has to count there
  std::string layer;  ///< this file alone, by its path or the end of it
  /// "physx", "mujoco", "newton" or another variant: its file. For these three the file and the
  /// variant are made where an asset of the structure 3.0 has none.
  std::string engine;
};

/// Where an edit went.
struct EditedPlace {
  std::size_t edit = 0;  ///< index into the edits
  std::string file;
  std::uint32_t line = 0;  ///< in the new text; 0 for binary layers
  Path spec;               ///< in that layer
  std::string why;         ///< this file and no other
  std::string before;      ///< composed value, as text; empty when there was none
  std::string after;
  /// Of "Physics" in which it counts: for what engines receive those where they receive something
  /// else now, for all else those where it is composed. Empty: no such set.
  std::vector<std::string> variants;
};

/// What engines receive differently under one variant of "Physics".
struct PhysicsEffect {
  std::string variant;  ///< empty: there is no such set
  std::vector<scene::SceneDifference> differences;
};

struct EditedAsset {
  std::vector<EditedPlace> places;     ///< one for each edit; none for schemas applied already, of
                                       ///< edits in all files one for each file
  std::vector<EditedFile> files;       ///< that differ, sorted by path
  std::vector<PhysicsEffect> physics;  ///< the variant in which the asset opens first
  /// Edits of the physics that change nothing that engines receive, under no variant. Findings of
  /// the rule "edit.no-effect" say why.
  std::vector<std::size_t> without_effect;
};

/// Edits of an asset in its files, with undo. Composes the asset under every selection of
/// "Physics"; all of them look at the same layers, which edits change in memory. No file is
/// touched.
///
/// In an asset of the structure 3.0 (tenon/structure/layout.h) an edit goes to the file that owns
/// the property or API schema; what instances share to the file of the instances; with
/// `options.engine` to that engine's file. Elsewhere to the strongest layer with an opinion, else
/// to the root layer. It authors the same opinions as edit::StageEditor.
class AssetEditor {
 public:
  /// Errors: those of tenon::open, and Unsupported for assets in packages.
  static Result<AssetEditor> open(const std::string& path, const EditOptions& options,
                                  Diagnostics& diagnostics);
  AssetEditor(AssetEditor&&) noexcept;
  AssetEditor& operator=(AssetEditor&&) noexcept;
  ~AssetEditor();

  /// All edits as one step of the history, or none of them. Each is verified: the scene is composed
  /// again, and where the value is not the requested one, nothing is changed. Errors:
  /// ErrorCode::NotFound (prim, property, file), Invalid (types, values, an opinion elsewhere is
  /// stronger), Unsupported (files in packages). Diagnostics: "edit.hidden-in-variant",
  /// "edit.has-samples".
  Result<std::vector<EditedPlace>> edit(const std::vector<AssetEdit>& edits,
                                        Diagnostics& diagnostics);
  bool undo();  ///< false when there is nothing to take back
  bool redo();
  /// How often undo() would find something. Edits that change nothing are no steps.
  std::size_t step_count() const;

  /// What all edits in force make of the files, those that differ alone, sorted by path.
  Result<std::vector<EditedFile>> files() const;
  /// The scene under one selection of "Physics", with all edits in force.
  struct View {
    std::string variant;  ///< empty: there is no such set
    std::shared_ptr<const stage::Stage> stage;
  };
  /// As the asset opens, then under the other selections. The stages stay as they are.
  Result<std::vector<View>> views();
  /// The same for who looks after each of many edits: the stages change with the edits to come, and
  /// what was looked up in them holds until the next one.
  Result<std::vector<View>> working_views();
  /// A layer as it is now; null when the asset has none of that identifier.
  layer::LayerPtr layer(const std::string& identifier) const;

 private:
  class State;
  explicit AssetEditor(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

/// What the edits make of the asset's files, as one call: open, edit, files, and what engines
/// receive before and after under every variant of "Physics". `write_files` of edited_file.h writes
/// them. Diagnostics also: "edit.no-effect", an error, and "edit.no-effect-in-variant".
Result<EditedAsset> edit_asset(const std::string& path, const std::vector<AssetEdit>& edits,
                               const EditOptions& options, Diagnostics& diagnostics);

}  // namespace tenon
