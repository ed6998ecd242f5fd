// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// Prints what composition makes of a root layer, for tests/conformance/composition and
// tests/differential.
//
// usage: composition_dump LAYER [--session LAYER] [OPTION OF COMPOSITION]... [--nodes
//                         [--prim PRIM] | --work]
//        composition_dump --batch
// Options of composition and --batch: see tests/tools/compose_options.h.
// Exit: 0 printed; 2 wrong usage; 3 a layer could not be opened.
#include <algorithm>
#include <cstdio>
#include <map>
#include <set>
#include <string>

#include "tenon/compose/dump_index.h"
#include "tenon/compose/targets.h"
#include "tenon/formats/open_layer.h"
#include "tests/tools/compose_options.h"

namespace {

using namespace tenon;
using tests::fail;
using tests::open_roots;
using tests::RootLayers;

struct Arguments {
  std::string root;
  std::string session;
  bool nodes = false;
  bool work = false;
  Path prim;  // of --nodes; empty: all
  compose::ComposeOptions options;
};

bool read_arguments(const std::vector<std::string>& words, Arguments& arguments) {
  arguments.options.variant_fallbacks["standin"] = {"render"};
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    if (word == "--nodes") {
      arguments.nodes = true;
    } else if (word == "--work") {
      arguments.work = true;
    } else if (word == "--prim" && i + 1 < words.size()) {
      arguments.prim = Path::from(words[++i]);
    } else if (word == "--session" && i + 1 < words.size()) {
      arguments.session = words[++i];
    } else if (tests::read_compose_option(words, i, arguments.options)) {
      continue;
    } else if (arguments.root.empty() && word.rfind("--", 0) != 0) {
      arguments.root = word;
    } else {
      return false;
    }
  }
  return !arguments.root.empty();
}

std::string folder_of(const std::string& identifier) {
  return identifier.substr(0, identifier.rfind('/') + 1);
}

/// Lines of properties that have targets or connections.
std::string targets_of(compose::IndexCache& cache, const compose::PrimIndex& index) {
  std::string text;
  for (const Token name : index.property_names) {
    const compose::TargetList targets = compose_targets(cache, index, name);
    std::string line;
    for (const Path path : targets.paths) {
      line += " " + path.str();
    }
    for (const Path path : targets.deleted) {
      line += " -" + path.str();
    }
    std::multiset<std::string> rules;
    for (const Diagnostic& found : targets.errors) {
      rules.insert(found.rule);
    }
    for (const std::string& rule : rules) {
      line += " " + rule;
    }
    text += line.empty() ? "" : "targets " + name.str() + line + "\n";
  }
  return text;
}

std::string joined(const char* heading, const std::vector<Token>& names) {
  std::string text;
  for (const Token name : names) {
    text += " " + name.str();
  }
  return text.empty() ? text : heading + text + "\n";
}

std::string in_brackets(const layer::LayerOffset& offset) {
  char text[100];
  std::snprintf(text, sizeof text, " (offset=%.2f, scale=%.2f)", offset.offset, offset.scale);
  return offset.is_identity() ? "" : text;
}

std::string layers_of(const compose::LayerStack& stack, const compose::LayerLabel& label) {
  std::string text = "== layers\n";
  for (const compose::StackedLayer& stacked : stack.layers) {
    text += label(*stacked.layer) + in_brackets(stacked.offset) + "\n";
  }
  for (const Diagnostic& found : stack.errors) {
    text += "!! " + found.rule + "\n";
  }
  return text;
}

/// Nodes, specs, findings, names and targets of one prim.
std::string facts_of(compose::IndexCache& cache, const compose::PrimIndex& index,
                     const compose::LayerLabel& label) {
  std::string text = dump_nodes(index, label);
  for (const compose::Opinion& opinion : index.opinions()) {
    text += "spec " + label(*opinion.layer) + " " + opinion.path.str() + "\n";
  }
  for (const Diagnostic& found : index.extras().errors) {
    text += "!! " + found.rule + "\n";
  }
  for (const auto& [set, variant] : index.extras().variant_selections) {
    text += "selected " + set + "=" + variant + "\n";
  }
  text += joined("children", index.child_names.list());
  text += joined("prohibited", index.extras().prohibited_child_names);
  text += joined("properties", index.property_names.list());
  return text + targets_of(cache, index);
}

