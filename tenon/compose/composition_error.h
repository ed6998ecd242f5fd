// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "tenon/base/diagnostics.h"
#include "tenon/base/path.h"
#include "tenon/layer/layer.h"

/// Findings of composition. A class is named as OpenUSD names the error, in kebab case; the rule of
/// the diagnostic is "compose." and the class.
namespace tenon::compose {

namespace error_class {
inline constexpr std::string_view kArcCycle = "arc-cycle";
inline constexpr std::string_view kArcToProhibitedChild = "arc-to-prohibited-child";
inline constexpr std::string_view kCapacityExceeded = "index-capacity-exceeded";
inline constexpr std::string_view kInconsistentPropertyType = "inconsistent-property-type";
inline constexpr std::string_view kInvalidAssetPath = "invalid-asset-path";
inline constexpr std::string_view kInvalidAuthoredRelocation = "invalid-authored-relocation";
inline constexpr std::string_view kInvalidConflictingRelocation = "invalid-conflicting-relocation";
inline constexpr std::string_view kInvalidExternalTargetPath = "invalid-external-target-path";
inline constexpr std::string_view kInvalidInstanceTargetPath = "invalid-instance-target-path";
inline constexpr std::string_view kInvalidPrimPath = "invalid-prim-path";
inline constexpr std::string_view kInvalidReferenceOffset = "invalid-reference-offset";
inline constexpr std::string_view kInvalidSameTargetRelocations = "invalid-same-target-relocations";
inline constexpr std::string_view kInvalidSublayerOffset = "invalid-sublayer-offset";
inline constexpr std::string_view kInvalidSublayerOwnership = "invalid-sublayer-ownership";
inline constexpr std::string_view kInvalidSublayerPath = "invalid-sublayer-path";
inline constexpr std::string_view kMutedAssetPath = "muted-asset-path";
inline constexpr std::string_view kOpinionAtRelocationSource = "opinion-at-relocation-source";
inline constexpr std::string_view kSublayerCycle = "sublayer-cycle";
inline constexpr std::string_view kUnresolvedPrimPath = "unresolved-prim-path";
inline constexpr std::string_view kVariableExpressionError = "variable-expression-error";
/// No class of OpenUSD's, which goes on until it has no memory.
inline constexpr std::string_view kWorkExceeded = "work-exceeded";
}  // namespace error_class

/// Where something is authored: a spec of a layer, and the stage prim that it matters for.
struct AuthoredAt {
  const layer::Layer* layer = nullptr;  ///< may be null
  Path spec;                            ///< line and column are this spec's
  Path prim;                            ///< in the stage's namespace; may be empty
  StatementPart part{};                 ///< what of the spec it is about; empty: all of it
};

/// A finding with the file and line of the spec where its cause is authored.
Diagnostic composition_error(std::string_view error_class, Severity severity, const AuthoredAt& at,
                             const Message& message, std::string fix);

/// Composition ended at its bound of work: what was composed is a part.
bool is_work_exceeded(const Diagnostic& found);

/// `@layer@<path>`: a path within a layer.
Message named_in(const layer::Layer& layer, Path path);

}  // namespace tenon::compose
