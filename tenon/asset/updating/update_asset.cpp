// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A file is known by its digest in three states: as it was made, as it is, as it would be made now.
// Where two of them are the same the third decides, and its bytes stand as they are. Layers that
// differ in all three are merged. A prim that stays in one layer because of an edit stays in all,
// so layers are merged a second time where there is one. Notes are those of the new conversion,
// alone: a later run still sees what was edited. Where an edit stays in a conflict, the copy for
// later runs keeps the old value, so that they find the conflict again.
#include "tenon/asset/updating/update_asset.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include "tenon/answers/opinions.h"
#include "tenon/asset/updating/base_copy.h"
#include "tenon/asset/updating/follow_moves.h"
#include "tenon/asset/updating/kept_base.h"
#include "tenon/base/content_digest.h"
#include "tenon/base/file_finding.h"
#include "tenon/bytes/file_bytes.h"
#include "tenon/diff/layer_difference.h"
#include "tenon/formats/open_layer.h"
#include "tenon/layer/fields.h"
#include "tenon/structure/written_note.h"

namespace tenon {
namespace {

using diff::MergeConflict;
using Bytes = std::shared_ptr<const bytes::FileBytes>;

/// One file in its three states.
struct FileStates {
  std::string name;
  std::optional<std::uint64_t> base;
  Bytes present;
  Bytes made;
  layer::LayerPtr made_layer;
  bool is_edited = false;
  bool is_changed = false;  ///< by the source
};

Result<Bytes> bytes_if_there(const std::string& path) {
  auto bytes = bytes::FileBytes::open(path);
  if (!bytes && bytes.error().code() == ErrorCode::NotFound) {
    return Bytes();
  }
  return bytes;
}

Error no_base(const std::string& folder, const std::string& opening) {
  return Error(ErrorCode::Invalid,
               "the asset was edited since it was made, and its former state is unknown: " +
                   structure::copy_place(opening) + " is missing, or is that of another version")
      .in_file(folder + '/' + opening)
      .with_rule("update.no-base")
      .with_fix(
          "bring that file back, or convert into a new folder and take the edits over that "
          "`tenon diff` shows; --force without --update overwrites them");
}

/// A copy and a note come with the asset: what they name is looked at, and may go, in its folder.
Result<void> check_inside(const structure::Digests& files, const std::string& place) {
  for (const auto& [name, digest] : files) {
    const std::filesystem::path path(name);
    if (name.empty() || !path.is_relative() || path.lexically_normal() != path ||
        *path.begin() == "..") {
      return Error(ErrorCode::Corrupt,
                   "its note lists a file outside of the asset's folder: " + name)
          .in_file(place)
          .with_rule("update.no-base")
          .with_fix("convert into a new folder");
    }
  }
  return {};
}

/// The copy beside the asset, or one of the asset itself where it is as it was made.
Result<BaseCopy> base_of(const std::string& folder, const std::string& opening) {
  TENON_TRY(std::optional<BaseCopy> known, read_base(folder, opening));
  if (known) {
    return *std::move(known);
  }
  const structure::WrittenState state = structure::written_state(folder + '/' + opening);
  if (!state.noted || !state.edited.empty()) {
    return no_base(folder, opening);
  }
  BaseCopy copy;
  for (const std::string& name : state.written) {
    TENON_TRY(const Bytes bytes, bytes_if_there(folder + '/' + name));
    if (bytes != nullptr) {
      copy.digests.emplace(name, name == opening ? structure::own_digest(bytes->text(), name)
                                                 : content_digest(bytes->text()));
    }
  }
  return copy;
}

class AssetUpdate {
 public:
  AssetUpdate(const structure::Package& made, std::string folder, const UpdateChoice& choice,
              Diagnostics& diagnostics)
      : made_(made),
        folder_(std::move(folder)),
        keep_(choice.keep),
        settles_(choice.settles),
        diagnostics_(diagnostics) {}

  Result<UpdatedAsset> run() {
    TENON_CHECK(gather());
    const bool source_differs = std::any_of(states_.begin(), states_.end(),
                                            [](const FileStates& s) { return s.is_changed; });
    if (!source_differs) {
      for (const FileStates& state : states_) {
        result_.edits += state.is_edited ? 1 : 0;
      }
      return std::move(result_);
    }
    TENON_CHECK(read_layers());
    TENON_CHECK(merge_files());
    TENON_CHECK(renew_base());
    report();
    return std::move(result_);
  }

