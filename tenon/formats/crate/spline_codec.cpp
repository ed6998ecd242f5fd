// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// Two header bytes: form (bits 0 to 3), value type (4, 5), time-valued (6), curve (7); then the
// modes of extrapolation (0 to 2 before, 3 to 5 after) and whether there is an inner loop (6). Form
// 3 adds a byte that says which ends have a boundary, and the boundaries. Then the slopes of sloped
// ends, the loop, the number of knots, and the knots: flags (two values 0, interpolation 1 and 2,
// curve 3, tangents in another form 4 and 5), time, values, widths, slopes; from form 2 on a byte
// with the algorithms of the tangents (0 to 3 before, 4 to 7 after).
#include "tenon/formats/crate/spline_codec.h"

#include "tenon/bytes/byte_reader.h"
#include "tenon/bytes/byte_writer.h"
#include "tenon/layer/time/spline_rules.h"

namespace tenon::formats::crate {
namespace {

using layer::Spline;
using layer::SplineExtrapolation;
using layer::SplineKnot;
using layer::ValueType;

constexpr unsigned kNewestForm = 3;

Result<double> read_number(bytes::ByteReader& in, ValueType type) {
  if (type == ValueType::Half) {
    TENON_TRY(const Half half, in.read<Half>());
    return static_cast<double>(half);
  }
  if (type == ValueType::Float) {
    TENON_TRY(const float number, in.read<float>());
    return static_cast<double>(number);
  }
  return in.read<double>();
}

Result<layer::SplineEnd> read_end(unsigned mode) {
  if (mode > static_cast<unsigned>(SplineExtrapolation::LoopOscillate)) {
    return corrupt("a spline extrapolates in an unknown way");
  }
  layer::SplineEnd end;
  end.mode = static_cast<SplineExtrapolation>(mode);
  return end;
}

Result<void> read_slope(bytes::ByteReader& in, layer::SplineEnd& end) {
  if (end.mode == SplineExtrapolation::Sloped) {
    TENON_TRY(end.slope, in.read<double>());
  }
  return {};
}

Result<void> read_boundaries(bytes::ByteReader& in, Spline& spline) {
  TENON_TRY(const std::uint8_t ends, in.read<std::uint8_t>());
  if ((ends & 1u) != 0) {
    TENON_TRY(spline.pre.boundary, in.read<double>());
  }
  if ((ends & 2u) != 0) {
    TENON_TRY(spline.post.boundary, in.read<double>());
  }
  return {};
}

Result<layer::SplineLoop> read_loop(bytes::ByteReader& in) {
  layer::SplineLoop loop;
  TENON_TRY(loop.start, in.read<double>());
  TENON_TRY(loop.end, in.read<double>());
  TENON_TRY(loop.pre_loops, in.read<std::int32_t>());
  TENON_TRY(loop.post_loops, in.read<std::int32_t>());
  TENON_TRY(loop.value_offset, in.read<double>());
  return loop;
}

Result<layer::TangentAlgorithm> algorithm(unsigned number) {
  if (number > static_cast<unsigned>(layer::TangentAlgorithm::AutoEase)) {
    return corrupt("a tangent is made in an unknown way");
  }
  return static_cast<layer::TangentAlgorithm>(number);
}

Result<SplineKnot> read_knot(bytes::ByteReader& in, const Spline& spline, unsigned form) {
  SplineKnot knot;
  TENON_TRY(const std::uint8_t flags, in.read<std::uint8_t>());
  knot.next = static_cast<layer::SplineInterpolation>(flags >> 1 & 3u);
  TENON_TRY(knot.time, in.read<double>());
  TENON_TRY(knot.value, read_number(in, spline.value_type));
  if ((flags & 1u) != 0) {
    TENON_TRY(knot.pre_value, read_number(in, spline.value_type));
  }
  if (spline.curve != layer::SplineCurve::Hermite) {
    TENON_TRY(knot.pre_tangent.width, in.read<double>());
    TENON_TRY(knot.post_tangent.width, in.read<double>());
  }
  TENON_TRY(knot.pre_tangent.slope, read_number(in, spline.value_type));
  TENON_TRY(knot.post_tangent.slope, read_number(in, spline.value_type));
  if (form >= 2) {
    TENON_TRY(const std::uint8_t algorithms, in.read<std::uint8_t>());
    TENON_TRY(knot.pre_tangent.algorithm, algorithm(algorithms & 0xfu));
    TENON_TRY(knot.post_tangent.algorithm, algorithm(algorithms >> 4));
  }
  return knot;
}

}  // namespace

Result<Spline> decode_spline(std::span<const std::byte> bytes) {
  Spline spline;
  if (bytes.empty()) {
    return spline;
  }
  bytes::ByteReader in(bytes);
  TENON_TRY(const std::uint8_t first, in.read<std::uint8_t>());
  TENON_TRY(const std::uint8_t second, in.read<std::uint8_t>());
  const unsigned form = first & 0xfu;
  if (form < 1 || form > kNewestForm) {
    return Error(ErrorCode::Unsupported,
                 "splines of form " + std::to_string(form) + " cannot be read")
        .with_rule("crate.value-unsupported");
  }
  constexpr ValueType kTypes[] = {ValueType::Double, ValueType::Double, ValueType::Float,
                                  ValueType::Half};
  spline.value_type = kTypes[first >> 4 & 3u];
  spline.time_valued = (first & 0x40u) != 0;
  if (form >= 3 && spline.time_valued) {
    spline.value_type = ValueType::TimeCode;
  }
  spline.curve = static_cast<layer::SplineCurve>(first >> 7);
  TENON_TRY(spline.pre, read_end(second & 7u));
  TENON_TRY(spline.post, read_end(second >> 3 & 7u));
  if (form >= 3) {
    TENON_CHECK(read_boundaries(in, spline));
  }
  TENON_CHECK(read_slope(in, spline.pre));
  TENON_CHECK(read_slope(in, spline.post));
  if ((second & 0x40u) != 0) {
    TENON_TRY(spline.loop, read_loop(in));
  }
  TENON_TRY(const std::uint32_t count, in.read<std::uint32_t>());
  for (std::uint32_t i = 0; i < count; ++i) {
    TENON_TRY(SplineKnot knot, read_knot(in, spline, form));
    if (const char* fault = layer::fault_of(knot)) {
      return corrupt(fault);
    }
    spline.knots.push_back(std::move(knot));
  }
  layer::shorten_tangents(spline);
  return spline;
}

namespace {

void write_number(bytes::ByteWriter& out, double number, ValueType type) {
  if (type == ValueType::Half) {
    out.write(Half(number).bits);
  } else if (type == ValueType::Float) {
    out.write(static_cast<float>(number));
  } else {
    out.write(number);
  }
}

unsigned form_of(const Spline& spline) {
  if (spline.pre.boundary || spline.post.boundary || spline.value_type == ValueType::TimeCode) {
    return 3;
  }
  for (const SplineKnot& knot : spline.knots) {
    if (knot.pre_tangent.algorithm != layer::TangentAlgorithm::None ||
        knot.post_tangent.algorithm != layer::TangentAlgorithm::None) {
      return 2;
    }
  }
  return 1;
}

void write_header(bytes::ByteWriter& out, const Spline& spline, unsigned form) {
  const unsigned type = spline.value_type == ValueType::Double  ? 1
                        : spline.value_type == ValueType::Float ? 2
                        : spline.value_type == ValueType::Half  ? 3
                                                                : 0;
  const bool timed = spline.time_valued || spline.value_type == ValueType::TimeCode;
  out.write(static_cast<std::uint8_t>(form | type << 4 | (timed ? 0x40u : 0u) |
                                      static_cast<unsigned>(spline.curve) << 7));
  out.write(static_cast<std::uint8_t>(static_cast<unsigned>(spline.pre.mode) |
                                      static_cast<unsigned>(spline.post.mode) << 3 |
                                      (spline.loop ? 0x40u : 0u)));
  if (form >= 3) {
    out.write(static_cast<std::uint8_t>((spline.pre.boundary ? 1u : 0u) |
                                        (spline.post.boundary ? 2u : 0u)));
    for (const layer::SplineEnd* end : {&spline.pre, &spline.post}) {
      if (end->boundary) {
        out.write(*end->boundary);
      }
    }
  }
  for (const layer::SplineEnd* end : {&spline.pre, &spline.post}) {
    if (end->mode == SplineExtrapolation::Sloped) {
      out.write(end->slope);
    }
  }
  if (spline.loop) {
    out.write(spline.loop->start);
    out.write(spline.loop->end);
    out.write(spline.loop->pre_loops);
    out.write(spline.loop->post_loops);
    out.write(spline.loop->value_offset);
  }
}

void write_knot(bytes::ByteWriter& out, const SplineKnot& knot, const Spline& spline,
                unsigned form) {
  out.write(static_cast<std::uint8_t>((knot.pre_value ? 1u : 0u) |
                                      static_cast<unsigned>(knot.next) << 1 |
                                      static_cast<unsigned>(spline.curve) << 3));
  out.write(knot.time);
  write_number(out, knot.value, spline.value_type);
  if (knot.pre_value) {
    write_number(out, *knot.pre_value, spline.value_type);
  }
  if (spline.curve != layer::SplineCurve::Hermite) {
    out.write(knot.pre_tangent.width);
    out.write(knot.post_tangent.width);
  }
  write_number(out, knot.pre_tangent.slope, spline.value_type);
  write_number(out, knot.post_tangent.slope, spline.value_type);
  if (form >= 2) {
    out.write(static_cast<std::uint8_t>(static_cast<unsigned>(knot.pre_tangent.algorithm) |
                                        static_cast<unsigned>(knot.post_tangent.algorithm) << 4));
  }
}

}  // namespace

EncodedSpline encode_spline(const Spline& spline) {
  const unsigned form = form_of(spline);
  bytes::ByteWriter out;
  write_header(out, spline, form);
  out.write(static_cast<std::uint32_t>(spline.knots.size()));
  for (const SplineKnot& knot : spline.knots) {
    write_knot(out, knot, spline, form);
  }
  constexpr Version kNeeded[] = {kSplines, kSplines, kTangentAlgorithms, kLoopBoundaries};
  return {out.take(), kNeeded[form]};
}

}  // namespace tenon::formats::crate
