// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// Writes the result of composition in the text form that the published suite records, so that the
// two can be compared. The walk through all prims is depth first with a list of open prims instead
// of recursion. Nodes come parents first, so one scan knows every depth.
#include "tenon/compose/dump_index.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <map>

#include "tenon/compose/arcs/arc_name.h"
#include "tenon/compose/targets.h"
#include "tenon/layer/fields.h"

namespace tenon::compose {
namespace {

const std::string kRule(72, '-');

std::string padded(std::string text, std::size_t width) {
  if (text.size() < width) {
    text.resize(width, ' ');
  }
  return text;
}

std::string two_digits(double value) {
  std::array<char, 400> buffer{};
  const int length = std::snprintf(buffer.data(), buffer.size(), "%.2f", value);
  return std::string(buffer.data(), static_cast<std::size_t>(std::max(length, 0)));
}

std::string in_brackets(const layer::LayerOffset& offset) {
  return "(offset=" + two_digits(offset.offset) + ", scale=" + two_digits(offset.scale) + ")";
}

/// As Python prints a list of strings.
std::string name_list(const std::vector<Token>& names) {
  std::string text;
  for (const Token name : names) {
    text += (text.empty() ? "'" : ", '") + name.str() + "'";
  }
  return "[" + text + "]";
}

class Dump {
 public:
  Dump(IndexCache& cache, const LayerLabel& label) : cache_(cache), label_(label) {}

  std::string take() { return std::move(text_); }

  void layer_stack() {
    text_ += kRule + "\nLayer Stack:\n";
    for (const StackedLayer& stacked : cache_.layer_stack()->layers) {
      text_ += "     " + label_(*stacked.layer) + "\n";
    }
    text_ += "\n";
    const Diagnostics& errors = cache_.layer_stack()->errors;
    if (!errors.empty()) {
      text_ += kRule + "\nErrors while computing Layer Stack\n\n";
      findings(errors);
    }
  }

  void prim(const PrimIndex& index) {
    text_ += kRule + "\nResults for composing <" + index.path.str() + ">\n";
    Diagnostics errors = index.extras().errors;
    const std::vector<Property> properties = collect(index, errors);
    prim_stack(index);
    time_offsets(index);
    variant_selections(index);
    names("Child names", index.child_names.list());
    names("Prohibited child names", index.extras().prohibited_child_names);
    names("Property names", index.property_names.list());
    property_stacks(properties);
    targets("Relationship targets", properties, false, &TargetList::paths);
    targets("Attribute connections", properties, true, &TargetList::paths);
    deleted_targets(properties);
    if (!errors.empty()) {
      text_ += kRule + "\nErrors while composing <" + index.path.str() + ">\n\n";
      findings(errors);
    }
    text_ += "\n";
  }

 private:
  struct Property {
    Path path;
    std::vector<PropertyOpinion> stack;
    TargetList targets;
    bool attribute() const { return stack.front().spec->kind == layer::SpecKind::Attribute; }
  };

  std::vector<Property> collect(const PrimIndex& index, Diagnostics& errors) {
    std::vector<Property> result;
    for (const Token name : index.property_names) {
      Property property;
      property.path = index.path.property(name);
      property.stack = property_opinions(index, name, &errors);
      if (property.stack.empty()) {
        continue;
      }
      property.targets = compose_targets(cache_, index, name);
      errors.append(property.targets.errors);
      result.push_back(std::move(property));
    }
    std::sort(result.begin(), result.end(),
              [](const Property& a, const Property& b) { return a.path < b.path; });
    return result;
  }

  void spec_line(const layer::Layer& layer, Path path) {
    text_ += "    " + padded(label_(layer), 20) + " " + path.str() + "\n";
  }

  void prim_stack(const PrimIndex& index) {
    text_ += "\nPrim Stack:\n";
    for (const Opinion& opinion : index.opinions()) {
      spec_line(*opinion.layer, opinion.path);
    }
  }

  void time_offsets(const PrimIndex& index) {
    const bool any = std::ranges::any_of(index.nodes(), [](const Node& node) {
      return !node.map_to_parent->offset().is_identity() || node.layer_stack->has_offsets;
    });
    if (!any) {
      return;
    }
    text_ += "\nTime Offsets:\n";
    for (const Node& node : index.nodes()) {
      text_ += "    " + padded(label_(*node.layer_stack->layers.front().layer), 20) + " " +
               padded(node.path.str(), 15) + " " + padded(std::string(arc_name(node.arc)), 10) +
               " " + in_brackets(node.map_to_root->offset()) + "\n";
      for (const StackedLayer& stacked : node.layer_stack->layers) {
        if (!stacked.offset.is_identity()) {
          text_ += "        " + padded(label_(*stacked.layer), 32) + " " + padded("sublayer", 10) +
                   " " + in_brackets(stacked.offset) + "\n";
        }
      }
    }
  }

