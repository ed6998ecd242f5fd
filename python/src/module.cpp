// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "batch.h"
#include "drive_functions.h"
#include "failure.h"
#include "functions.h"
#include "opened_stage.h"
#include "options.h"
#include "overlaps.h"
#include "page_functions.h"
#include "physics.h"
#include "scene_dynamics.h"
#include "values.h"
#include <nanobind/nanobind.h>

NB_MODULE(_tenon, module) {
  module.doc() = "The library behind tenon_usd; use tenon_usd itself.";
  module.attr("VERSION") = TENON_VERSION;
  tenon::python::bind_diagnostics(module);
  tenon::python::bind_values(module);
  tenon::python::bind_options(module);
  tenon::python::bind_physics(module);
  tenon::python::bind_stage(module);
  tenon::python::bind_dynamics(module);
  tenon::python::bind_overlaps(module);
  tenon::python::bind_batch(module);
  tenon::python::bind_functions(module);
  tenon::python::bind_drive_functions(module);
  tenon::python::bind_page_functions(module);
}
