// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <utility>

#include <nanobind/nanobind.h>

#include "tenon/base/diagnostics.h"
#include "tenon/base/error.h"
#include "tenon/base/result.h"

/// How failures of the library become exceptions of Python, and texts of files its strings.
namespace tenon::python {

namespace nb = nanobind;

/// Raises tenon_usd.Error (tenon_usd/errors.py), the class of the error's code, with the error's
/// diagnostic and those that were found on the way. The caller holds the interpreter's lock.
[[noreturn]] void raise(const Error& error, const Diagnostics& found = {});

/// What a result holds; raises where it holds none.
template <class T>
T or_raise(Result<T> result, const Diagnostics& found = {}) {
  if (!result) {
    raise(result.error(), found);
  }
  return *std::move(result);
}
inline void or_raise(const Result<void>& result, const Diagnostics& found = {}) {
  if (!result) {
    raise(result.error(), found);
  }
}

/// Runs what takes long while other threads of Python run. It touches nothing of Python.
template <class Call>
auto unlocked(const Call& call) {
  const nb::gil_scoped_release release;
  return call();
}

/// Text of a file, which may be no UTF-8: such bytes become lone surrogates, as Python's own
/// functions of file names have it.
nb::str text(std::string_view bytes);
/// The same for messages, which are printed: such bytes become "\xNN".
nb::str message(std::string_view bytes);

/// Rows for people and programs.
nb::list to_list(const Diagnostics& diagnostics);

void bind_diagnostics(nb::module_& module);

}  // namespace tenon::python