 private:
  struct Layers {
    std::optional<layer::Layer> base;
    std::optional<layer::Layer> edited;  ///< as it is
    std::optional<layer::Layer> source;
  };

  std::string path_of(const std::string& name) const { return folder_ + '/' + name; }

  Result<void> gather() {
    TENON_TRY(const Bytes opening, bytes_if_there(path_of(made_.interface)));
    if (opening == nullptr) {
      return Error(ErrorCode::NotFound, "there is no asset to update")
          .in_file(path_of(made_.interface))
          .with_rule("update.nothing")
          .with_fix("remove --update, or give the name that it was made with");
    }
    TENON_TRY(base_, base_of(folder_, made_.interface));
    TENON_CHECK(check_inside(base_.digests, path_of(made_.interface)));
    std::set<std::string> names;
    for (const auto& [name, file] : made_.files) {
      names.insert(name);
    }
    for (const auto& [name, digest] : base_.digests) {
      names.insert(name);
    }
    for (const std::string& name : names) {
      TENON_CHECK(gather_file(name));
    }
    return {};
  }

  Result<void> gather_file(const std::string& name) {
    FileStates state;
    state.name = name;
    if (const auto base = base_.digests.find(name); base != base_.digests.end()) {
      state.base = base->second;
    }
    if (const auto made = made_.files.find(name); made != made_.files.end()) {
      state.made = made->second.bytes;
      state.made_layer = made->second.layer;
    }
    TENON_TRY(state.present, bytes_if_there(path_of(name)));
    const auto is_base = [&](const Bytes& bytes) {
      if (bytes == nullptr || !state.base) {
        return bytes == nullptr && !state.base;
      }
      return *state.base == (name == made_.interface ? structure::own_digest(bytes->text(), name)
                                                     : content_digest(bytes->text()));
    };
    // The digest of a layer is that of what was made, even where its base is older.
    const bool keeps_conflict = base_.kept.contains(name) && base_.layers.contains(name);
    state.is_edited = keeps_conflict || !is_base(state.present);
    state.is_changed = keeps_conflict || !is_base(state.made);
    states_.push_back(std::move(state));
    return {};
  }

  Result<layer::Layer> layer_with_note(const Bytes& bytes, const std::string& name) const {
    Diagnostics ignored;
    return formats::read_layer(bytes, path_of(name), ignored);
  }

  Result<layer::Layer> layer_in(const Bytes& bytes, const std::string& name) const {
    TENON_TRY(layer::Layer layer, layer_with_note(bytes, name));
    structure::remove_note(layer);
    return layer;
  }

  /// All layers that are there and will be, and what they were.
  Result<void> read_layers() {
    for (const FileStates& state : states_) {
      if (state.made_layer == nullptr && !base_.layers.contains(state.name) &&
          !formats::is_layer_name(state.name)) {
        continue;
      }
      Layers& layers = layers_[state.name];
      if (state.present != nullptr) {
        TENON_TRY(layers.edited, layer_in(state.present, state.name));
      }
      if (state.made != nullptr) {
        TENON_TRY(layers.source, layer_in(state.made, state.name));
      }
      TENON_CHECK(read_base_layer(state, layers));
    }
    follow();
    return {};
  }

  /// What a reader has of it, in the form that the file has.
  Result<void> read_base_layer(const FileStates& state, Layers& layers) {
    const auto copy = base_.layers.find(state.name);
    if (!state.is_edited && layers.edited) {
      layers.base = layers.edited;
    } else if (!state.is_changed && layers.source) {
      layers.base = layers.source;
    } else if (copy != base_.layers.end()) {
      const layer::Layer none("");
      const Bytes& like = state.present != nullptr ? state.present : state.made;
      TENON_TRY(
          layers.base,
          restored(std::move(copy->second), layers.edited ? *layers.edited : none,
                   layers.source ? *layers.source : none,
                   like == nullptr ? formats::LayerFormat::Crate : formats::format_of(*like)));
    }
    return {};
  }

  /// Edits go where the source has their prims now.
  void follow() {
    std::vector<const layer::Layer*> before;
    std::vector<const layer::Layer*> after;
    for (const auto& [name, layers] : layers_) {
      if (layers.base) {
        before.push_back(&*layers.base);
      }
      if (layers.source) {
        after.push_back(&*layers.source);
      }
    }
    result_.moved = moved_prims(before, after);
    if (result_.moved.empty()) {
      return;
    }
    for (auto& [name, layers] : layers_) {
      for (std::optional<layer::Layer>* layer : {&layers.base, &layers.edited}) {
        if (*layer) {
          follow_moves(result_.moved, **layer);
        }
      }
    }
  }

