// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A prim whose nodes, opinions or types differ between the two stages, or whose children changed
// their order, is resynced with all that is below it. Elsewhere only metadata and properties can
// differ: a changed spec then concerns exactly the prims that have it among their opinions. Layers
// are compared by identifier. What lies in a prototype is told once under each of its instances.
#include "tenon/edit/change_notice.h"

#include <algorithm>
#include <map>
#include <set>
#include <unordered_map>
#include <utility>

#include "tenon/layer/fields.h"
#include "tenon/layer/metadata_fields.h"
#include "tenon/stage/composed_type.h"
#include "tenon/stage/stage_data.h"

namespace tenon::edit {
namespace {

using stage::PrimData;
using stage::StageData;

/// A prim spec of a layer, by identifier.
using SpecPlace = std::pair<std::string, Path>;

/// What changed at and in one prim spec.
struct SpecNews {
  bool metadata = false;
  std::set<Token> properties;
};

bool same_node(const compose::Node& a, const compose::Node& b) {
  return a.arc == b.arc && a.path == b.path && a.inert == b.inert && a.culled == b.culled &&
         a.parent == b.parent && a.layer_stack->identifier() == b.layer_stack->identifier();
}

bool same_opinion(const compose::Opinion& a, const compose::Opinion& b) {
  return a.path == b.path && a.node == b.node && a.offset == b.offset &&
         a.layer->identifier() == b.layer->identifier();
}

std::vector<Token> sorted(std::vector<Token> names) {
  std::sort(names.begin(), names.end());
  return names;
}

bool same_composition(const PrimData& a, const PrimData& b) {
  const compose::PrimIndex& x = *a.index;
  const compose::PrimIndex& y = *b.index;
  return a.type_name() == b.type_name() && a.specifier == b.specifier && a.active == b.active &&
         a.loaded == b.loaded && x.extras().instance_key == y.extras().instance_key &&
         std::ranges::equal(x.nodes(), y.nodes(), same_node) &&
         std::ranges::equal(x.opinions(), y.opinions(), same_opinion) &&
         a.definition->applied() == b.definition->applied();
}

/// The same children in another order.
bool is_reordered(const PrimData& a, const PrimData& b) {
  const std::vector<Token>& before = a.index->child_names.list();
  const std::vector<Token>& after = b.index->child_names.list();
  return before != after && sorted(before) == sorted(after);
}

class Comparison {
 public:
  Comparison(const StageData& before, const StageData& after) : before_(before), after_(after) {
    add_instances(before);
    add_instances(after);
  }

  ChangeNotice run(const std::vector<LayerChange>& changes) {
    read_changes(changes);
    for (const PrimData& prim : after_.prims) {
      compare(before_, prim);
    }
    for (const PrimData& prim : before_.prims) {
      if (prim_like(after_, prim) == nullptr) {
        report(resynced_, before_, prim, {});
      }
    }
    return result();
  }

 private:
  void add_instances(const StageData& stage) {
    for (const PrimData& prim : stage.prims) {
      if (prim.is_instance() && !prim.in_prototype) {
        instances_[prim.prototype()].push_back(prim.path);
      }
    }
  }

  void read_changes(const std::vector<LayerChange>& changes) {
    for (const LayerChange& change : changes) {
      for (const SpecChange& spec : change.specs) {
        read_change(change.layer, spec);
      }
    }
  }

  void read_change(const std::string& layer, const SpecChange& change) {
    Path owner = change.path;
    while (!owner.is_prim_or_variant() && !owner.is_absolute_root() && !owner.is_property()) {
      owner = owner.parent();
    }
    if (owner.is_property()) {
      news_[{layer, owner.parent()}].properties.insert(owner.name());
    } else if (change.before && change.after &&
               differs_in_metadata(*change.before, *change.after)) {
      news_[{layer, owner}].metadata = true;
    }
  }

  /// Fields of the structure show in how prims are composed.
  static bool differs_in_metadata(const layer::Spec& a, const layer::Spec& b) {
    const auto differs = [](const layer::Spec& one, const layer::Spec& other) {
      return std::any_of(one.fields().begin(), one.fields().end(), [&](const layer::Field& field) {
        const layer::Value* value = other.find(field.name);
        return (field.name == layer::fields::comment ||
                !layer::is_structural_field(field.name, one.kind)) &&
               (value == nullptr || !(*value == field.value));
      });
    };
    return differs(a, b) || differs(b, a);
  }

  /// The prim at the same path; prims of prototypes are told by the instance they were made from.
  static const PrimData* prim_like(const StageData& others, const PrimData& prim) {
    const PrimData* const found = others.record(prim.path);
    return found == nullptr || found->source_path() != prim.source_path() ? nullptr : found;
  }

  void compare(const StageData& others, const PrimData& prim) {
    const PrimData* old = prim_like(others, prim);
    if (old == nullptr || !same_composition(*old, prim) || is_reordered(*old, prim)) {
      report(resynced_, after_, prim, {});
      return;
    }
    for (const compose::Opinion& opinion : prim.index->opinions()) {
      const auto it = news_.find({opinion.layer->identifier(), opinion.path});
      if (it == news_.end()) {
        continue;
      }
      if (it->second.metadata) {
        report(info_, after_, prim, {});
      }
      for (const Token name : it->second.properties) {
        report_property(*old, prim, name);
      }
    }
  }

  void report_property(const PrimData& old, const PrimData& prim, Token name) {
    const auto has = [&](const PrimData& where) {
      const std::vector<Token>& names = where.index->property_names.list();
      return std::find(names.begin(), names.end(), name) != names.end() ||
             where.definition->find(name) != nullptr;
    };
    report(has(old) == has(prim) ? info_ : resynced_, after_, prim, name);
  }

  /// Enters a prim or its property; one in a prototype under each instance.
  void report(std::set<Path>& paths, const StageData& stage, const PrimData& prim,
              Token property) const {
    const auto enter = [&](Path path) {
      paths.insert(property.empty() ? path : path.property(property));
    };
    if (!prim.in_prototype) {
      enter(prim.path);
      return;
    }
    const PrimData* root = &prim;
    while (!root->is_prototype_root) {
      root = stage.numbered(root->parent);
    }
    const auto instances = instances_.find(root);
    if (instances != instances_.end()) {
      for (const Path instance : instances->second) {
        enter(prim.path.replace_prefix(root->path, instance));
      }
    }
  }

  ChangeNotice result() const {
    ChangeNotice notice;
    for (const Path path : resynced_) {
      if (!covers(resynced_, path.parent())) {
        notice.resynced.push_back(path);
      }
    }
    for (const Path path : info_) {
      if (!covers(resynced_, path)) {
        notice.changed_info.push_back(path);
      }
    }
    return notice;
  }

  /// `path` or something above it is among `paths`.
  static bool covers(const std::set<Path>& paths, Path path) {
    while (!path.empty() && !paths.contains(path)) {
      path = path.parent();
    }
    return !path.empty();
  }

  const StageData& before_;
  const StageData& after_;
  std::unordered_map<const PrimData*, std::vector<Path>> instances_;  // of a prototype
  std::map<SpecPlace, SpecNews> news_;
  std::set<Path> resynced_;
  std::set<Path> info_;
};

}  // namespace

ChangeNotice compare_stages(const stage::Stage& before, const stage::Stage& after,
                            const std::vector<LayerChange>& changes) {
  return Comparison(before.data(), after.data()).run(changes);
}

}  // namespace tenon::edit
