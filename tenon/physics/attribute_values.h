// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <unordered_set>

#include "tenon/base/diagnostics.h"
#include "tenon/layer/value.h"
#include "tenon/math/quaternion.h"
#include "tenon/math/vector.h"
#include "tenon/physics/readings.h"
#include "tenon/physics/units.h"
#include "tenon/stage/attribute.h"
#include "tenon/stage/prim.h"
#include "tenon/stage/stage.h"
#include "tenon/stage/targets/placed_targets.h"
#include "tenon/stage/time.h"
#include "tenon/stage/values/value_memo.h"

namespace tenon::physics {

/// What a look at all layers of a stage tells about every prim of it.
struct LayerContents {
  bool animated = false;    ///< some layer holds time samples, splines or value clips
  bool names_apis = false;  ///< some property may be of physics, by its name: names_physics()
};
LayerContents layer_contents(const stage::Stage& stage);

/// A property of that name may mean something to physics: it begins as those do that APIs of
/// physics declare, or says what the prim measures.
bool names_physics(Token property);

/// A number of any numeric type; nullopt for anything else.
std::optional<double> number_of(const layer::Value& value);
/// A number that the file has as a float, as written there: 0.1, not 0.10000000149011612.
std::string text_of_float(double value);

/// Reads attribute values as the schema types them, once, at the start of the simulation.
/// Values of another type, NaN and blocks count as unauthored: then the schema's fallback or
/// nullopt comes back, with a diagnostic for the first two (S-3, S-4, S-5).
class AttributeValues {
 public:
  /// `contents`: of the layers of the stage that the prims are of.
  AttributeValues(stage::Time start, LayerContents contents, ValueTypes types,
                  Diagnostics& diagnostics)
      : start_(start), contents_(contents), types_(types), diagnostics_(&diagnostics) {}

  /// The same at another time, where samples win over a default beside them: they are followed.
  AttributeValues at_sample(stage::Time time, Diagnostics& diagnostics) const {
    AttributeValues later = *this;
    later.start_ = time;
    later.samples_first_ = true;
    later.diagnostics_ = &diagnostics;
    later.asked_ = nullptr;
    return later;
  }
  /// From here on the attributes that vary and are asked for are put into `asked`, as
  /// "PRIM.attribute"; null: no more.
  void note_asked(std::unordered_set<std::string>* asked) { asked_ = asked; }

  stage::Time start() const { return start_; }
  /// The same where something varies; else any time is as good, and the default the fastest.
  stage::Time transform_time() const { return contents_.animated ? start_ : stage::Time(); }
  bool stage_is_animated() const { return contents_.animated; }
  bool stage_names_apis() const { return contents_.names_apis; }
  Diagnostics& diagnostics() const { return *diagnostics_; }

  /// The value where it is exactly a T.
  template <class T>
  std::optional<T> get(const stage::Prim& prim, Token name) const {
    layer::Value room;
    const layer::Value& value = resolved(prim.attribute(name), room);
    if (value.empty() || value.is_block()) {
      return std::nullopt;
    }
    const T* contents = value.get<T>();
    if (contents == nullptr) {
      report_type(prim, name, layer::ValueTraits<T>::type, layer::ValueTraits<T>::is_array);
      return std::nullopt;
    }
    return *contents;
  }
  bool flag(const stage::Prim& prim, Token name, bool fallback) const {
    return get<bool>(prim, name).value_or(fallback);
  }
  /// A float that is a number; sentinels come back as infinities (S-4).
  std::optional<double> number(const stage::Prim& prim, Token name) const;
  /// The same for attributes that are double in their schema (shapes).
  std::optional<double> wide_number(const stage::Prim& prim, Token name) const;
  std::optional<Vec3d> vector(const stage::Prim& prim, Token name) const;
  /// Unit quaternion; nullopt for a zero one (S-89).
  std::optional<Quatd> rotation(const stage::Prim& prim, Token name) const;
  /// A number that the asset authors, of any numeric type: vendor schemas are written both ways.
  std::optional<double> authored_number(const stage::Prim& prim, Token name) const;
  std::optional<bool> authored_flag(const stage::Prim& prim, Token name) const;

  /// One finding with the place of the strongest opinion about the attribute.
  void report(const stage::Prim& prim, Token name, Severity severity, const char* rule,
              const Message& message, std::string fix, StatementPart part = {}) const;
  /// The same with the place of one of its targets, of the first ones of a property.
  void report_target(const stage::Prim& prim, Token name, Path target, Severity severity,
                     const char* rule, const Message& message, std::string fix) const;

 private:
  /// The value where it stands, or in `room`.
  const layer::Value& resolved(const stage::Attribute& attribute, layer::Value& room) const;
  void report_type(const stage::Prim& prim, Token name, layer::ValueType wanted, bool wanted_array,
                   bool converted = false) const;
  bool check_number(const stage::Prim& prim, Token name, double value) const;

  stage::Time start_;
  LayerContents contents_;
  ValueTypes types_ = ValueTypes::Strict;
  bool samples_first_ = false;
  std::unordered_set<std::string>* asked_ = nullptr;
  Diagnostics* diagnostics_;
  std::shared_ptr<stage::ValueMemo> memo_ = std::make_shared<stage::ValueMemo>();
  std::shared_ptr<stage::PlacedTargets> placed_ = std::make_shared<stage::PlacedTargets>();
};

/// One finding about a prim as a whole, or about what `part` names.
void report(Diagnostics& diagnostics, const stage::Prim& prim, Severity severity, const char* rule,
            const Message& message, std::string fix, StatementPart part = {});

/// An API that a prim applies; the name of an instance is part of it.
StatementPart api_part(std::string name);
/// The type that a prim is given.
StatementPart type_part();
/// One item of the list that is an attribute's value, or that value.
StatementPart value_part(std::string item = {});

}  // namespace tenon::physics
