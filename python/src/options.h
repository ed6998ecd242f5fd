// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <utility>

#include <nanobind/nanobind.h>

#include "tenon/open_stage.h"
#include "tenon/physics/readings.h"

namespace tenon::python {

/// How an asset is opened and read, as tenon_usd/options.py hands it over.
struct OpenArguments {
  OpenOptions open;
  std::map<std::string, std::string> readings;  ///< by the names of physics::reading_choices
};

/// Raises for unknown names and values.
physics::Readings readings_of(const OpenArguments& arguments);
/// The options for a stage whose physics is read with these readings.
OpenOptions open_options_of(const OpenArguments& arguments);

void bind_options(nanobind::module_& module);

}  // namespace tenon::python
