// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Targets are authored in the namespace of a node. Each list edit is mapped to the stage's
// namespace, paths in brackets included, and then applied from the weakest opinion to the
// strongest. A path without an image is skipped and reported. An explicit list takes back what
// weaker opinions reported, and a deletion what was reported about its target. With a cache the
// rules are those of composition alone, without it those of a stage: they differ in which targets
// of a class they refuse.
#include "tenon/compose/targets.h"

#include <algorithm>

#include "tenon/compose/arcs/arc_name.h"
#include "tenon/compose/cache/index_cache.h"
#include "tenon/compose/composition_error.h"
#include "tenon/compose/node_graph.h"
#include "tenon/layer/field_values.h"
#include "tenon/layer/fields.h"
#include "tenon/layer/finding_place.h"

namespace tenon::compose {
namespace {

namespace fields = layer::fields;
using layer::ListOp;
using layer::SpecKind;

/// `path` of a node's namespace in the stage's, paths in brackets included; empty when any of them
/// has no image.
Path map_with_targets(const MapFunction& map, Path path) {
  path = path.strip_variants();
  if (map.is_identity_of_paths()) {
    return path;
  }
  Path mapped = map.map_source_to_target(path);
  for (Path at = path; !mapped.empty() && !at.empty(); at = at.parent()) {
    const Path target = at.target();
    if (!target.empty()) {
      const Path mapped_target = map_with_targets(map, target);
      mapped = mapped_target.empty() ? Path() : mapped.replace_prefix(target, mapped_target, true);
    }
  }
  return mapped;
}

/// The path of a node, or of its parent, where the arc was introduced.
Path climb_to_introduction(const PrimIndex& index, std::uint32_t node, Path path) {
  const std::uint32_t parent = index.nodes()[node].parent;
  if (parent == kNoNode) {
    return Path::absolute_root();
  }
  int steps = namespace_depth_of(index.nodes()[parent].path) - index.nodes()[node].namespace_depth;
  for (; steps > 0 && !path.empty(); --steps) {
    while (path.is_variant_selection()) {
      path = path.parent();
    }
    path = path.parent();
  }
  return path;
}

Token targets_field(const layer::Spec& spec) {
  return spec.kind == SpecKind::Attribute ? fields::connectionPaths : fields::targetPaths;
}

class TargetCombiner {
 public:
  /// Without a cache the rules are those of a stage.
  TargetCombiner(IndexCache* cache, const PrimIndex& index, Token property)
      : cache_(cache), index_(index), property_(property) {}

  TargetList combine(const std::vector<PropertyOpinion>& opinions) {
    for (auto it = opinions.rbegin(); it != opinions.rend(); ++it) {
      const auto* op = it->spec->get<ListOp<Path>>(targets_field(*it->spec));
      if (op == nullptr || op->empty()) {
        continue;
      }
      list_.has_opinions = true;
      if (op->is_explicit) {
        errors_.clear();
        list_.deleted.clear();
      }
      if (is_plain_list(*op)) {
        list_.paths.clear();
        layer::append_absent(list_.paths, targets_of(op->explicit_items, *it));
      } else {
        mapped(*op, *it).apply_to(list_.paths);
      }
    }
    for (Found& found : errors_) {
      list_.errors.add(std::move(found.diagnostic));
    }
    return std::move(list_);
  }

 private:
  struct Found {
    Path target;  // in the stage's namespace; may be empty
    Diagnostic diagnostic;
  };

  /// As most are: a list, and no edits of one beside it.
  static bool is_plain_list(const ListOp<Path>& op) {
    return op.is_explicit && op.deleted.empty() && op.added.empty() && op.prepended.empty() &&
           op.appended.empty() && op.ordered.empty();
  }

  std::vector<Path> targets_of(const std::vector<Path>& items, const PropertyOpinion& opinion) {
    std::vector<Path> targets;
    targets.reserve(items.size());
    for (const Path path : items) {
      const Path target = target_of(path, opinion);
      if (!target.empty()) {
        targets.push_back(target);
      }
    }
    return targets;
  }

  ListOp<Path> mapped(const ListOp<Path>& op, const PropertyOpinion& opinion) {
    ListOp<Path> result;
    result.is_explicit = op.is_explicit;
    result.explicit_items = targets_of(op.explicit_items, opinion);
    for (const Path path : op.deleted) {
      const Path target = deleted_target(path, opinion);
      if (!target.empty()) {
        result.deleted.push_back(target);
      }
    }
    result.added = targets_of(op.added, opinion);
    result.prepended = targets_of(op.prepended, opinion);
    result.appended = targets_of(op.appended, opinion);
    result.ordered = targets_of(op.ordered, opinion);
    return result;
  }

  Path absolute(Path path, const PropertyOpinion& opinion) const {
    return path.absolute(opinion.path.prim());
  }

  Path deleted_target(Path path, const PropertyOpinion& opinion) {
    const Path target =
        map_with_targets(*index_.node_shape(opinion.node).map_to_root, absolute(path, opinion));
    if (!target.empty()) {
      list_.deleted.push_back(target);
      std::erase_if(errors_, [&](const Found& found) { return found.target == target; });
    }
    return target;
  }

