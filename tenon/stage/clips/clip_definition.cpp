// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Within a site, layers are composed from weak to strong; sites then from strong to weak. Core Spec
// 1.0.1 section 12 on value clips. Times move with the layer that names the assets, whichever layer
// authors them; as in OpenUSD.
#include "tenon/stage/clips/clip_definition.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <span>

#include "tenon/base/text/text_number.h"
#include "tenon/layer/fields.h"
#include "tenon/layer/finding_place.h"
#include "tenon/stage/clips/clip_places.h"

namespace tenon::stage {
namespace {

using layer::Dictionary;
using layer::Value;
namespace fields = layer::fields;
using Opinions = std::span<const compose::Opinion>;

constexpr std::string_view kAssetPaths = "assetPaths";

constexpr std::string_view kTimeKeys[] = {"active", "times"};

struct ComposedSet {
  Dictionary info;
  // Times are the anchor layer's. Those from a stronger layer of its site are moved by this first.
  std::map<std::string_view, layer::LayerOffset> to_anchor;
  const compose::Opinion* anchor = nullptr;  // where the asset paths are
  std::size_t order = 0;                     // within the anchor's site

  // Adds what a weaker one has more.
  void merge_weaker(const ComposedSet& weaker) {
    for (const auto& [key, offset] : weaker.to_anchor) {
      if (info.find(key) == nullptr) {
        to_anchor.emplace(key, offset);
      }
    }
    info = layer::merge(info, weaker.info);
  }
};

using ComposedSets = std::map<std::string, ComposedSet>;

template <class T>
const T* get(const Dictionary& info, std::string_view key) {
  const Value* value = info.find(key);
  return value == nullptr ? nullptr : value->get<T>();
}

template <class T>
std::optional<T> get_optional(const Dictionary& info, std::string_view key) {
  const T* value = get<T>(info, key);
  return value == nullptr ? std::nullopt : std::optional<T>(*value);
}

void report(const compose::PrimIndex& index, const compose::Opinion& opinion, std::string message,
            const std::string& set, Diagnostics& diagnostics) {
  Diagnostic diagnostic;
  diagnostic.severity = Severity::Warning;
  diagnostic.rule = "clips.invalid";
  diagnostic.message = std::move(message);
  diagnostic.prim = index.path.str();
  layer::place_finding(diagnostic, *opinion.layer, opinion.path, opinion.spec,
                       layer::entry_part(fields::clips, {set}));
  diagnostics.add(std::move(diagnostic));
}

void report(const compose::PrimIndex& index, const ComposedSet& set,
            const ClipDefinition& definition, const Error& error, Diagnostics& diagnostics) {
  Diagnostic diagnostic;
  diagnostic.severity = Severity::Warning;
  diagnostic.rule = "clips.invalid";
  diagnostic.message = "the clip set `" + definition.name + "` is skipped: " + error.message();
  diagnostic.prim = index.path.str();
  diagnostic.fix = error.diagnostic().fix;
  layer::place_finding(diagnostic, *set.anchor->layer, set.anchor->path, set.anchor->spec);
  place_clip_finding(diagnostic, *definition.layer_stack, definition.site, definition.name,
                     error.message());
  diagnostics.add(std::move(diagnostic));
}

void add_layer_info(const compose::Opinion& opinion, const Dictionary& authored, ComposedSet& set) {
  ComposedSet stronger;
  stronger.info = authored;
  if (get<std::vector<layer::AssetPath>>(authored, kAssetPaths) != nullptr ||
      get<std::string>(authored, kTemplateKey) != nullptr) {
    set.anchor = &opinion;
  } else if (set.anchor != nullptr) {
    for (const std::string_view key : kTimeKeys) {
      if (authored.find(key) != nullptr) {
        stronger.to_anchor.emplace(key, set.anchor->offset.inverse() * opinion.offset);
      }
    }
  }
  stronger.merge_weaker(set);
  set.info = std::move(stronger.info);
  set.to_anchor = std::move(stronger.to_anchor);
}

// One layer's `clips`; returns the names of its sets, sorted.
std::vector<std::string> add_layer(const compose::PrimIndex& index, const compose::Opinion& opinion,
                                   const Dictionary& clips, ComposedSets& sets,
                                   Diagnostics& diagnostics) {
  std::vector<std::string> names;
  for (const auto& [name, value] : clips.items) {
    const auto* info = value.get<Dictionary>();
    if (name.empty() || info == nullptr) {
      report(index, opinion,
             name.empty() ? "a clip set has no name"
                          : "the clip set `" + name + "` is not a dictionary",
             name, diagnostics);
      continue;
    }
    add_layer_info(opinion, *info, sets[name]);
    names.push_back(name);
  }
  return names;
}

// All layers of one site, given strongest first.
ComposedSets compose_site(const compose::PrimIndex& index, Opinions opinions,
                          Diagnostics& diagnostics) {
  ComposedSets sets;
  std::vector<std::string> order;
  bool any = false;
  for (std::size_t i = opinions.size(); i-- > 0;) {
    const compose::Opinion& opinion = opinions[i];
    if (const auto* clips = opinion.spec->get<Dictionary>(fields::clips)) {
      any = true;
      layer::ListOp<std::string> named;
      named.added = add_layer(index, opinion, *clips, sets, diagnostics);
      named.apply_to(order);
    }
    const auto* edits = opinion.spec->get<layer::ListOp<std::string>>(fields::clipSets);
    if (any && edits != nullptr) {
      edits->apply_to(order);
    }
  }
  for (auto& [name, set] : sets) {
    const auto at = std::find(order.begin(), order.end(), name);
    set.order = static_cast<std::size_t>(at - order.begin());
  }
  // The list edits may have taken some out.
  std::erase_if(sets, [&](const auto& entry) { return entry.second.order == order.size(); });
  return sets;
}

/// All opinions of the index.
ComposedSets compose_sites(const compose::PrimIndex& index, Opinions opinions,
                           Diagnostics& diagnostics) {
  ComposedSets result;
  for (std::size_t first = 0; first < opinions.size();) {
    std::size_t last = first + 1;
    while (last < opinions.size() && opinions[last].node == opinions[first].node) {
      ++last;
    }
    const auto site = compose_site(index, opinions.subspan(first, last - first), diagnostics);
    for (const auto& [name, weaker] : site) {
      ComposedSet& set = result[name];
      if (set.anchor == nullptr) {
        set.anchor = weaker.anchor;
        set.order = weaker.order;
      }
      set.merge_weaker(weaker);
    }
    first = last;
  }
  // Without a site that names assets there is no place for the set in the strength order.
  std::erase_if(result, [](const auto& entry) { return entry.second.anchor == nullptr; });
  return result;
}

std::optional<std::vector<Vec2d>> anchor_times(const ComposedSet& set, std::string_view key) {
  const auto authored = get_optional<layer::Array<Vec2d>>(set.info, key);
  if (!authored) {
    return std::nullopt;
  }
  std::vector<Vec2d> times(authored->begin(), authored->end());
  if (const auto to_anchor = set.to_anchor.find(key); to_anchor != set.to_anchor.end()) {
    for (Vec2d& time : times) {
      time[0] = to_anchor->second.apply(time[0]);
    }
  }
  return times;
}

Result<void> read_assets(const ComposedSet& set, const ClipFiles& files,
                         ClipDefinition& definition) {
  definition.asset_paths = get_optional<std::vector<layer::AssetPath>>(set.info, kAssetPaths);
  if (definition.asset_paths) {
    definition.active = anchor_times(set, kTimeKeys[0]);
    definition.times = anchor_times(set, kTimeKeys[1]);
    return {};
  }
  const auto* asset = get<std::string>(set.info, kTemplateKey);
  const auto* stride = get<double>(set.info, "templateStride");
  const auto* start = get<double>(set.info, "templateStartTime");
  const auto* end = get<double>(set.info, "templateEndTime");
  if (asset == nullptr || stride == nullptr || start == nullptr || end == nullptr) {
    return {};
  }
  ClipTemplate clip_template{*asset, *stride, *start, *end, std::nullopt};
  clip_template.active_offset = get_optional<double>(set.info, "templateActiveOffset");
  return expand_template(clip_template, files, definition);
}

template <class T, class Write>
void add_to_key(std::string& key, const std::optional<T>& items, Write write) {
  key += items ? "[" : "-";
  if (items) {
    for (const auto& item : *items) {
      key += write(item) + " ";
    }
  }
  key += "\n";
}

}  // namespace

std::string ClipDefinition::key() const {
  const auto pair = [](const Vec2d& x) { return shortest(x[0]) + "," + shortest(x[1]); };
  std::string key = layer_stack->identifier() + "<" + site.str() + ">" + layer->identifier() +
                    "\n" + prim_path.value_or("-") + "\n" +
                    (manifest ? "@" + manifest->authored : "-") + " " + shortest(offset.offset) +
                    " " + shortest(offset.scale) +
                    (interpolate_missing ? "\ninterpolated\n" : "\n");
  add_to_key(key, asset_paths, [](const layer::AssetPath& x) { return x.authored; });
  add_to_key(key, active, pair);
  add_to_key(key, times, pair);
  return key;
}

bool has_clips(const compose::PrimIndex& index) {
  for (const compose::Opinion& opinion : index.opinions()) {
    if (opinion.spec->has(fields::clips)) {
      return true;
    }
  }
  return false;
}

std::vector<ClipDefinition> clip_definitions(const compose::PrimIndex& index,
                                             const ClipFiles& files, Diagnostics& diagnostics) {
  const compose::Opinions opinions = index.opinions();
  const ComposedSets composed = compose_sites(index, opinions, diagnostics);
  std::vector<const ComposedSets::value_type*> sorted;
  for (const auto& entry : composed) {
    sorted.push_back(&entry);
  }
  std::stable_sort(sorted.begin(), sorted.end(), [](const auto* a, const auto* b) {
    return a->second.anchor->node != b->second.anchor->node
               ? a->second.anchor->node < b->second.anchor->node
               : a->second.order < b->second.order;
  });
  std::vector<ClipDefinition> result;
  for (const auto* entry : sorted) {
    const ComposedSet& set = entry->second;
    ClipDefinition& definition = result.emplace_back();
    definition.name = entry->first;
    definition.layer_stack = index.nodes()[set.anchor->node].layer_stack;
    definition.layer = set.anchor->layer;
    definition.site = set.anchor->path;
    definition.offset = set.anchor->offset;
    definition.prim_path = get_optional<std::string>(set.info, "primPath");
    definition.manifest = get_optional<layer::AssetPath>(set.info, "manifestAssetPath");
    const bool* interpolate = get<bool>(set.info, "interpolateMissingClipValues");
    definition.interpolate_missing = interpolate != nullptr && *interpolate;
    if (const Result<void> read = read_assets(set, files, definition); !read) {
      report(index, set, definition, read.error(), diagnostics);
      result.pop_back();
    }
  }
  return result;
}

}  // namespace tenon::stage
