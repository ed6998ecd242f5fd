// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

/// Small plots as SVG, to be embedded in a page.
namespace tenon {

struct Curve {
  std::string name;
  std::vector<double> x;  // (point_count), ascending
  std::vector<double> y;  // (point_count)
};

struct Plot {
  std::string title;
  std::string y_label;
  std::vector<Curve> curves;
};

/// Time in seconds to the right; at most 600 points a curve are drawn, each the one of its part of
/// the time that lies farthest from the one before. Points that are not finite are skipped.
std::string svg_plot(const Plot& plot);

/// `text` with the five characters of markup escaped.
std::string html_text(std::string_view text);

}  // namespace tenon
