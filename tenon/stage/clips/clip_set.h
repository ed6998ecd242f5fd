// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>
#include <vector>

#include "tenon/compose/layer_opener.h"
#include "tenon/stage/clips/clip_definition.h"
#include "tenon/stage/clips/clip_times.h"
#include "tenon/stage/interpolate.h"

/// Values that lie in other layers, one layer at a time. Internal to tenon/stage.
namespace tenon::stage {

/// For whom a clip is opened: for findings.
struct ClipUser {
  Path site;         ///< of the clip set in its layer
  std::string prim;  ///< of the stage
};

/// Opens the layers of clips when they are first read, and keeps them. Safe to use from several
/// threads.
class ClipLayers {
 public:
  explicit ClipLayers(compose::LayerOpener opener) : opener_(std::move(opener)) {}

  /// nullptr, and a diagnostic, when the layer cannot be opened.
  const layer::Layer* open(const std::string& asset_path, const layer::Layer& anchor,
                           const ClipUser& user);
  /// Those opened so far, by identifier.
  std::vector<layer::LayerPtr> opened() const;
  /// What was found since the last call.
  Diagnostics take_diagnostics();

 private:
  compose::LayerOpener opener_;
  mutable std::mutex mutex_;
  std::map<std::string, layer::LayerPtr> opened_;
  Diagnostics diagnostics_;
};

/// A layer that a clip set names; opened on first use.
class ClipLayer {
 public:
  ClipLayer(ClipLayers& layers, std::string asset_path, const layer::Layer& anchor, ClipUser user)
      : layers_(layers),
        asset_path_(std::move(asset_path)),
        anchor_(anchor),
        user_(std::move(user)) {}
  /// nullptr when there is none.
  const layer::Layer* get() const;

 private:
  ClipLayers& layers_;
  std::string asset_path_;
  const layer::Layer& anchor_;
  ClipUser user_;
  mutable std::atomic<bool> known_ = false;
  mutable std::atomic<const layer::Layer*> layer_ = nullptr;
};

/// One stretch of time and the layer that gives its values.
struct Clip {
  const ClipLayer* layer = nullptr;
  double authored_start = 0;
  double start = 0;  ///< as authored; of the first: minus infinity
  double end = 0;    ///< not included; of the last: for ever
};

/// A clip set in use. Attribute paths are those of the site where the set comes in; times in public
/// functions are the stage's, within those of the layer where it comes in.
class ClipSet {
 public:
  /// nullptr when the definition gives no clips; says why where that is a mistake.
  static std::shared_ptr<const ClipSet> make(const ClipDefinition& definition, ClipLayers& layers,
                                             const std::string& prim, Diagnostics& diagnostics);
  ClipSet(const ClipSet&) = delete;
  ClipSet& operator=(const ClipSet&) = delete;

  const std::string& name() const { return name_; }
  const layer::Layer& layer() const { return *layer_; }
  /// The prim spec in that layer that names the clips.
  Path site() const { return site_; }
  /// From the times of that layer, and of time codes in values, to the stage's.
  const layer::LayerOffset& offset() const { return offset_; }
  /// Comes in at this node or above it in namespace.
  bool applies_to(const compose::Node& node) const {
    return node.layer_stack == layer_stack_ && node.path.has_prefix(site_);
  }
  /// The manifest names the attribute as varying. Only then the set has values for it.
  bool declares(Path attribute) const;
  /// Ascending: samples of the clips, entries of the time map, starts of clips.
  std::vector<double> time_samples(Path attribute) const;
  /// False when there is one clip with one sample at most.
  bool may_vary(Path attribute) const;

  struct Found {
    layer::Value value;                    ///< empty when blocked or nowhere
    const layer::Layer* anchor = nullptr;  ///< what asset paths in it start from; may be null
  };
  /// The clip in force at a time.
  struct Active {
    const layer::Layer* layer = nullptr;  ///< nullptr when it cannot be opened
    Path attribute;                       ///< in that layer
    double time = 0;                      ///< there
  };
  Active active_at(Path attribute, double time) const;
  Found value_at(Path attribute, double time, Interpolation interpolation) const;

 private:
  struct Bracket {
    double lower = 0;
    double upper = 0;
  };
  struct Query {
    Path attribute;  // in the clip layers
    Interpolation interpolation = Interpolation::Linear;
  };

  ClipSet() = default;
  void add_clips(const ClipDefinition& definition, ClipLayers& layers, const std::string& prim);
  void generate_manifest();

  Path in_clip(Path attribute) const { return attribute.replace_prefix(site_, clip_prim_); }
  std::size_t active(double time) const;
  const layer::Value* manifest_default(Path in_clip) const;
  bool contributes(const Clip& clip, Path in_clip) const;
  Bracket bracket(Path in_clip, double time) const;
  Bracket clip_bracket(const Clip& clip, Path in_clip, double time) const;
  Bracket layer_bracket(const layer::TimeSamples& samples, double time) const;
  void list_times(const Clip& clip, Path in_clip, std::vector<double>& times) const;
  layer::Value sample(const Query& query, double time) const;
  layer::Value resolve(const Query& query, double time) const;

  std::string name_;
  const compose::LayerStack* layer_stack_ = nullptr;
  const layer::Layer* layer_ = nullptr;
  layer::LayerOffset offset_;
  Path site_;
  Path clip_prim_;
  bool interpolate_missing_ = false;
  std::deque<ClipLayer> layers_;
  std::vector<Clip> clips_;  // by start
  ClipTimes times_;
  const ClipLayer* manifest_ = nullptr;       // nullptr: generated
  std::unordered_map<Path, bool> generated_;  // attribute in the clips -> varying
};

using ClipSets = std::vector<std::shared_ptr<const ClipSet>>;

/// The clip sets that a prim's attributes look into, its own before its ancestors'.
ClipSets clip_sets(const std::vector<ClipDefinition>& definitions, const ClipSets* inherited,
                   ClipLayers& layers, const std::string& prim, Diagnostics& diagnostics);

}  // namespace tenon::stage
