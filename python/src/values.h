// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nanobind/nanobind.h>

#include "tenon/layer/value.h"

namespace tenon::python {

/// A value of a layer: bool, int, float, str; vectors as tuples, quaternions (w, x, y, z), matrices
/// as tuples of rows; arrays of numbers as NumPy views of the value's own memory, which cannot be
/// written to, other arrays as lists; asset paths as AssetPath; dictionaries as dict; list
/// edits and other values of fields as text layers print them. None for no value. Raises where data
/// of a file are corrupt.
nanobind::object to_python(const layer::Value& value);

void bind_values(nanobind::module_& module);

}  // namespace tenon::python
