// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/answers/index_dump.h"

#include <filesystem>

#include "tenon/compose/dump_index.h"
#include "tenon/open_indices.h"

namespace tenon {
namespace {

Diagnostic missing_layer(const compose::MissingArc& arc) {
  Diagnostic finding;
  finding.rule = "compose.invalid-asset-path";
  finding.message = "the " + std::string(arc.arc) + " @" + arc.path + "@ cannot be opened";
  finding.file = arc.layer;
  finding.prim = arc.prim.str();
  finding.fix = "correct the path or provide the file";
  return finding;
}

}  // namespace

Result<std::string> dump_index(const std::string& path, const OpenOptions& options,
                               const std::vector<std::string>& prims, IndexFindings findings) {
  std::vector<Path> paths;
  for (const std::string& text : prims) {
    TENON_TRY(const Path prim, Path::parse(text));
    paths.push_back(prim);
  }
  TENON_TRY(auto cache, open_indices(path, options, findings.opening));
  const std::filesystem::path folder =
      std::filesystem::path(cache->layer_stack()->root->identifier()).parent_path();
  const auto label = [&folder](const layer::Layer& layer) {
    const std::filesystem::path file(layer.identifier());
    return file.is_absolute() ? file.lexically_proximate(folder).generic_string()
                              : layer.identifier();
  };
  std::string text = compose::dump_indices(*cache, label, paths);
  for (const compose::MissingArc& arc : cache->missing_arcs()) {
    findings.missing.add(missing_layer(arc));
  }
  return text;
}

}  // namespace tenon
