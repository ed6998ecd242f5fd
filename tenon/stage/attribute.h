// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "tenon/base/path.h"
#include "tenon/layer/layer.h"
#include "tenon/stage/property.h"
#include "tenon/stage/time.h"

namespace tenon::schema {
struct PropertyDefinition;
}

namespace tenon::stage {

struct ValueTrace;

enum class ValueSource : unsigned char { None, Fallback, Default, TimeSamples, ValueClips, Spline };

/// An attribute of a composed prim; a small handle by value.
class Attribute : public Property {
 public:
  Attribute() = default;

  /// Authored somewhere, or built into the prim's type or applied schemas.
  bool is_defined() const;
  bool is_authored() const { return is_authored_as(layer::SpecKind::Attribute); }
  Token type_name() const;
  layer::Variability variability() const;
  bool is_custom() const;

  /// The resolved value: time samples, then default, per layer from strongest to weakest; then the
  /// schema fallback. Empty when there is none or it is blocked. Interpolated linearly where the
  /// type allows it.
  layer::Value get(Time time = {}) const;
  /// The value of get() in place, while the stage lives and its layers are not edited: no copy is
  /// made. Null when reading it takes more than to find it (asset paths, time codes, path
  /// expressions, edits of arrays, blocks).
  const layer::Value* value_in_place() const;
  /// The value when it is exactly a T.
  template <class T>
  std::optional<T> get_as(Time time = {}) const {
    const layer::Value value = get(time);
    const T* contents = value.get<T>();
    return contents == nullptr ? std::nullopt : std::optional<T>(*contents);
  }
  /// The same value with every opinion about it and what became of each
  /// (stage/values/value_trace.h).
  ValueTrace trace(Time time = {}) const;
  /// What the schemas say when nothing is authored; empty when they say nothing.
  layer::Value fallback() const;
  /// The schemas' declaration, vendor schemas included; nullptr when there is none.
  const schema::PropertyDefinition* definition() const;
  /// For the default time or any time: where the value comes from; Fallback also when blocked.
  ValueSource value_source(Time time = {}) const;
  bool has_authored_value() const;
  bool is_blocked(Time time = {}) const;
  /// Times of the samples that contribute, in stage time.
  std::vector<double> time_samples() const;
  /// Value may differ between times: several samples, or a spline.
  bool is_animated() const;
  /// The spline that gives the value, in stage time; nothing when something else does.
  std::optional<layer::Spline> spline() const;

  bool has_authored_connections() const;
  std::vector<Path> connections() const { return composed_targets(); }

  layer::Value metadata(Token field) const;

 private:
  friend class Prim;
  Attribute(const StageData* stage, const PrimData* prim, Path proxy_path, Token name)
      : Property(stage, prim, proxy_path, name) {}
};

}  // namespace tenon::stage
