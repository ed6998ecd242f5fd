// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "page_functions.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "answer_of.h"
#include "options.h"
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "tenon/asset/viewing/report_asset.h"

namespace tenon::python {
namespace {

using namespace nb::literals;

nb::object report(const std::filesystem::path& path, const OpenArguments& arguments,
                  const std::string& engine, const std::vector<std::string>& pose,
                  std::optional<double> duration, double time_step, double frames_per_second,
                  std::size_t triangles, bool colliders) {
  ReportOptions options;
  options.run.open = open_options_of(arguments);
  options.run.readings = readings_of(arguments);
  options.run.pose = pose;
  options.run.engine = engine;
  options.run.duration = duration;
  options.run.time_step = time_step;
  options.run.frames_per_second = frames_per_second;
  options.triangles = triangles;
  options.colliders = colliders;
  return answer_of([path = path.string(), options](Job& job) mutable -> Result<Json> {
    options.run.listener.go_on = [&job](double /*seconds*/, double /*duration*/) {
      return job.go_on();
    };
    TENON_TRY(AssetReport made, report_asset(path, options, job.found));
    return Json{{"html", std::move(made.html)},
                {"triangles", made.triangles},
                {"frames", made.frames},
                {"findings", made.findings}};
  });
}

}  // namespace

void bind_page_functions(nb::module_& module) {
  module.def("report", &report, "path"_a, "arguments"_a, "engine"_a, "pose"_a, "duration"_a.none(),
             "time_step"_a, "frames_per_second"_a, "triangles"_a, "colliders"_a,
             nb::sig("def report(path: str | os.PathLike[str], arguments: OpenArguments, "
                     "engine: str, pose: Sequence[str], duration: float | None, "
                     "time_step: float, frames_per_second: float, triangles: int, "
                     "colliders: bool) -> dict[str, Any]"));
}

}  // namespace tenon::python
