// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "tenon/base/diagnostics.h"
#include "tenon/base/token.h"
#include "tenon/layer/layer.h"
#include "tenon/layer/value.h"
#include "tenon/stage/stage.h"

/// The reading of S-11 that takes each opinion in the units of the layer that holds it.
namespace tenon::physics {

/// What a number measures, as powers of length and mass (S-12). Seconds and degrees are the same in
/// every layer.
struct Dimension {
  int length = 0;
  int mass = 0;
  bool operator==(const Dimension&) const = default;
};

/// Of an attribute of UsdGeom, UsdPhysics or of PhysX's collision API on a prim of that type;
/// `acceleration`: the drive that it belongs to gives accelerations. None for everything else.
Dimension dimension_of(std::string_view attribute, Token prim_type, bool acceleration);

/// The value times `factor`; of matrices the translation alone. Magnitudes from 0.5e38 on, which
/// mean unlimited (S-4), and what is no floating-point number stay as they are.
layer::Value scaled_value(const layer::Value& value, double factor);

/// The layers of a stage that author other units of length or mass than it has, written in its
/// units, by identifier: a stage composed of them is in one set of units. Fallbacks of schemas are
/// opinions of no layer. Axes are not turned: upAxis stays with its warning.
std::map<std::string, layer::LayerPtr> layers_in_stage_units(const stage::Stage& stage);

}  // namespace tenon::physics
