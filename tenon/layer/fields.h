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

/// Where the names are kept: one object, so that no unit has more to initialize.
struct FieldNames {
  FieldNames();
#define TENON_KEEP_FIELD(name) Token name{#name};
  TENON_FIELDS(TENON_KEEP_FIELD)
#undef TENON_KEEP_FIELD
  Token default_value{"default"};
};
inline const FieldNames kNames;

#define TENON_DECLARE_FIELD(name) inline constexpr const Token& name = kNames.name;
TENON_FIELDS(TENON_DECLARE_FIELD)  // NOLINT(readability-identifier-naming): the words of USD
#undef TENON_DECLARE_FIELD

/// The field "default", whose name is a C++ word.
inline constexpr const Token& default_value = kNames.default_value;  // NOLINT: as the others

}  // namespace tenon::layer::fields
