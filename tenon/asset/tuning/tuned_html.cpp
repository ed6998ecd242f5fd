// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The page has its style in itself and no script. Of each joint it has one plot of positions with
// the command, one of velocities and one of efforts with their bounds; all engines are in one plot.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "tenon/asset/comparing_engines/svg_plot.h"
#include "tenon/asset/tuning/tuned_json.h"
#include "tenon/base/text/rounded_text.h"
#include "tenon/math/angle.h"

namespace tenon {
namespace {

constexpr const char* kTunePageStyle =
    "body{font:15px/1.5 system-ui,sans-serif;max-width:70rem;margin:2rem auto;padding:0 1rem;"
    "color:#222;background:#fff}table{border-collapse:collapse;margin:.5rem 0 1.5rem}"
    "th,td{padding:.2rem .8rem .2rem 0;text-align:left;border-bottom:1px solid #ddd;"
    "vertical-align:top}td.n{text-align:right;font-variant-numeric:tabular-nums}"
    ".pass{color:#00795a}.fail,.blocked,.unstable{color:#c03000}"
    "code{font-size:.9em}svg{width:100%;height:auto;margin:.5rem 0}"
    "svg text{font:12px system-ui,sans-serif}svg{fill:currentColor}"
    "polyline{fill:none;stroke-width:1.6}.grid{stroke:#ddd;stroke-width:1}"
    "@media(prefers-color-scheme:dark){body{color:#ddd;background:#181818}"
    "th,td{border-color:#444}.grid{stroke:#444}}";

std::string tune_cell(const std::string& text) { return "<td>" + html_text(text) + "</td>"; }
std::string tune_figure(double value) {
  return "<td class=\"n\">" + html_text(std::isfinite(value) ? rounded_text(value, 5) : "-") +
         "</td>";
}

std::string drives_table(const TunedAsset& tuned) {
  std::string html =
      "<table><tr><th>joint</th><th>drive</th><th>stiffness</th><th>damping</th><th>inertia</th>"
      "<th>frequency [Hz]</th><th>damping ratio</th><th>note</th></tr>\n";
  for (const TunedDrive& drive : tuned.drives) {
    const tuning::DriveRow& row = drive.to ? *drive.to : drive.row;
    if (!drive.asked || !row.drive) {
      continue;
    }
    std::string notes = row.why_not;
    for (const std::string& note : drive.notes) {
      notes += (notes.empty() ? "" : "; ") + note;
    }
    html += "<tr><td><code>" + html_text(drive.joint.str()) + "</code></td>" +
            tune_cell(row.load.acceleration ? "acceleration" : "force") +
            tune_figure(row.gains.stiffness) + tune_figure(row.gains.damping) +
            tune_figure(row.coordinate ? row.load.inertia : kNotANumber) +
            tune_figure(row.response ? row.response->frequency / (2 * kPi) : kNotANumber) +
            tune_figure(row.response ? row.response->ratio : kNotANumber) + tune_cell(notes) +
            "</tr>\n";
  }
  return html + "</table>\n";
}

std::string results_table(const TunedEngine& engine) {
  std::string html =
      "<table><tr><th>joint</th><th>verdict</th><th>at maxForce [%]</th>"
      "<th>why, and what to look at</th></tr>\n";
  for (const tuning::DriveTestResult& result : engine.tests->results) {
    std::string reasons;
    for (const std::string& reason : result.reasons) {
      reasons += (reasons.empty() ? "" : "; ") + reason;
    }
    const std::string verdict(verdict_name(result.verdict));
    html += "<tr><td><code>" +
            html_text(engine.scene->joints[engine.rows[result.row].joint].path.str()) +
            "</code></td><td class=\"" + verdict + "\">" + verdict + "</td>" +
            tune_figure(100 * result.saturation) + tune_cell(reasons) + "</tr>\n";
  }
  return html + "</table>\n";
}

/// The results of one joint on all engines.
struct JointResults {
  Path joint;
  scene::Dof dof = scene::Dof::RotX;
  std::vector<std::pair<const TunedEngine*, const tuning::DriveTestResult*>> engines;
};

std::vector<JointResults> results_by_joint(const TunedAsset& tuned) {
  std::vector<JointResults> joints;
  for (const TunedEngine& engine : tuned.engines) {
    for (const tuning::DriveTestResult& result : engine.tests->results) {
      if (result.signal.size() == 0) {
        continue;
      }
      const tuning::DriveRow& row = engine.rows[result.row];
      const Path& joint = engine.scene->joints[row.joint].path;
      auto found = std::find_if(joints.begin(), joints.end(), [&](const JointResults& one) {
        return one.joint == joint && one.dof == row.dof;
      });
      if (found == joints.end()) {
        joints.push_back({joint, row.dof, {}});
        found = joints.end() - 1;
      }
      found->engines.emplace_back(&engine, &result);
    }
  }
  return joints;
}

/// Lines at both bounds, where there are any.
void add_bounds(const std::vector<double>& time, double most, Plot& plot) {
  if (std::isfinite(most) && !time.empty()) {
    plot.curves.push_back({"bound", {time.front(), time.back()}, {most, most}});
    plot.curves.push_back({"-bound", {time.front(), time.back()}, {-most, -most}});
  }
}

std::string joint_plots(const JointResults& of) {
  const bool angular = is_angular(of.dof);
  const double shown = angular ? kDegreesPerRadian : 1;
  const auto scaled = [&](std::vector<double> values) {
    for (double& value : values) {
      value *= shown;
    }
    return values;
  };
  Plot position{"position", angular ? "degrees" : "m", {}};
  Plot velocity{"velocity", angular ? "degrees/s" : "m/s", {}};
  Plot effort{"effort", angular ? "N m" : "N", {}};
  for (const auto& [engine, result] : of.engines) {
    const tuning::Signal& signal = result->signal;
    const tuning::DriveRow& row = engine->rows[result->row];
    const scene::Joint& joint = engine->scene->joints[row.joint];
    if (position.curves.empty()) {
      position.curves.push_back({"command", signal.time, scaled(signal.command)});
      add_bounds(signal.time, joint.velocity_limit * shown, velocity);
      add_bounds(signal.time, joint.drives[*row.drive].max_force, effort);
    }
    position.curves.push_back({engine->engine, signal.time, scaled(signal.position)});
    velocity.curves.push_back({engine->engine, signal.time, scaled(signal.velocity)});
    if (!signal.effort.empty()) {
      effort.curves.push_back({engine->engine, signal.time, signal.effort});
    }
  }
  return "<h3><code>" + html_text(of.joint.str()) + "</code></h3>\n" + svg_plot(position) +
         svg_plot(velocity) + (effort.curves.empty() ? "" : svg_plot(effort));
}

std::string tests_part(const TunedAsset& tuned) {
  std::string html;
  for (const TunedEngine& engine : tuned.engines) {
    if (!engine.tests) {
      return html;
    }
    html += "<h2>" +
            html_text(std::string(test_name(engine.tests->kind)) + " on " + engine.engine + " " +
                      engine.version + ", steps of " +
                      rounded_text(engine.tests->time_step * 1e3, 4) + " ms") +
            "</h2>\n" + results_table(engine);
  }
  for (const JointResults& joint : results_by_joint(tuned)) {
    html += joint_plots(joint);
  }
  return html;
}

}  // namespace

std::string tuned_html(const std::string& asset, const TunedAsset& tuned) {
  // The page holds no script and asks for nothing.
  return "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
         "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; "
         "style-src 'unsafe-inline'\">"
         "<meta name=\"viewport\" content=\"width=device-width\"><title>" +
         html_text(asset) + "</title><style>" + kTunePageStyle + "</style></head><body>\n<h1>" +
         html_text(asset) + "</h1>\n<p>Gains in SI, per radian.</p>\n" + drives_table(tuned) +
         tests_part(tuned) + "</body></html>\n";
}

}  // namespace tenon
