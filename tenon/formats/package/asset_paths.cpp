// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Every asset path of a layer is offered to a callback, and what it returns takes its place. Lists,
// dictionaries, samples and clip sets are rebuilt on the way down, and the keys on that way tell a
// finding which item it is about. A field is set only when a path in it changed. Large arrays are
// never opened, since the type of a value tells whether it may hold asset paths. Setting a field
// moves the others of its spec, so the walk goes over a copy of them.
#include "tenon/formats/package/asset_paths.h"

#include <algorithm>
#include <vector>

#include "tenon/base/text/text_number.h"
#include "tenon/layer/array_edit.h"
#include "tenon/layer/field_values.h"
#include "tenon/layer/fields.h"
#include "tenon/layer/finding_place.h"

namespace tenon::formats {
namespace {

using layer::Value;
namespace fields = layer::fields;

class Renamer {
 public:
  Renamer(const RenameAssetPart& rename, Path spec, Token field)
      : rename_(rename), spec_(spec), field_(field) {}

  bool changed() const { return changed_; }

  Value renamed(const Value& value) {
    if (field_ == fields::subLayers) {
      return renamed_layers(value);
    }
    if (field_ == fields::clips) {
      return renamed_clips(value);
    }
    return renamed(value, AssetUse::Value);
  }

 private:
  std::string name(const std::string& asset_path, AssetUse use) {
    return name(asset_path, use, layer::item_text(asset_path, Path()));
  }

  /// `item`: how lists say it.
  std::string name(const std::string& asset_path, AssetUse use, std::string item) {
    if (asset_path.empty()) {
      return asset_path;
    }
    std::string result =
        rename_(asset_path, use, spec_, layer::entry_part(field_, keys_, std::move(item)));
    changed_ = changed_ || result != asset_path;
    return result;
  }

  Value renamed_layers(const Value& value) {
    const auto* paths = value.get<std::vector<std::string>>();
    if (paths == nullptr) {
      return value;
    }
    std::vector<std::string> result;
    for (const std::string& path : *paths) {
      result.push_back(name(path, AssetUse::Layer));
    }
    return result;
  }

  template <class Arc>
  Value renamed_arcs(const layer::ListOp<Arc>& op) {
    layer::ListOp<Arc> result = op;
    for (std::vector<Arc>* list : {&result.explicit_items, &result.prepended, &result.appended,
                                   &result.deleted, &result.added, &result.ordered}) {
      for (Arc& arc : *list) {
        arc.asset_path = name(arc.asset_path, AssetUse::Layer, layer::item_text(arc));
      }
    }
    return result;
  }

  Value renamed(const Value& value, AssetUse use) {
    if (const auto* asset = value.get<layer::AssetPath>()) {
      return layer::AssetPath{name(asset->authored, use), {}, {}};
    }
    if (const auto* assets = value.get<layer::Array<layer::AssetPath>>()) {
      layer::Array<layer::AssetPath> result;
      for (const layer::AssetPath& asset : *assets) {
        result.push_back({name(asset.authored, use), {}, {}});
      }
      return result;
    }
    if (const auto* references = value.get<layer::ListOp<layer::Reference>>()) {
      return renamed_arcs(*references);
    }
    if (const auto* payloads = value.get<layer::ListOp<layer::Payload>>()) {
      return renamed_arcs(*payloads);
    }
    if (const auto* dictionary = value.get<layer::Dictionary>()) {
      layer::Dictionary result = *dictionary;
      for (auto& [key, item] : result.items) {
        item = renamed_below(key, item, use);
      }
      return result;
    }
    if (const auto* edit = value.get<layer::ArrayEdit>()) {
      layer::ArrayEdit result = *edit;
      result.literals = renamed(edit->literals, use);
      return result;
    }
    return renamed_samples(value);
  }

  /// A sample; the first one may be a block, and others edits of arrays.
  static bool may_hold_assets(const Value& value) {
    const auto* edit = value.get<layer::ArrayEdit>();
    return (edit == nullptr ? value : edit->literals).type() == layer::ValueType::Asset;
  }

