// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/open_indices.h"

#include "tenon/open_stage.h"
#include "tenon/stage_sources.h"

namespace tenon {

Result<std::unique_ptr<compose::IndexCache>> open_indices(const std::string& path,
                                                          const OpenOptions& options,
                                                          Diagnostics& diagnostics) {
  TENON_TRY(const StageSources sources, open_sources(path, options));
  TENON_TRY(auto compose, compose_options(options, *sources.root));
  diagnostics.append(sources.registry->diagnostics());
  return std::make_unique<compose::IndexCache>(sources.root, sources.session, sources.opener(),
                                               std::move(compose));
}

}  // namespace tenon
