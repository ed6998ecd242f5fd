// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The way to an opinion is read off the graph of the prim's index, from its node up to the root. A
// node that came with an arc of an ancestor has gone down in namespace since, and so has its
// parent: both paths climb by as many elements to the prims that the arc joins. A layer reaches a
// prim through the nearest prim at or above it that has a node with that layer. The climb ends at
// the root of a prototype, because its ancestors are not shared by its instances.
#include "tenon/stage/sources/opinion_sources.h"

#include <algorithm>

#include "tenon/compose/node_graph.h"
#include "tenon/layer/fields.h"
#include "tenon/stage/stage_data.h"

namespace tenon::stage {
namespace {

namespace fields = layer::fields;
using compose::ArcKind;

/// `path` less `steps` elements that are no variant selections.
Path climbed(Path path, std::size_t steps) {
  for (; steps > 0 && !path.is_absolute_root(); path = path.parent()) {
    steps -= path.is_variant_selection() ? 0 : 1;
  }
  return path;
}

/// The fields that author an arc of a kind.
std::vector<Token> fields_of(ArcKind kind) {
  switch (kind) {
    case ArcKind::Inherit:
      return {fields::inheritPaths};
    case ArcKind::Variant:
      return {fields::variantSelection, fields::variantSetNames};
    case ArcKind::Reference:
      return {fields::references};
    case ArcKind::Payload:
      return {fields::payload};
    case ArcKind::Specialize:
      return {fields::specializes};
    case ArcKind::Relocate:
    case ArcKind::Root:
      break;
  }
  return {};
}

std::string_view file_name(std::string_view path) {
  return path.substr(path.find_last_of('/') + 1);
}

/// Whether an arc may be the one that `step` takes. What its file resolves to is not kept, so files
/// are told apart by their names.
template <class Arc>
bool may_lead(const Arc& arc, const ArcStep& step) {
  const bool same_file =
      arc.asset_path.empty() || file_name(arc.asset_path) == file_name(step.to_layer);
  return same_file && (arc.prim_path.empty() || arc.prim_path == step.to);
}
bool may_lead(Path to, const ArcStep& step) { return to == step.to; }

template <class Arc>
bool lists(const layer::Value& value, const ArcStep& step) {
  const auto* op = value.get<layer::ListOp<Arc>>();
  const auto leads = [&](const std::vector<Arc>& arcs) {
    return std::any_of(arcs.begin(), arcs.end(),
                       [&](const Arc& arc) { return may_lead(arc, step); });
  };
  return op != nullptr && (leads(op->explicit_items) || leads(op->prepended) ||
                           leads(op->appended) || leads(op->added));
}

/// Variants are authored by every layer that names the set or selects one.
bool says_arc(const layer::Value& value, const ArcStep& step) {
  return step.kind == ArcKind::Variant || lists<layer::Reference>(value, step) ||
         lists<layer::Payload>(value, step) || lists<Path>(value, step);
}

/// The strongest layer that lists the arc; where none is seen to, the strongest with any of its
/// kind.
void find_author(const compose::LayerStack& stack, ArcStep& step) {
  for (const Token field : fields_of(step.kind)) {
    for (const bool any : {false, true}) {
      for (const compose::StackedLayer& stacked : stack.layers) {
        const layer::Spec* spec = stacked.layer->find(step.from);
        const layer::Value* value = spec == nullptr ? nullptr : spec->find(field);
        if (value != nullptr && (any || says_arc(*value, step))) {
          step.layer = stacked.layer->identifier();
          step.line = spec->line;
          return;
        }
      }
    }
  }
}

std::vector<ArcStep> arcs_to(const compose::PrimIndex& index, std::uint32_t id) {
  std::vector<ArcStep> steps;
  for (; id != compose::kNoNode && index.nodes()[id].parent != compose::kNoNode;
       id = index.nodes()[id].parent) {
    const compose::Node& node = index.nodes()[id];
    const compose::Node& parent = index.nodes()[node.parent];
    const std::size_t depth = compose::namespace_depth_of(parent.path);
    const std::size_t below = depth > node.namespace_depth ? depth - node.namespace_depth : 0;
    ArcStep step;
    step.kind = node.arc;
    step.from = climbed(parent.path, below);
    step.to = climbed(node.path, below);
    step.to_layer = node.layer_stack->identifier();
    find_author(*parent.layer_stack, step);
    steps.push_back(std::move(step));
  }
  std::reverse(steps.begin(), steps.end());
  return steps;
}

bool has_layer(const compose::LayerStack& stack, const std::string& identifier) {
  return std::any_of(stack.layers.begin(), stack.layers.end(),
                     [&](const compose::StackedLayer& stacked) {
                       return stacked.layer->identifier() == identifier;
                     });
}

bool same_place(const OpinionSource& a, const OpinionSource& b) {
  return a.layer == b.layer && a.path == b.path;
}

}  // namespace

OpinionSource source_of(const compose::PrimIndex& index, const compose::Opinion& opinion) {
  OpinionSource source;
  source.layer = opinion.layer;
  source.spec = opinion.spec;
  source.path = opinion.path;
  source.stack = index.nodes()[opinion.node].layer_stack->identifier();
  source.arcs = arcs_to(index, opinion.node);
  source.offset = opinion.offset;
  return source;
}

std::vector<OpinionSource> opinion_sources(const Stage& stage, Path prim, Token property) {
  std::vector<OpinionSource> sources;
  const PrimData* record = record_of(stage, prim);
  if (record == nullptr || record->index == nullptr) {
    return sources;
  }
  for (compose::Opinion opinion : record->index->opinions()) {
    if (!property.empty()) {
      opinion.path = opinion.path.property(property);
      opinion.spec = opinion.layer->find(opinion.path);
    }
    if (opinion.spec != nullptr) {
      sources.push_back(source_of(*record->index, opinion));
    }
  }
  return sources;
}

std::vector<OpinionSource> ignored_below_instance(const Stage& stage, Path prim, Token property) {
  std::vector<OpinionSource> ignored;
  Prim instance = stage.prim(prim);
  if (!instance || !instance.is_instance_proxy()) {
    return ignored;
  }
  while (instance && instance.is_instance_proxy()) {
    instance = instance.parent();
  }
  const std::vector<OpinionSource> used = opinion_sources(stage, prim, property);
  for (OpinionSource& source : opinion_sources(stage, instance.path())) {
    source.path = prim.replace_prefix(instance.path(), source.path, false);
    source.path = property.empty() ? source.path : source.path.property(property);
    source.spec = source.layer->find(source.path);
    const bool counts = std::any_of(used.begin(), used.end(), [&](const OpinionSource& other) {
      return same_place(other, source);
    });
    if (source.spec != nullptr && !counts) {
      ignored.push_back(std::move(source));
    }
  }
  return ignored;
}

std::optional<LayerSite> site_in_layer(const Stage& stage, Path prim, const std::string& layer) {
  const PrimData* record = record_of(stage, prim);
  const bool proxy = record != nullptr && record->in_prototype;
  for (Path rest = prim; record != nullptr && record->index != nullptr;
       record = stage.data().numbered(record->parent)) {
    if (record->is_prototype_root) {
      return std::nullopt;  // what stands further out is not shared
    }
    const auto& nodes = record->index->nodes();
    for (std::uint32_t id = 0; id < nodes.size(); ++id) {
      if (nodes[id].can_contribute() && has_layer(*nodes[id].layer_stack, layer)) {
        LayerSite site;
        site.path = prim.replace_prefix(rest, nodes[id].path, false);
        site.index = record->index;
        site.node = id;
        if (proxy) {
          const PrimData* shared = record;
          for (site.shared_from = rest; !shared->is_prototype_root;
               shared = stage.data().numbered(shared->parent)) {
            site.shared_from = site.shared_from.parent();
          }
          site.shared_as = shared->source_path();
        }
        return site;
      }
    }
    rest = rest.parent();
  }
  return std::nullopt;
}

}  // namespace tenon::stage