/// Has all that is below these prims built ahead: what is printed must not change by it.
void build_ahead(compose::IndexCache& cache, const std::vector<const compose::PrimIndex*>& roots) {
  cache.build_below(roots, [](const compose::PrimIndex&) { return true; }, 100000);
}

/// The layer stack, then all prims depth-first.
std::string nodes_of_all(compose::IndexCache& cache, const compose::LayerLabel& label) {
  std::string text = layers_of(*cache.layer_stack(), label);
  std::map<std::string, Path> first_of_key;
  std::vector<const compose::PrimIndex*> open{&cache.index(Path::absolute_root())};
  for (std::size_t count = 0; !open.empty(); ++count) {
    if (count % 8 == 0) {
      build_ahead(cache, open);
    }
    const compose::PrimIndex& index = *open.back();
    open.pop_back();
    text += "== " + index.path.str();
    if (index.instanceable) {
      const Path first =
          first_of_key.emplace(index.extras().instance_key, index.path).first->second;
      text += " instance like " + first.str();
    }
    text += "\n" + facts_of(cache, index, label);
    const std::vector<Token>& names = index.child_names.list();
    for (auto name = names.rbegin(); name != names.rend(); ++name) {
      open.push_back(&cache.child_index(index, *name));
    }
  }
  return text;
}

std::string nodes_of_one(compose::IndexCache& cache, Path prim, const compose::LayerLabel& label) {
  return layers_of(*cache.layer_stack(), label) + "== " + prim.str() + "\n" +
         facts_of(cache, cache.index(prim), label);
}

/// What composing everything took, the size of what it made, and findings of limits.
std::string work_of_all(compose::IndexCache& cache) {
  std::size_t prims = 0;
  std::size_t nodes = 0;
  std::size_t contributing = 0;
  std::size_t findings = 0;
  std::size_t depth = 0;
  std::string limits;
  std::vector<const compose::PrimIndex*> open{&cache.index(Path::absolute_root())};
  while (!open.empty()) {
    const compose::PrimIndex& index = *open.back();
    open.pop_back();
    ++prims;
    nodes += index.nodes().size();
    for (const compose::Node& node : index.nodes()) {
      contributing += node.can_contribute() && node.has_specs ? 1 : 0;
    }
    findings += index.extras().errors.size();
    depth = std::max<std::size_t>(depth, index.path.depth());
    for (const Diagnostic& found : index.extras().errors) {
      if (found.rule.ends_with("exceeded")) {
        limits += found.rule + " " + found.message + "\n";
      }
    }
    const std::vector<Token>& names = index.child_names.list();
    for (auto name = names.rbegin(); name != names.rend(); ++name) {
      open.push_back(&cache.child_index(index, *name));
    }
  }
  const auto item = [](const char* name, std::size_t value) {
    return std::string(name) + " " + std::to_string(value) + "\n";
  };
  return item("work", cache.work()) + item("prims", prims) + item("nodes", nodes) +
         item("contributing", contributing) + item("findings", findings) + item("depth", depth) +
         limits;
}

int dump(const Arguments& arguments) {
  formats::LayerRegistry registry;
  const Result<RootLayers> roots = open_roots(registry, arguments.root, arguments.session);
  if (!roots) {
    return fail(roots.error());
  }
  compose::IndexCache cache(
      roots->root, roots->session,
      [&](const std::string& path, const layer::Layer& anchor) {
        return registry.open(path, &anchor);
      },
      arguments.options);
  const std::string folder = folder_of(roots->root->identifier());
  const compose::LayerLabel label = [&](const layer::Layer& layer) {
    const std::string& name = layer.identifier();
    return name.rfind(folder, 0) == 0 ? name.substr(folder.size()) : name;
  };
  build_ahead(cache, {&cache.index(Path::absolute_root())});
  const std::string text = arguments.work           ? work_of_all(cache)
                           : !arguments.nodes       ? compose::dump_indices(cache, label)
                           : arguments.prim.empty() ? nodes_of_all(cache, label)
                                                    : nodes_of_one(cache, arguments.prim, label);
  std::fwrite(text.data(), 1, text.size(), stdout);
  return 0;
}

int run(const std::vector<std::string>& words) {
  Arguments arguments;
  if (!read_arguments(words, arguments)) {
    std::fprintf(stderr, "usage: see the head of tests/tools/composition_dump.cpp\n");
    return 2;
  }
  return dump(arguments);
}

}  // namespace

int main(int count, char** words) { return tests::run_or_batch({words + 1, words + count}, run); }
