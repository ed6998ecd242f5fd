// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>

#include "tenon/base/result.h"
#include "tenon/structure/make/content_physics.h"
#include "tenon/structure/make/source_views.h"

namespace tenon::structure {

/// Meshes that only collide, and lie where one of the same points is drawn, go: the one that is
/// drawn collides in their place. Old path -> new path of each. Errors: Invalid "structure.differs"
/// where the physics would not be the same.
Result<std::map<Path, Path>> unite_coincident_meshes(SourceViews& views,
                                                     const ContentPhysics& physics);

}  // namespace tenon::structure
