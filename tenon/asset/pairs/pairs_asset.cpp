// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/pairs/pairs_asset.h"

#include <utility>

#include "tenon/asset/physics_options.h"
#include "tenon/base/file_finding.h"
#include "tenon/base/text/shell_word.h"
#include "tenon/base/text/shown_path.h"
#include "tenon/physics/read_physics.h"

namespace tenon {

Result<PairsOfAsset> bodies_of_asset(const std::string& path, const OpenOptions& open,
                                     Diagnostics& diagnostics) {
  PairsOfAsset pairs;
  TENON_TRY(stage::Stage stage, tenon::open(path, open, diagnostics));
  pairs.stage = std::make_unique<stage::Stage>(std::move(stage));
  pairs.scene = std::make_unique<scene::PhysicsScene>(
      physics::read_physics(*pairs.stage, read_options(), diagnostics, &pairs.provenance));
  if (pairs.scene->bodies.empty()) {
    diagnostics.add(file_finding(Severity::Warning, "pairs.no-bodies",
                                 "the asset has no bodies, as it is selected here", path, 0,
                                 "tenon variant " + shell_word(shown_path(path)) +
                                     " lists its variants; --physics selects one of Physics"));
  }
  return pairs;
}

Result<PairsOfAsset> pairs_of_asset(const std::string& path, const OpenOptions& open,
                                    const BodyPairsOptions& options, Diagnostics& diagnostics) {
  TENON_TRY(PairsOfAsset pairs, bodies_of_asset(path, open, diagnostics));
  pairs.options = options;
  TENON_TRY(pairs.found, body_pairs(*pairs.scene, pairs.provenance, options, diagnostics));
  return pairs;
}

}  // namespace tenon
