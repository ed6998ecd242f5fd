// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// Prints what composition makes of a root layer, for tests/conformance/composition and
// tests/differential.
//
// usage: composition_dump LAYER [--session LAYER] [--no-payloads] [--loaded PRIM]...
//                         [--unloaded PRIM]... [--nodes]
// Exit: 0 printed; 2 wrong usage; 3 a layer could not be opened.
#include <cstdio>
#include <cstring>
#include <string>

#include "tenon/compose/dump_index.h"
#include "tenon/compose/targets.h"
#include "tenon/formats/open_layer.h"

namespace {

using namespace tenon;

struct Arguments {
  std::string root;
  std::string session;
  bool nodes = false;
  compose::ComposeOptions options;
};

bool read_arguments(int count, char** words, Arguments& arguments) {
  arguments.options.variant_fallbacks["standin"] = {"render"};
  for (int i = 1; i < count; ++i) {
    const std::string word = words[i];
    const bool has_value = i + 1 < count;
    if (word == "--nodes") {
      arguments.nodes = true;
    } else if (word == "--no-payloads") {
      arguments.options.load_payloads = false;
    } else if (word == "--session" && has_value) {
      arguments.session = words[++i];
    } else if (word == "--loaded" && has_value) {
      arguments.options.loaded.insert(Path::from(words[++i]));
    } else if (word == "--unloaded" && has_value) {
      arguments.options.unloaded.insert(Path::from(words[++i]));
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
    for (const Diagnostic& found : targets.errors) {
      line += " " + found.rule;
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

/// All prims depth-first, each with its nodes, findings, names and targets.
std::string nodes_of_all(compose::IndexCache& cache, const compose::LayerLabel& label) {
  std::string text;
  std::vector<const compose::PrimIndex*> open{&cache.index(Path::absolute_root())};
  while (!open.empty()) {
    const compose::PrimIndex& index = *open.back();
    open.pop_back();
    text += "== " + index.path.str() + (index.instanceable ? " instanceable" : "") + "\n";
    text += dump_nodes(index, label);
    for (const Diagnostic& found : index.errors) {
      text += "!! " + found.rule + "\n";
    }
    text += joined("children", index.child_names);
    text += joined("prohibited", index.prohibited_child_names);
    text += joined("properties", index.property_names);
    text += targets_of(cache, index);
    for (auto name = index.child_names.rbegin(); name != index.child_names.rend(); ++name) {
      open.push_back(&cache.child_index(index, *name));
    }
  }
  return text;
}

int fail(const Error& error) {
  std::fprintf(stderr, "%s\n", error.to_string().c_str());
  return 3;
}

int dump(const Arguments& arguments) {
  formats::LayerRegistry registry;
  const Result<layer::LayerPtr> root = registry.open_root(arguments.root);
  if (!root) {
    return fail(root.error());
  }
  layer::LayerPtr session;
  if (!arguments.session.empty()) {
    const Result<layer::LayerPtr> opened = registry.open(arguments.session, nullptr);
    if (!opened) {
      return fail(opened.error());
    }
    session = *opened;
  }
  compose::IndexCache cache(
      *root, session,
      [&](const std::string& path, const layer::Layer& anchor) {
        return registry.open(path, &anchor);
      },
      arguments.options);
  const std::string folder = folder_of((*root)->identifier());
  const compose::LayerLabel label = [&](const layer::Layer& layer) {
    const std::string& name = layer.identifier();
    return name.rfind(folder, 0) == 0 ? name.substr(folder.size()) : name;
  };
  const std::string text =
      arguments.nodes ? nodes_of_all(cache, label) : compose::dump_indices(cache, label);
  std::fwrite(text.data(), 1, text.size(), stdout);
  return 0;
}

}  // namespace

int main(int count, char** words) {
  Arguments arguments;
  if (!read_arguments(count, words, arguments)) {
    std::fprintf(stderr, "usage: composition_dump LAYER [--session LAYER] [--no-payloads] "
                         "[--loaded PRIM]... [--unloaded PRIM]... [--nodes]\n");
    return 2;
  }
  return dump(arguments);
}