  /// Prims that stay or come back in one layer, though the other side removed them.
  std::set<Path> whole_prims() const {
    std::set<Path> whole;
    for (const auto& [name, layers] : layers_) {
      if (layers.base && layers.edited && layers.source) {
        const diff::MergedLayer merged =
            diff::merge_layers(*layers.base, *layers.edited, *layers.source, {keep_});
        for (const MergeConflict& conflict : merged.conflicts) {
          if (conflict.kind != MergeConflict::Kind::Values && conflict.path.is_prim()) {
            whole.insert(conflict.path);
          }
        }
      }
    }
    return whole;
  }

  Result<void> merge_files() {
    options_ = {keep_, whole_prims()};
    for (const FileStates& state : states_) {
      const auto layers = layers_.find(state.name);
      const bool three = layers != layers_.end() && layers->second.edited && layers->second.source;
      if (three) {
        TENON_CHECK(merge_layer(state, layers->second));
      } else {
        merge_whole_file(state);
      }
    }
    return {};
  }

  Result<void> merge_layer(const FileStates& state, Layers& layers) {
    const layer::Layer none(layers.edited->identifier());
    diff::MergedLayer merged = diff::merge_layers(layers.base ? *layers.base : none, *layers.edited,
                                                  *layers.source, options_);
    result_.edits += merged.edits;
    result_.changes += merged.changes;
    keep_base(state.name, layers.base ? *layers.base : none, *layers.source, merged.conflicts);
    for (MergeConflict& conflict : merged.conflicts) {
      const std::uint64_t digest = conflict_digest(conflict);
      add_conflict(state.name, std::move(conflict), digest);
    }
    const bool opens = state.name == made_.interface;
    const bool as_made = diff::layer_differences(*layers.source, merged.layer).empty();
    if (!state.is_edited && as_made) {
      put(state.name, state.present, state.made);
      return {};
    }
    if (opens) {
      TENON_TRY(const layer::Layer noted, layer_with_note(state.made, state.name));
      structure::copy_note(noted, merged.layer);
    }
    TENON_TRY(const layer::Layer present, layer_with_note(state.present, state.name));
    if (diff::layer_differences(present, merged.layer).empty()) {
      return {};
    }
    merged.layer.set_identifier(path_of(state.name));
    TENON_TRY(EditedFile file, edited_file(*state.present, merged.layer));
    result_.files.push_back(std::move(file));
    return {};
  }

  /// What is no layer, or is there on one side alone.
  void merge_whole_file(const FileStates& state) {
    if (!state.is_changed || !state.is_edited || same_bytes(state.present, state.made)) {
      result_.edits += state.is_edited ? 1 : 0;
      result_.changes += state.is_changed && !state.is_edited ? 1 : 0;
      if (!state.is_edited) {
        put(state.name, state.present, state.made);
      }
      return;
    }
    MergeConflict conflict;
    conflict.kind = state.made == nullptr      ? MergeConflict::Kind::RemovedBySource
                    : state.present == nullptr ? MergeConflict::Kind::RemovedByEdit
                                               : MergeConflict::Kind::Values;
    add_conflict(state.name, std::move(conflict),
                 state.made == nullptr ? 1 : content_digest(state.made->text()));
    if (keep_ == diff::Side::Source) {
      ++result_.changes;
      put(state.name, state.present, state.made);
    } else {
      ++result_.edits;
      changes_.digests[state.name] = state.base;
    }
  }

  static bool same_bytes(const Bytes& a, const Bytes& b) {
    return a == nullptr || b == nullptr ? a == b : a->text() == b->text();
  }

  void put(const std::string& name, const Bytes& present, const Bytes& wanted) {
    if (same_bytes(present, wanted)) {
      return;
    }
    EditedFile file;
    file.path = path_of(name);
    file.removed = wanted == nullptr;
    file.after = wanted == nullptr ? std::string() : std::string(wanted->text());
    result_.files.push_back(std::move(file));
  }

