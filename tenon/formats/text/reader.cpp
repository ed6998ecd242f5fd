// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/formats/text/reader.h"

#include <algorithm>
#include <atomic>

#include "tenon/base/parallel.h"
#include "tenon/formats/text/brackets/stray_brackets.h"
#include "tenon/formats/text/layer_reader.h"
#include "tenon/formats/text/split_text.h"

namespace tenon::formats {
namespace {

/// Advice about closing brackets that are too many, where that is what is wrong. What the reader
/// says at the one place where it stopped stays where it says the same.
Result<layer::Layer> with_bracket_advice(Result<layer::Layer> layer, std::string_view source) {
  if (layer || layer.error().code() != ErrorCode::Parse || !layer.error().further().empty()) {
    return layer;
  }
  const std::vector<std::size_t> stray = text::stray_brackets(source);
  if (stray.empty()) {
    return layer;
  }
  const Diagnostic& fault = layer.error().diagnostic();
  const auto line = static_cast<std::size_t>(
      std::count(source.begin(), source.begin() + static_cast<std::ptrdiff_t>(stray[0]), '\n') + 1);
  const bool is_said =
      stray.size() == 1 && ((fault.line == line && fault.fix.starts_with("remove ")) ||
                            fault.fix.ends_with("at line " + std::to_string(line)));
  if (is_said) {
    return layer;
  }
  return std::move(layer.error()).with_fix(text::removal_advice(source, stray));
}

Result<layer::Layer> read_whole(std::string_view source, std::string identifier,
                                Diagnostics& diagnostics, text::SourceMap* sources) {
  text::LayerReader reader(source, std::move(identifier), diagnostics, sources);
  reader.find_all_faults();
  reader.read_from_front();
  return with_bracket_advice(reader.finish(), source);
}

}  // namespace

Result<layer::Layer> read_text(std::string_view source, std::string identifier,
                               Diagnostics& diagnostics) {
  constexpr std::size_t kWorthHalving = std::size_t{1} << 18;  // bytes
  return source.size() >= kWorthHalving && usable_processors() > 1
             ? read_text_in_halves(source, std::move(identifier), diagnostics)
             : read_whole(source, std::move(identifier), diagnostics, nullptr);
}

Result<layer::Layer> read_text_in_halves(std::string_view source, std::string identifier,
                                         Diagnostics& diagnostics) {
  const std::size_t split = text::find_split(source);
  if (split == std::string_view::npos) {
    return read_whole(source, std::move(identifier), diagnostics, nullptr);
  }
  Diagnostics ignored;
  text::LayerReader second(source, identifier, ignored, nullptr);
  text::LayerReader first(source, std::move(identifier), diagnostics, nullptr);
  first.find_all_faults();
  std::atomic<bool> wanted = true;
  run_both([&] { second.read_from(split, wanted); },
           [&] {
             first.read_from_front(split);
             wanted = first.stopped();
           });
  if (first.stopped() && (first.has_faults() || !first.take_rest(second))) {
    first.read_statements();
  }
  return with_bracket_advice(first.finish(), source);
}

Result<layer::Layer> read_text_with_sources(std::string_view source, std::string identifier,
                                            Diagnostics& diagnostics, text::SourceMap& sources) {
  return read_whole(source, std::move(identifier), diagnostics, &sources);
}

}  // namespace tenon::formats
