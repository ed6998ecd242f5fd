// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/stage/attribute.h"
#include "tenon/stage/clips/clip_set.h"
#include "tenon/stage/composed_fields.h"
#include "tenon/stage/stage_data.h"

/// Which opinion gives an attribute its value. Internal to tenon/stage.
namespace tenon::stage {

struct ResolvedValue {
  ValueSource source = ValueSource::None;
  bool blocked = false;                         ///< a ValueBlock ended the search
  compose::Opinion opinion;                     ///< that decides
  const layer::Value* value = nullptr;          ///< of Default
  const layer::TimeSamples* samples = nullptr;  ///< of TimeSamples, in the layer's time
  const layer::Spline* spline = nullptr;        ///< of Spline, in the layer's time
  const ClipSet* clips = nullptr;               ///< of ValueClips; `opinion` has node and path
  const schema::PropertyDefinition* declared = nullptr;  ///< of Fallback
};

/// The opinions of an attribute that its value may be made of, strongest first: each but the last
/// may be an edit of an array.
using ValueSources = std::vector<ResolvedValue>;

/// What a value was made of besides the strongest opinion, for those who ask while it is read.
struct ReadTrace {
  enum class Use : unsigned char { NotRead, Edits, Gives, OtherType, MovedTowards };
  std::vector<Use> sources;  ///< of `value_sources`; empty where the strongest is read alone
  bool fallback = false;     ///< edits apply to the schema's fallback
  /// Weaker path expressions, the value of `%_`.
  struct PutIn {
    compose::Opinion opinion;
    ValueSource kind = ValueSource::None;
  };
  std::vector<PutIn> put_in;
};

enum class Asked : unsigned char { DefaultTime, AnyTime };
inline Asked asked_at(Time time) { return time.is_default() ? Asked::DefaultTime : Asked::AnyTime; }

/// Strongest to weakest layer: time samples, then spline, then default, then clips that come in
/// there; at the default time only defaults. Fallback when a schema has one and nothing is authored
/// (also when blocked).
ResolvedValue resolve_value(const PrimData& prim, Token name, Asked asked);

/// The value at the default time in place in a layer or a schema, when it means there what it means
/// on the stage; an empty one when nothing gives a value. Null when reading it takes more.
const layer::Value* value_in_place(const PrimData& prim, Token name);

/// The value of what was resolved, in the stage's terms; empty when blocked or nowhere.
layer::Value read_value(const StageData& stage, const PrimData& prim, Token name,
                        const ResolvedValue& resolved, Time time,
                        AssetForm form = AssetForm::Resolved, ReadTrace* trace = nullptr);

/// What an attribute gives at a time: resolved, read and, where it is a path expression, put
/// together; an attribute under an instance at `proxy_path` sees paths as that does.
layer::Value read_attribute(const StageData& stage, const PrimData& prim, Path proxy_path,
                            Token name, Time time, ReadTrace* trace = nullptr);

/// Of `read_value` without weaker opinions: an edit of an array comes back as it is.
layer::Value read_one_value(const StageData& stage, const PrimData& prim,
                            const ResolvedValue& resolved, Time time, AssetForm form,
                            Interpolation interpolation);

}  // namespace tenon::stage