  /// Of a layer, for later runs.
  void keep_base(const std::string& name, const layer::Layer& base, const layer::Layer& source,
                 const std::vector<MergeConflict>& conflicts) {
    const bool touches_whole =
        std::any_of(options_.whole.begin(), options_.whole.end(),
                    [&](Path prim) { return base.has(prim) || source.has(prim); });
    if (keep_ == diff::Side::Edits && (!conflicts.empty() || touches_whole)) {
      changes_.layers.emplace(name, kept_base(base, source, conflicts, options_.whole));
      changes_.kept[name];
    }
  }

  /// Unless an earlier run was told that the edit is to stay.
  void add_conflict(const std::string& file, MergeConflict conflict, std::uint64_t digest) {
    const auto known = base_.kept.find(file);
    const bool is_settled = known != base_.kept.end() && known->second.contains(digest);
    if (keep_ == diff::Side::Edits && (settles_ || is_settled)) {
      changes_.kept[file].insert(digest);
    }
    if (keep_ == diff::Side::Source || settles_ || !is_settled) {
      result_.conflicts.push_back({file, std::move(conflict)});
    }
  }

  Result<void> renew_base() {
    TENON_TRY(std::string copy, encode_base(made_, std::move(changes_)));
    const std::string name = structure::copy_place(made_.interface);
    TENON_TRY(const Bytes present, bytes_if_there(path_of(name)));
    put(name, present, bytes::FileBytes::own(std::move(copy)));
    return {};
  }

  void report() {
    for (const UpdateConflict& conflict : result_.conflicts) {
      diagnostics_.add(finding_of(conflict));
    }
  }

  static std::string shown(const layer::Value& value) {
    return value.empty() ? "nothing" : answers::short_value_text(value);
  }

  Diagnostic finding_of(const UpdateConflict& conflict) const {
    const MergeConflict& what = conflict.what;
    const bool edits = keep_ == diff::Side::Edits;
    std::string message;
    if (what.kind == MergeConflict::Kind::RemovedBySource) {
      message = std::string("the source has it no more, and it was edited; ") +
                (edits ? "it is kept" : "it is removed");
    } else if (what.kind == MergeConflict::Kind::RemovedByEdit) {
      message = std::string("it was removed, and the source changed it; ") +
                (edits ? "it stays removed" : "it is taken back");
    } else if (what.field.empty()) {
      message = std::string("it was edited, and the source changed it; ") +
                (edits ? "the edit is kept" : "the source's value is used");
    } else {
      const bool is_value = what.field == layer::fields::default_value && what.key.empty();
      message =
          (is_value ? std::string()
                    : what.field.str() + (what.key.empty() ? "" : "[" + what.key + "]") + ": ") +
          "it was " + shown(what.base) + ", an edit says " + shown(what.edited) + ", the source " +
          shown(what.source) + "; " + (edits ? "the edit is kept" : "the source's value is used");
    }
    Diagnostic finding = file_finding(
        Severity::Warning, "update.conflict", std::move(message), path_of(conflict.file), 0,
        edits ? "give --conflicts source to take what the source says, or --conflicts edits to "
                "keep the edit and not to be told again"
              : "");
    if (!what.path.empty()) {
      finding.prim = what.path.prim_or_variant().str();
      finding.property = what.path.is_property() ? what.path.name().str() : std::string();
    }
    return finding;
  }

  const structure::Package& made_;
  std::string folder_;
  diff::Side keep_;
  bool settles_;
  Diagnostics& diagnostics_;
  BaseCopy base_;
  std::vector<FileStates> states_;
  std::map<std::string, Layers> layers_;
  diff::MergeOptions options_;
  BaseChanges changes_;
  UpdatedAsset result_;
};

}  // namespace

Result<UpdatedAsset> update_asset(const structure::Package& made, const std::string& folder,
                                  const UpdateChoice& choice, Diagnostics& diagnostics) {
  return AssetUpdate(made, folder, choice, diagnostics).run();
}

Result<std::optional<UpdatedAsset>> update_folder(const structure::Package& made,
                                                  const std::string& folder,
                                                  const UpdateChoice& choice,
                                                  Diagnostics& diagnostics) {
  std::error_code error;
  if (!std::filesystem::exists(std::filesystem::path(folder) / made.interface, error)) {
    return std::optional<UpdatedAsset>();
  }
  const std::string place = std::filesystem::canonical(folder, error).string();
  TENON_TRY(UpdatedAsset updated, update_asset(made, error ? folder : place, choice, diagnostics));
  return std::optional<UpdatedAsset>(std::move(updated));
}

}  // namespace tenon