  Value renamed_samples(const Value& value) {
    const auto* samples = value.get<layer::TimeSamples>();
    const bool assets =
        samples != nullptr && std::any_of(samples->values.begin(), samples->values.end(),
                                          [](const Value& v) { return may_hold_assets(v); });
    if (!assets) {
      return value;
    }
    layer::TimeSamples result = *samples;
    for (std::size_t i = 0; i < result.size(); ++i) {
      result.values[i] =
          renamed_below(shortest(result.times[i]), result.values[i], AssetUse::Value);
    }
    return result;
  }

  /// What stands under a key of a dictionary, or at a time.
  Value renamed_below(const std::string& key, const Value& value, AssetUse use) {
    keys_.push_back(key);
    Value result = renamed(value, use);
    keys_.pop_back();
    return result;
  }

  /// Sets by name, each with asset paths and perhaps a template in a string.
  Value renamed_clips(const Value& value) {
    const auto* sets = value.get<layer::Dictionary>();
    if (sets == nullptr) {
      return value;
    }
    layer::Dictionary result = *sets;
    for (auto& [set, item] : result.items) {
      const auto* set_fields = item.get<layer::Dictionary>();
      if (set_fields == nullptr) {
        continue;
      }
      layer::Dictionary changed = *set_fields;
      keys_ = {set};
      for (auto& [key, entry] : changed.items) {
        const auto* pattern = entry.get<std::string>();
        if (key == "templateAssetPath" && pattern != nullptr) {
          keys_.push_back(key);
          entry = Value(name(*pattern, AssetUse::ClipTemplate, *pattern));
          keys_.pop_back();
        } else {
          entry = renamed_below(key, entry, AssetUse::Layer);
        }
      }
      keys_.clear();
      item = Value(std::move(changed));
    }
    return result;
  }

  const RenameAssetPart& rename_;
  Path spec_;
  Token field_;
  std::vector<std::string> keys_;  // of the dictionaries or the time that are being looked at
  bool changed_ = false;
};

/// Only these can hold asset paths; all else, large arrays above all, is left alone.
bool may_hold_assets(Token field, const Value& value) {
  switch (value.type()) {
    case layer::ValueType::Asset:
    case layer::ValueType::ReferenceListOp:
    case layer::ValueType::PayloadListOp:
    case layer::ValueType::Dictionary:
    case layer::ValueType::TimeSamples:
    case layer::ValueType::ArrayEdit:
      return true;
    default:
      return field == fields::subLayers;
  }
}

}  // namespace

bool rename_assets(layer::Layer& layer, const RenameAsset& rename) {
  return rename_asset_parts(
      layer, [&](const std::string& asset_path, AssetUse use, Path spec, const StatementPart&) {
        return rename(asset_path, use, spec);
      });
}

bool rename_asset_parts(layer::Layer& layer, const RenameAssetPart& rename) {
  std::vector<Path> paths;
  for (const layer::Layer::Entry& entry : layer.entries()) {
    if (!entry.path.empty()) {
      paths.push_back(entry.path);
    }
  }
  bool any = false;
  for (const Path path : paths) {
    layer::Spec* const spec = layer.find(path);
    const auto fields = spec == nullptr ? layer::FieldRange() : spec->fields();
    if (std::none_of(fields.begin(), fields.end(), [](const layer::Field& field) {
          return may_hold_assets(field.name, field.value);
        })) {
      continue;
    }
    const std::vector<layer::Field> all(fields.begin(), fields.end());  // `set` moves them
    for (const layer::Field& field : all) {
      if (!may_hold_assets(field.name, field.value)) {
        continue;
      }
      Renamer renamer(rename, path, field.name);
      Value value = renamer.renamed(field.value);
      if (renamer.changed()) {
        spec->set(field.name, std::move(value));
        any = true;
      }
    }
  }
  return any;
}

}  // namespace tenon::formats
