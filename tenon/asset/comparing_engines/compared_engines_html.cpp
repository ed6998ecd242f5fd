// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The page has its style in itself and no script. A metric of bodies or joints is plotted for the
// object with the largest gap; one of several numbers by its number that differs most, an
// orientation by the angle from where it begins.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>

#include "tenon/asset/comparing_engines/compared_engines_json.h"
#include "tenon/asset/comparing_engines/svg_plot.h"
#include "tenon/base/text/rounded_text.h"
#include "tenon/math/quaternion.h"

namespace tenon {
namespace {

using motions::Metric;
using Frames = std::vector<std::vector<double>>;

constexpr const char* kStyle =
    "body{font:15px/1.5 system-ui,sans-serif;max-width:60rem;margin:2rem auto;padding:0 1rem;"
    "color:#222;background:#fff}table{border-collapse:collapse;margin:.5rem 0 1.5rem}"
    "th,td{padding:.2rem .8rem .2rem 0;text-align:left;border-bottom:1px solid #ddd;"
    "vertical-align:top}td.n{text-align:right;font-variant-numeric:tabular-nums}"
    "code{font-size:.9em}svg{width:100%;height:auto;margin:.5rem 0}"
    "svg text{font:12px system-ui,sans-serif}svg{fill:currentColor}"
    "polyline{fill:none;stroke-width:1.6}.grid{stroke:#ddd;stroke-width:1}"
    "@media(prefers-color-scheme:dark){body{color:#ddd;background:#181818}"
    "th,td{border-color:#444}.grid{stroke:#444}}";

std::string data(const std::string& text) { return "<td>" + html_text(text) + "</td>"; }
std::string figure(double value, int digits = 5) {
  return "<td class=\"n\">" + html_text(rounded_text(value, digits)) + "</td>";
}
std::string heads(std::initializer_list<const char*> names) {
  std::string row = "<tr>";
  for (const char* name : names) {
    row += "<th>" + html_text(name) + "</th>";
  }
  return row + "</tr>\n";
}

std::string engines_table(const ComparedEngines& compared, bool timing) {
  std::string html =
      "<table>" + heads({"", "version", "variant", "step [ms]", "energy [J]", "contacts (mean)",
                         "deepest [mm]", "not mapped", timing ? "time per step [us]" : "ended"});
  for (const ComparedEngine& one : compared.engines) {
    const motions::Figures figures = motions::figures_of(one.setup, one.motion);
    const bake::Run& run = one.motion.run;
    html +=
        "<tr>" + data(one.setup.name) + data(one.version) +
        data(one.variant.empty() ? "-" : one.variant) + figure(one.motion.time_step * 1e3) +
        data(rounded_text(figures.energy_start, 5) + " -> " + rounded_text(figures.energy_end, 5)) +
        figure(figures.mean_contacts, 3) + figure(figures.deepest * 1e3, 3) +
        figure(static_cast<double>(one.motion.not_mapped.size())) +
        (timing ? figure(one.motion.wall_seconds * 1e6 /
                             static_cast<double>(std::max<std::size_t>(1, run.steps)),
                         3)
                : data(run.failure ? "failed at " + rounded_text(run.time) + " s" : "well")) +
        "</tr>\n";
  }
  return html + "</table>\n";
}

std::string gaps_table(const EnginePair& pair) {
  std::string html = "<table>" + heads({"largest gap", "", "at [s]", "in the mean", "of"});
  for (const motions::Gap& gap : pair.gaps) {
    const motions::MetricInfo& info = motions::info_of(gap.metric);
    const std::string unit = info.unit.empty() ? "" : " " + std::string(info.unit);
    html += "<tr>" + data(std::string(info.name)) + "<td class=\"n\">" +
            html_text(rounded_text(gap.largest * info.shown_per_si, 4) + unit) + "</td>" +
            figure(gap.time, 4) + "<td class=\"n\">" +
            html_text(rounded_text(gap.mean * info.shown_per_si, 4) + unit) + "</td><td><code>" +
            html_text(gap.object.str()) + "</code></td></tr>\n";
  }
  return html + "</table>\n";
}

std::string objects_text(const motions::Reason& reason) {
  if (reason.objects.empty()) {
    return "";
  }
  const std::size_t more = reason.objects.size() - 1;
  return reason.objects.front().str() + (more > 0 ? " and " + std::to_string(more) + " more" : "");
}

std::string reasons_table(const motions::Explanation& told) {
  if (told.reasons.empty()) {
    return "<p>No single setting explains more than 5 % of the gap.</p>\n";
  }
  std::string html = "<table>" + heads({"share", "because", "property", "of"});
  for (const motions::Reason& reason : told.reasons) {
    const std::string engine = reason.engine.empty() ? "" : reason.engine + ": ";
    html += "<tr><td class=\"n\">" +
            (reason.share ? html_text(rounded_text(*reason.share * 100, 3)) + " %"
                          : std::string("not measured")) +
            "</td>" + data(engine + reason.what) + "<td><code>" + html_text(reason.property) +
            "</code></td><td><code>" + html_text(objects_text(reason)) + "</code></td></tr>\n";
  }
  html += "</table>\n";
  if (told.together) {
    html += "<p>These causes explain " + html_text(rounded_text(*told.together * 100, 4)) +
            " % of the gap.</p>\n";
  }
  return html;
}

/// Turns orientations into the angle from the first of them.
Frames as_angles(const Frames& frames) {
  Frames angles;
  for (const auto& q : frames) {
    const auto& first = frames.front();
    const Quatd turn =
        conjugate(Quatd{first[0], first[1], first[2], first[3]}) * Quatd{q[0], q[1], q[2], q[3]};
    angles.push_back({length(rotation_vector(turn))});
  }
  return angles;
}

/// Which number of the gap's values differs most.
std::size_t number_of(const motions::Gap& gap) {
  std::size_t most = 0;
  for (std::size_t i = 0; i < std::min(gap.first.size(), gap.second.size()); ++i) {
    if (std::abs(gap.first[i] - gap.second[i]) > std::abs(gap.first[most] - gap.second[most])) {
      most = i;
    }
  }
  return gap.metric == Metric::Orientation ? 0 : most;
}

std::string plot_of(const ComparedEngines& compared, const motions::Gap& gap) {
  const motions::MetricInfo& info = motions::info_of(gap.metric);
  const std::size_t number = number_of(gap);
  const bool many = gap.first.size() > 1 && gap.metric != Metric::Orientation;
  Plot plot{std::string(info.name) + (many ? " " + std::to_string(number + 1) : "") +
                (gap.object.empty() ? "" : " of " + gap.object.str()),
            std::string(info.unit),
            {}};
  for (const ComparedEngine& one : compared.engines) {
    Frames frames = motions::series_of(one.setup, one.motion, gap.metric, gap.object);
    if (gap.metric == Metric::Orientation && !frames.empty()) {
      frames = as_angles(frames);
    }
    Curve curve{one.setup.name, one.motion.run.recording.times, {}};
    for (const auto& frame : frames) {
      curve.y.push_back(number < frame.size() ? frame[number] * info.shown_per_si : 0);
    }
    plot.curves.push_back(std::move(curve));
  }
  return svg_plot(plot);
}

}  // namespace

std::string compared_engines_part(const ComparedEngines& compared, bool timing) {
  std::string html = "<p>" + html_text(rounded_text(compared.duration)) +
                     " s on each engine.</p>\n" + engines_table(compared, timing);
  std::set<std::pair<Metric, Path>> plotted;
  for (const EnginePair& pair : compared.pairs) {
    html += "<h2>" + html_text(compared.engines.front().setup.name) + " and " +
            html_text(compared.engines[pair.second].setup.name) + "</h2>\n" + gaps_table(pair);
    if (pair.explanation && pair.explanation->distance > motions::kNoDistance) {
      html += "<h3>They differ because</h3>\n" + reasons_table(*pair.explanation);
    }
    for (const motions::Gap& gap : pair.gaps) {
      if (plotted.insert({gap.metric, gap.object}).second) {
        html += plot_of(compared, gap);
      }
    }
  }
  return html;
}

std::string compared_engines_html(const std::string& asset, const ComparedEngines& compared,
                                  bool timing) {
  // The page holds no script and asks for nothing.
  return "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
         "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; "
         "style-src 'unsafe-inline'\">"
         "<meta name=\"viewport\" content=\"width=device-width\"><title>" +
         html_text(asset) + "</title><style>" + kStyle + "</style></head><body>\n<h1>" +
         html_text(asset) + "</h1>\n" + compared_engines_part(compared, timing) +
         "</body></html>\n";
}

}  // namespace tenon
