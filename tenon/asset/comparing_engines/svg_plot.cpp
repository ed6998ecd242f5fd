// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A plot is lines in a box of fixed size, which the page scales. Of long curves one point is drawn
// for each part of the time, the one that a reader would miss most.
#include "tenon/asset/comparing_engines/svg_plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "tenon/base/text/rounded_text.h"

namespace tenon {
namespace {

constexpr double kWidth = 640;
constexpr double kHeight = 220;
constexpr double kLeft = 64;
constexpr double kRight = 12;
constexpr double kTop = 26;
constexpr double kBottom = 34;
constexpr std::size_t kMaxPoints = 600;
constexpr std::size_t kTicks = 4;
// Told apart by people with colour blindness as well (palette of Okabe and Ito).
constexpr std::array<const char*, 6> kColors = {"#0072b2", "#d55e00", "#009e73",
                                                "#cc79a7", "#e69f00", "#56b4e9"};

struct Range {
  double low = 0;
  double high = 1;
  bool empty = true;

  void take(double value) {
    if (std::isfinite(value)) {
      low = empty ? value : std::min(low, value);
      high = empty ? value : std::max(high, value);
      empty = false;
    }
  }
  /// Not of no width.
  void widen() {
    if (!(high > low)) {
      const double half = low == 0 ? 0.5 : std::abs(low) * 0.05;
      low -= half;
      high += half;
    }
  }
  double part(double value) const { return (value - low) / (high - low); }
};

/// Which points are drawn.
std::vector<std::size_t> drawn_points(const Curve& curve) {
  const std::size_t count = std::min(curve.x.size(), curve.y.size());
  const std::size_t stride = (count + kMaxPoints - 1) / kMaxPoints;
  std::vector<std::size_t> points;
  for (std::size_t begin = 0; begin < count; begin += std::max<std::size_t>(1, stride)) {
    const std::size_t end = std::min(count, begin + std::max<std::size_t>(1, stride));
    std::size_t best = begin;
    for (std::size_t i = begin; !points.empty() && i < end; ++i) {
      const double before = curve.y[points.back()];
      if (std::abs(curve.y[i] - before) > std::abs(curve.y[best] - before)) {
        best = i;
      }
    }
    if (std::isfinite(curve.y[best])) {
      points.push_back(best);
    }
  }
  return points;
}

std::string number(double value) { return rounded_text(std::round(value * 10) / 10, 6); }

double place_x(const Range& x, double value) {
  return kLeft + (kWidth - kLeft - kRight) * x.part(value);
}
double place_y(const Range& y, double value) {
  return kHeight - kBottom - (kHeight - kTop - kBottom) * y.part(value);
}

std::string label(double x, double y, const char* anchor, const std::string& text) {
  return "<text x=\"" + number(x) + "\" y=\"" + number(y) + "\" text-anchor=\"" + anchor + "\">" +
         html_text(text) + "</text>\n";
}

std::string axes(const Plot& plot, const Range& x, const Range& y) {
  std::string svg;
  for (std::size_t i = 0; i <= kTicks; ++i) {
    const double part = static_cast<double>(i) / kTicks;
    const double at_x = x.low + part * (x.high - x.low);
    const double at_y = y.low + part * (y.high - y.low);
    const std::string line_y = number(place_y(y, at_y));
    svg += "<line class=\"grid\" x1=\"" + number(kLeft) + "\" x2=\"" + number(kWidth - kRight) +
           "\" y1=\"" + line_y + "\" y2=\"" + line_y + "\"/>\n";
    svg += label(kLeft - 6, place_y(y, at_y) + 4, "end", rounded_text(at_y, 4));
    svg += label(place_x(x, at_x), kHeight - kBottom + 16, "middle", rounded_text(at_x, 4));
  }
  svg += label(kWidth - kRight, kHeight - 4, "end", "time [s]");
  const std::string unit = plot.y_label.empty() ? "" : " [" + plot.y_label + "]";
  return svg + label(kLeft, 16, "start", plot.title + unit);
}

std::string legend(const Plot& plot) {
  std::string svg;
  double x = kWidth - kRight;
  for (std::size_t i = plot.curves.size(); i-- > 0;) {
    const std::string& name = plot.curves[i].name;
    svg += "<text fill=\"" + std::string(kColors[i % kColors.size()]) + "\" x=\"" + number(x) +
           "\" y=\"16\" text-anchor=\"end\">" + html_text(name) + "</text>\n";
    x -= 8.0 * static_cast<double>(name.size()) + 14;
  }
  return svg;
}

}  // namespace

std::string svg_plot(const Plot& plot) {
  Range x;
  Range y;
  for (const Curve& curve : plot.curves) {
    for (const double value : curve.x) {
      x.take(value);
    }
    for (const double value : curve.y) {
      y.take(value);
    }
  }
  x.widen();
  y.widen();
  std::string svg = "<svg viewBox=\"0 0 " + number(kWidth) + " " + number(kHeight) +
                    "\" role=\"img\" aria-label=\"" + html_text(plot.title) + "\">\n" +
                    axes(plot, x, y) + legend(plot);
  for (std::size_t i = 0; i < plot.curves.size(); ++i) {
    const Curve& curve = plot.curves[i];
    std::string points;
    for (const std::size_t at : drawn_points(curve)) {
      points += (points.empty() ? "" : " ") + number(place_x(x, curve.x[at])) + "," +
                number(place_y(y, curve.y[at]));
    }
    svg += "<polyline stroke=\"" + std::string(kColors[i % kColors.size()]) + "\" points=\"" +
           points + "\"/>\n";
  }
  return svg + "</svg>\n";
}

std::string html_text(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      case '\'':
        escaped += "&#39;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

}  // namespace tenon
