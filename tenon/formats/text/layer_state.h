// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/base/diagnostics.h"
#include "tenon/formats/text/cursor.h"
#include "tenon/formats/text/source_map.h"
#include "tenon/layer/layer.h"

namespace tenon::formats::text {

/// What the readers of the parts of a layer share.
struct LayerState {
  Cursor cursor;
  layer::Layer layer;
  Diagnostics& diagnostics;
  layer::TimeSamples samples_buffer{};  ///< kept between attributes to spare allocations
  SourceMap* sources = nullptr;         ///< filled where somebody wants to know

  LayerState(std::string_view text, std::string identifier, Diagnostics& findings)
      : cursor(text, {}), layer(std::move(identifier)), diagnostics(findings) {
    cursor = Cursor(text, layer.identifier());
  }
  LayerState(const LayerState&) = delete;
  LayerState& operator=(const LayerState&) = delete;

  /// Adds a warning about the byte at `offset`.
  void warn(std::size_t offset, std::string_view rule, std::string message, std::string_view fix) {
    const SourcePlace place = cursor.place_of(offset);
    Diagnostic diagnostic;
    diagnostic.severity = Severity::Warning;
    diagnostic.rule = rule;
    diagnostic.message = std::move(message);
    diagnostic.file = layer.identifier();
    diagnostic.line = place.line;
    diagnostic.column = place.column;
    diagnostic.fix = fix;
    diagnostics.add(std::move(diagnostic));
  }

  /// The spec at `path`, made with its source place when absent.
  layer::Spec& make_spec(Path path, layer::SpecKind kind, std::size_t offset) {
    layer::Spec& spec = layer.create(path, kind);
    if (spec.line == 0) {
      const SourcePlace place = cursor.place_of(offset);
      spec.line = place.line;
      spec.column = place.column;
    }
    return spec;
  }
};

}  // namespace tenon::formats::text
