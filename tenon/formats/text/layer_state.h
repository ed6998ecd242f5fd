// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/base/limits/fault_limits.h"
#include "tenon/base/limits/limits.h"
#include "tenon/formats/text/cursor.h"
#include "tenon/formats/text/fault_recovery.h"
#include "tenon/formats/text/known_metadata.h"
#include "tenon/formats/text/layout/source_map.h"
#include "tenon/formats/text/properties/known_attributes.h"
#include "tenon/layer/layer.h"

namespace tenon::formats::text {

/// What the readers of the parts of a layer share.
struct LayerState {
  Cursor cursor;
  layer::Layer layer;
  Diagnostics& diagnostics;
  std::size_t warnings = 0;
  std::vector<Token> spare_names{};     ///< empty, with room for the names of a block
  layer::TimeSamples samples_buffer{};  ///< kept between attributes to spare allocations
  KnownAttributes known_attributes{};
  KnownMetadata known_metadata{};
  std::size_t arcs = 0;  ///< statements of metadata that mean something else in another place
  SourceMap* sources = nullptr;             ///< filled where somebody wants to know
  Path open_block = Path::absolute_root();  ///< the innermost one, for errors
  std::vector<Error> faults{};              ///< behind which reading went on, to find more
  bool finds_all_faults = false;

  LayerState(std::string_view text, std::string identifier, Diagnostics& findings)
      : cursor(text, {}), layer(std::move(identifier)), diagnostics(findings) {
    cursor = Cursor(text, layer.identifier());
  }
  LayerState(const LayerState&) = delete;
  LayerState& operator=(const LayerState&) = delete;

  /// Lets `spec` share its fields with the last spec of that `name` when they are the same ones.
  void share_fields(Token name, layer::Spec& spec) {
    Shared& last = shared_[std::hash<Token>{}(name) >> 16 & (shared_.size() - 1)];
    if (last.name == name && are_equal(last.fields.items(), spec.fields())) {
      spec.set_field_list(last.fields);
      return;
    }
    last = {name, spec.field_list()};
  }

  /// A list of names, one with others that came lately and have the same first and last name.
  layer::Value shared_names(const std::vector<Token>& names) {
    const std::size_t key =
        std::hash<Token>{}(names.front()) + 31 * std::hash<Token>{}(names.back());
    layer::Value& last = names_[key >> 16 & (names_.size() - 1)];
    const auto* const known = last.get<std::vector<Token>>();
    if (known == nullptr || *known != names) {
      last = layer::Value(std::vector<Token>(names));
    }
    return last;
  }

  /// What an attribute says of itself, which many say alike.
  const layer::FieldList& attribute_fields(bool custom, Token type_name,
                                           layer::Variability variability) {
    const auto more = (custom ? 1u : 0u) | (variability == layer::Variability::Uniform ? 2u : 0u);
    Declared& last =
        declared_[(std::hash<Token>{}(type_name) >> 16u << 2u | more) & (declared_.size() - 1)];
    if (last.fields.id() == nullptr || last.type_name != type_name || last.custom != custom ||
        last.variability != variability) {
      layer::FieldList fields;
      fields.reserve(3);
      fields.append(layer::fields::custom, layer::Value(custom));
      fields.append(layer::fields::typeName, layer::Value(type_name));
      fields.append(layer::fields::variability, layer::Value(variability));
      last = {type_name, custom, variability, std::move(fields)};
    }
    return last.fields;
  }

  /// Adds a warning about the byte at `offset`.
  void warn(std::size_t offset, std::string_view rule, std::string message, std::string_view fix) {
    if (++warnings > limits::kLayerFindings) {
      return;
    }
    if (warnings == limits::kLayerFindings) {
      message += "; no more warnings about this file are given";
    }
    const SourcePlace place = cursor.place_of(offset);
    Diagnostic diagnostic;
    diagnostic.severity = Severity::Warning;
    diagnostic.rule = rule;
    diagnostic.message = std::move(message);
    diagnostic.file = layer.identifier();
    diagnostic.line = place.line;
    diagnostic.column = place.column;
    const SourcePlace end = cursor.place_of(end_of_fault(cursor.text(), offset));
    diagnostic.end_line = end.line;
    diagnostic.end_column = end.column;
    diagnostic.fix = fix;
    diagnostics.add(std::move(diagnostic));
  }

  /// Keeps the cursor's error and lets reading go on at `offset`. False where it may not.
  bool go_on_at(std::optional<std::size_t> offset) {
    if (!finds_all_faults || !offset || cursor.error_code() != ErrorCode::Parse ||
        faults.size() + 1 >= limits::kTextFaults) {
      return false;
    }
    keep_fault();
    cursor.seek(*offset);
    return true;
  }
  void keep_fault() {
    if (!open_block.is_absolute_root()) {
      cursor.set_prim(open_block.strip_variants().str());
    }
    faults.push_back(cursor.take_error());
    cursor.set_prim({});
  }

  /// The spec at `path`, made with its source place when absent.
  layer::Spec& make_spec(Path path, layer::SpecKind kind, std::size_t offset) {
    layer::Spec& spec = layer.create(path, kind);
    if (spec.line == 0) {
      const SourcePlace place = cursor.place_of(offset);
      spec.set_place(place.line, place.column);
    }
    return spec;
  }

 private:
  struct Shared {
    Token name;
    layer::FieldList fields;
  };

  struct Declared {
    Token type_name;
    bool custom = false;
    layer::Variability variability = layer::Variability::Varying;
    layer::FieldList fields;
  };

  /// Equal and small enough that comparing them costs next to nothing. The last field, which is
  /// often the value, is the one that differs.
  static bool are_equal(const layer::FieldRange& a, const layer::FieldRange& b) {
    constexpr std::size_t kSmall = 64;
    if (a.size() != b.size()) {
      return false;
    }
    for (std::size_t i = a.size(); i-- > 0;) {
      const layer::Field& ours = a[i];
      const layer::Field& theirs = b[i];
      const bool alike =
          &ours == &theirs ||
          (ours.name == theirs.name && theirs.value.size() <= kSmall && ours.value == theirs.value);
      if (!alike) {
        return false;
      }
    }
    return true;
  }

  std::array<Shared, 256> shared_{};
  std::array<Declared, 128> declared_{};
  std::array<layer::Value, 64> names_{};
};

}  // namespace tenon::formats::text
