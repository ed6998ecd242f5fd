// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/base/diagnostics.h"
#include "tenon/compose/arcs/arc.h"
#include "tenon/compose/site.h"

/// Which item of which layer an arc comes from, for findings about it.
namespace tenon::compose {

struct AuthoredArc {
  const layer::Layer* layer = nullptr;  ///< null: no item was found
  StatementPart part;
};

/// The strongest item of this kind that leads from `path` to `target`, or to a default prim.
AuthoredArc authored_arc(const LayerStack& stack, Path path, ArcKind kind, Path target);

/// The item that a reference or payload was made of; its asset path may be an expression there.
StatementPart authored_item(const AssetArc& arc, Path path, ArcKind kind);

}  // namespace tenon::compose