  void variant_selections(const PrimIndex& index) {
    if (index.extras().variant_selections.empty()) {
      return;
    }
    text_ += "\nVariant Selections:\n";
    for (const auto& [set, variant] : index.extras().variant_selections) {
      text_ += "    {" + set + " = " + variant + "}\n";
    }
  }

  void names(const char* heading, const std::vector<Token>& list) {
    if (!list.empty()) {
      text_ += "\n" + std::string(heading) + ":\n     " + name_list(list) + "\n";
    }
  }

  void property_stacks(const std::vector<Property>& properties) {
    if (properties.empty()) {
      return;
    }
    text_ += "\nProperty stacks:\n";
    for (const Property& property : properties) {
      text_ += property.path.str() + ":\n";
      for (const PropertyOpinion& opinion : property.stack) {
        spec_line(*opinion.layer, opinion.path);
      }
    }
  }

  void target_block(std::string& block, const Property& property, const std::vector<Path>& paths) {
    block += property.path.str() + ":\n";
    for (const Path path : paths) {
      block += "    " + path.str() + "\n";
    }
  }

  void targets(const char* heading, const std::vector<Property>& properties, bool attributes,
               std::vector<Path> TargetList::* paths) {
    std::string block;
    for (const Property& property : properties) {
      if (property.attribute() == attributes && !(property.targets.*paths).empty()) {
        target_block(block, property, property.targets.*paths);
      }
    }
    if (!block.empty()) {
      text_ += "\n" + std::string(heading) + ":\n" + block;
    }
  }

  void deleted_targets(const std::vector<Property>& properties) {
    std::string block;
    for (const Property& property : properties) {
      if (!property.targets.deleted.empty()) {
        target_block(block, property, property.targets.deleted);
      }
    }
    if (!block.empty()) {
      text_ += "\nDeleted target paths:\n" + block;
    }
  }

  void findings(const Diagnostics& errors) {
    for (const Diagnostic& found : errors) {
      text_ += found.rule + " " + found.message + "\n";
    }
    text_ += "\n";
  }

  IndexCache& cache_;
  const LayerLabel& label_;
  std::string text_;
};

}  // namespace

std::string dump_indices(IndexCache& cache, const LayerLabel& label,
                         const std::vector<Path>& prims) {
  Dump dump(cache, label);
  if (!prims.empty()) {
    for (const Path path : prims) {
      dump.prim(cache.index(path));
    }
    return dump.take();
  }
  dump.layer_stack();
  std::vector<const PrimIndex*> open;
  const auto open_children = [&](const PrimIndex& index) {
    const std::vector<Token>& names = index.child_names.list();
    for (auto name = names.rbegin(); name != names.rend(); ++name) {
      open.push_back(&cache.child_index(index, *name));
    }
  };
  open_children(cache.index(Path::absolute_root()));
  while (!open.empty()) {
    const PrimIndex& index = *open.back();
    open.pop_back();
    dump.prim(index);
    open_children(index);
  }
  return dump.take();
}

std::string dump_nodes(const PrimIndex& index, const LayerLabel& label) {
  std::string text;
  std::vector<std::size_t> depths(index.nodes().size(), 0);
  for (std::size_t id = 0; id < index.nodes().size(); ++id) {
    const Node& node = index.nodes()[id];
    depths[id] = node.parent == kNoNode ? 0 : depths[node.parent] + 1;
    text += std::string(2 * depths[id], ' ') + std::string(arc_name(node.arc)) + " " +
            label(*node.layer_stack->root) + " " + node.path.str();
    text += node.can_contribute() ? "" : " inert";
    text += node.culled ? " culled" : "";
    text += node.has_specs ? "" : " no-specs";
    text += node.due_to_ancestor ? " ancestral" : "";
    if (!node.map_to_root->offset().is_identity()) {
      text += " " + in_brackets(node.map_to_root->offset());
    }
    text += "\n";
  }
  return text;
}

}  // namespace tenon::compose
