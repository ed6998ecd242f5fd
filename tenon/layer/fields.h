// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/base/token.h"

/// Names of the core fields (Core Spec 1.0.1 section 7), made once.
namespace tenon::layer::fields {

// clang-format off: it does not come to an end with this list.
#define TENON_FIELDS(X)                                                                         \
  X(active) X(allowedTokens) X(allowedValues) X(apiSchemas) X(assetInfo) X(clips) X(clipSets)   \
  X(colorConfiguration) X(colorManagementSystem) X(colorSpace) X(comment) X(connectionChildren) \
  X(connectionPaths) X(custom) X(customData) X(customLayerData) X(defaultPrim) X(displayGroup)  \
  X(displayName) X(displayUnit) X(documentation) X(endFrame) X(endTimeCode)                     \
  X(expressionVariables) X(framePrecision) X(framesPerSecond) X(hasOwnedSubLayers) X(hidden)    \
  X(inheritPaths) X(instanceable) X(kilogramsPerUnit) X(kind) X(layerRelocates)                 \
  X(metersPerUnit) X(noLoadHint) X(owner) X(payload) X(permission) X(prefix)                    \
  X(prefixSubstitutions) X(primChildren) X(primOrder) X(properties) X(propertyOrder)            \
  X(references) X(relocates) X(sessionOwner) X(specializes) X(specifier) X(spline)              \
  X(startFrame) X(startTimeCode) X(subLayerOffsets) X(subLayers) X(suffix)                      \
  X(suffixSubstitutions) X(symmetryFunction) X(targetChildren) X(targetPaths) X(timeSamples)    \
  X(timeCodesPerSecond) X(typeName) X(upAxis) X(variability) X(variantChildren)                 \
  X(variantSelection) X(variantSetChildren) X(variantSetNames)
// clang-format on

#define TENON_DECLARE_FIELD(name) inline const Token name{#name};
TENON_FIELDS(TENON_DECLARE_FIELD)
#undef TENON_DECLARE_FIELD

/// The field "default", whose name is a C++ word.
inline const Token default_value{"default"};

}  // namespace tenon::layer::fields