  Path target_of(Path path, const PropertyOpinion& opinion) {
    const Path in_node = absolute(path, opinion);
    const Path target = map_with_targets(*index_.node_shape(opinion.node).map_to_root, in_node);
    if (target.empty() || (cache_ == nullptr && relocated_from_instance(in_node, opinion))) {
      const ArcKind arc = index_.nodes()[opinion.node].arc;
      const std::uint32_t parent = index_.nodes()[opinion.node].parent;
      const Path introduced = parent == kNoNode ? Path() : index_.nodes()[parent].path;
      const Path introduced_at = climb_to_introduction(index_, opinion.node, introduced);
      report(error_class::kInvalidExternalTargetPath, opinion, path, {},
             named(in_node) + " is outside of what the " + std::string(arc_name(arc)) + " of " +
                 named(introduced_at) + " brings in; it is ignored",
             "target something below the prim that the arc leads to");
      return {};
    }
    if (cache_ != nullptr && targets_instance_of_class(in_node, target, opinion)) {
      report(error_class::kInvalidInstanceTargetPath, opinion, path, target,
             named(in_node) + " is authored in a class but is inside its user; it is ignored",
             "target something within the class");
      return {};
    }
    return target;
  }

  /// An opinion in a class may not name what uses the class: the way back would not be unique.
  bool targets_instance_of_class(Path in_node, Path target, const PropertyOpinion& opinion) {
    const Node& node = index_.nodes()[opinion.node];
    if (node.arc != ArcKind::Inherit) {
      return false;
    }
    const Path the_class = climb_to_introduction(index_, opinion.node, node.path);
    if (in_node.has_prefix(the_class)) {
      return false;
    }
    const PrimIndex& there = cache_->index(target.prim());
    return std::ranges::any_of(there.nodes(), [&](const Node& other) {
      return other.arc == ArcKind::Inherit && other.layer_stack == node.layer_stack &&
             other.path.has_prefix(the_class);
    });
  }

  /// What lies in the prim that uses the class, before relocates, has no way back into the class.
  bool relocated_from_instance(Path in_node, const PropertyOpinion& opinion) const {
    const Node& node = index_.node_shape(opinion.node);
    if (node.arc != ArcKind::Inherit || !node.layer_stack->has_relocates()) {
      return false;
    }
    const Path user = climb_to_introduction(index_, opinion.node, index_.nodes()[node.parent].path);
    for (Path at = in_node; !at.empty(); at = at.parent()) {
      if (const Path* source = node.layer_stack->relocation_source(at)) {
        return source->has_prefix(user);
      }
    }
    return false;
  }

  void report(std::string_view error_class, const PropertyOpinion& opinion, Path authored,
              Path target, const Message& message, std::string fix) {
    const char* what = opinion.spec->kind == SpecKind::Attribute ? "connection " : "target ";
    errors_.push_back(
        {target, composition_error(error_class, Severity::Error,
                                   {opinion.layer, opinion.path, index_.path,
                                    layer::item_part(targets_field(*opinion.spec), authored)},
                                   what + message, std::move(fix))});
  }

  IndexCache* cache_;
  const PrimIndex& index_;
  Token property_;
  TargetList list_;
  std::vector<Found> errors_;
};

}  // namespace

std::vector<PropertyOpinion> property_opinions(const PrimIndex& index, Token name,
                                               Diagnostics* errors) {
  std::vector<PropertyOpinion> found;
  index.visit_property(name, [&](const Opinion& opinion) {
    const Path path = opinion.path;
    if (found.empty() || found.front().spec->kind == opinion.spec->kind) {
      found.push_back({opinion.layer, opinion.spec, path, opinion.node});
    } else if (errors != nullptr) {
      errors->add(composition_error(error_class::kInconsistentPropertyType, Severity::Error,
                                    {opinion.layer, path, index.path},
                                    named(path) + " is an attribute here and a relationship in " +
                                        named_in(*found.front().layer, found.front().path) +
                                        " or the reverse; it is ignored",
                                    "make both the same kind of property"));
    }
    return false;
  });
  return found;
}

TargetList compose_targets(IndexCache& cache, const PrimIndex& index, Token property) {
  return TargetCombiner(&cache, index, property)
      .combine(property_opinions(index, property, nullptr));
}

TargetList compose_stage_targets(const PrimIndex& index, Token property) {
  return TargetCombiner(nullptr, index, property)
      .combine(property_opinions(index, property, nullptr));
}

TargetOrigin origin_of_target(const PrimIndex& index, Token property, Path target) {
  for (const PropertyOpinion& opinion : property_opinions(index, property, nullptr)) {
    const auto* op = opinion.spec->get<ListOp<Path>>(targets_field(*opinion.spec));
    if (op == nullptr) {
      continue;
    }
    const MapFunction& map = *index.node_shape(opinion.node).map_to_root;
    for (const auto* items : {&op->explicit_items, &op->prepended, &op->appended, &op->added}) {
      for (const Path item : *items) {
        if (map_with_targets(map, item.absolute(opinion.path.prim())) == target) {
          return {opinion, layer::item_part(targets_field(*opinion.spec), item)};
        }
      }
    }
  }
  return {};
}

}  // namespace tenon::compose
