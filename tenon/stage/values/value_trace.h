// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "tenon/layer/value.h"
#include "tenon/stage/attribute.h"
#include "tenon/stage/sources/opinion_sources.h"
#include "tenon/stage/time.h"
#include "tenon/stage/values/opinion_role.h"

namespace tenon::stage {

/// The clip in force at the time of a trace.
struct TracedClip {
  std::string set;    ///< name of the clip set
  std::string layer;  ///< identifier of the clip's layer; empty when it cannot be opened
  Path path;          ///< of the attribute there
  double time = 0;    ///< of the trace, in the clip's time codes
};

/// One opinion about a value.
struct TracedOpinion {
  /// TimeSamples, Spline, Default: that field of the spec. ValueClips: a clip set. Fallback: of a
  /// schema. None: a spec that only declares.
  ValueSource kind = ValueSource::None;
  /// The spec and the way to it; of clips the prim spec that names them; of a fallback nothing.
  OpinionSource source;
  /// As authored, in the layer's own times; of clips the samples of the clip in force. nullptr
  /// where there is no opinion. Lives as long as the stage.
  const layer::Value* value = nullptr;
  std::optional<TracedClip> clip;  ///< of ValueClips, but not at the default time
  Token schema;                    ///< of Fallback: what declares it
  OpinionRole role = OpinionRole::Loses;
  OpinionReason reason = OpinionReason::None;
  std::optional<std::size_t> decided_by;  ///< of the losing: which of the opinions is the cause

  bool is_block() const { return value != nullptr && value->is_block(); }
};

/// What resolution of a value did: Attribute::trace.
struct ValueTrace {
  Time time;
  layer::Value value;                      ///< Attribute::get(time)
  ValueSource source = ValueSource::None;  ///< Attribute::value_source(time)
  std::vector<TracedOpinion> opinions;     ///< strongest first; fallbacks of schemas last

  /// The opinion that wins; nullptr where there is none or arrays are edited over nothing.
  const TracedOpinion* winner() const;
};

}  // namespace tenon::stage
