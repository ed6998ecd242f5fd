// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>

#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/structure/make/content_physics.h"
#include "tenon/structure/make/link_nesting.h"
#include "tenon/structure/make/source_views.h"

/// Internal to this folder.
namespace tenon::structure {

/// Exchanges vendors' schemas in all views, as asked for. Errors: Invalid "structure.differs" where
/// the physics of a view is then not what it was.
Result<void> change_generation(SourceViews& views, SchemaGeneration generation,
                               const ContentPhysics& physics, Diagnostics& diagnostics);

/// What SimReady asks of shapes, in all views: one mesh where one is drawn and one collides
/// (one_mesh.h), a material for each (default_material.h). Old path -> new path of meshes that
/// went. Errors: those of unite_coincident_meshes.
Result<std::map<Path, Path>> change_for_simready(SourceViews& views, const ContentPhysics& physics);

/// Lays links side by side or within each other in all views, as asked for; none: they stay where
/// they are. Errors: the same, where something then stands elsewhere or moves otherwise.
Result<std::optional<LinkMoves>> move_links(SourceViews& views, LinkNesting nesting,
                                            const ContentPhysics& physics,
                                            Diagnostics& diagnostics);

}  // namespace tenon::structure
