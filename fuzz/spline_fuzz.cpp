// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0

// A spline and time samples made of the input's numbers are evaluated at times of the input: each
// time gives the same value again, samples give a value, and the spline survives text and crate.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "fuzz/taken_bytes.h"
#include "tenon/formats/crate/reader.h"
#include "tenon/formats/crate/writer.h"
#include "tenon/formats/text/reader.h"
#include "tenon/formats/text/write/writer.h"
#include "tenon/layer/field_values.h"
#include "tenon/stage/interpolate.h"
#include "tenon/stage/values/evaluate_spline.h"

namespace {

using tenon::fuzz::TakenBytes;
using tenon::layer::Spline;
using tenon::layer::Value;

void check(bool holds) {
  if (!holds) {
    std::abort();
  }
}

// Small numbers mostly, any bits at times; never NaN, which no reader takes for a time.
double take_number(TakenBytes& input) {
  const auto kind = input.take<std::uint8_t>();
  const double number = kind < 192 ? input.take<std::int16_t>() / 64.0 : input.take<double>();
  return std::isnan(number) ? 0 : number;
}

double take_finite(TakenBytes& input) {
  const double number = take_number(input);
  return std::isfinite(number) ? number : 1;
}

tenon::layer::SplineEnd take_end(TakenBytes& input) {
  tenon::layer::SplineEnd end;
  end.mode = static_cast<tenon::layer::SplineExtrapolation>(input.below(7));
  if (end.mode == tenon::layer::SplineExtrapolation::Sloped) {
    end.slope = take_finite(input);
  }
  return end;
}

tenon::layer::SplineKnot take_knot(TakenBytes& input) {
  tenon::layer::SplineKnot knot;
  const auto bits = input.take<std::uint8_t>();
  knot.time = take_finite(input);
  knot.value = take_finite(input);
  if ((bits & 1) != 0) {
    knot.pre_value = take_finite(input);
  }
  knot.next = static_cast<tenon::layer::SplineInterpolation>(bits >> 1 & 3);
  if ((bits & 8) != 0) {
    knot.pre_tangent = {std::abs(take_finite(input)), take_finite(input), {}};
    knot.post_tangent = {std::abs(take_finite(input)), take_finite(input), {}};
  }
  return knot;
}

Spline take_spline(TakenBytes& input) {
  Spline spline;
  const auto bits = input.take<std::uint8_t>();
  spline.curve =
      (bits & 1) != 0 ? tenon::layer::SplineCurve::Hermite : tenon::layer::SplineCurve::Bezier;
  spline.pre = take_end(input);
  spline.post = take_end(input);
  if ((bits & 2) != 0) {
    const double start = take_finite(input);
    spline.loop = {start, start + std::abs(take_finite(input)), input.take<std::int32_t>(),
                   input.take<std::int32_t>(), take_finite(input)};
  }
  for (unsigned left = input.below(12); left > 0; --left) {
    spline.knots.push_back(take_knot(input));
  }
  std::stable_sort(spline.knots.begin(), spline.knots.end(),
                   [](const auto& a, const auto& b) { return a.time < b.time; });
  const auto same = [](const auto& a, const auto& b) { return a.time == b.time; };
  spline.knots.erase(std::unique(spline.knots.begin(), spline.knots.end(), same),
                     spline.knots.end());
  return spline;
}

bool same(const Value& a, const Value& b) {
  const auto* x = a.get<double>();
  const auto* y = b.get<double>();
  return a.empty()
             ? b.empty()
             : x != nullptr && y != nullptr && (*x == *y || (std::isnan(*x) && std::isnan(*y)));
}

/// Reading shortens tangents that would turn the curve back in time, as OpenUSD does, so the text
/// may differ.
tenon::layer::Layer through_crate(const tenon::layer::Layer& layer) {
  tenon::Diagnostics diagnostics;
  const auto crate = tenon::formats::write_crate(layer);
  if (!crate) {
    std::fprintf(stderr, "%s\n", crate.error().to_string().c_str());
  }
  check(crate.has_value());
  auto read =
      tenon::formats::read_crate(tenon::bytes::FileBytes::own(*crate), "spline.usdc", diagnostics);
  if (!read) {
    std::fprintf(stderr, "%s\n", read.error().to_string().c_str());
  }
  check(read.has_value());
  return *std::move(read);
}

void check_stored(const Spline& spline) {
  tenon::layer::Layer layer("spline");
  const tenon::Path prim = tenon::Path::absolute_root().child(tenon::Token("P"));
  layer.root().set(tenon::Token("primChildren"), std::vector<tenon::Token>{tenon::Token("P")});
  tenon::layer::Spec& spec = layer.create(prim, tenon::layer::SpecKind::Prim);
  spec.set(tenon::Token("specifier"), tenon::layer::Specifier::Def);
  spec.set(tenon::Token("properties"), std::vector<tenon::Token>{tenon::Token("a")});
  tenon::layer::Spec& attribute =
      layer.create(prim.property(tenon::Token("a")), tenon::layer::SpecKind::Attribute);
  attribute.set(tenon::Token("typeName"), tenon::Token("double"));
  attribute.set(tenon::Token("spline"), spline);
  const std::string text = tenon::formats::write_text(layer);
  tenon::Diagnostics diagnostics;
  through_crate(through_crate(layer));
  const auto from_text = tenon::formats::read_text(text, "spline.usda", diagnostics);
  check(from_text.has_value());  // counts of loops below zero are zero now, as OpenUSD has it
  const std::string written = tenon::formats::write_text(*from_text);
  const auto again = tenon::formats::read_text(written, "spline.usda", diagnostics);
  check(again && tenon::formats::write_text(*again) == written);
}

void check_samples(TakenBytes& input) {
  tenon::layer::TimeSamples samples;
  for (unsigned left = input.below(8) + 1; left > 0; --left) {
    samples.set(take_number(input), Value(take_number(input)));
  }
  for (int i = 0; i < 4; ++i) {
    check(!tenon::stage::value_at(samples, take_number(input)).empty());
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  TakenBytes input(data, size);
  check_samples(input);
  const Spline spline = take_spline(input);
  check_stored(spline);
  for (int i = 0; i < 8; ++i) {
    const double time = take_number(input);
    check(same(tenon::stage::evaluate_spline(spline, time),
               tenon::stage::evaluate_spline(spline, time)));
  }
  for (const auto& knot : spline.knots) {
    tenon::stage::evaluate_spline(spline, knot.time);
  }
  return 0;
}
