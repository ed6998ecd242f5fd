// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "failure.h"

#include <string>

#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>

#include "tenon/formats/find_places.h"

namespace tenon::python {
namespace {

/// The names of tenon_usd.errors.CLASSES.
const char* code_name(ErrorCode code) {
  switch (code) {
    case ErrorCode::Io:
      return "io";
    case ErrorCode::Parse:
      return "parse";
    case ErrorCode::Corrupt:
      return "corrupt";
    case ErrorCode::Unsupported:
      return "unsupported";
    case ErrorCode::Limit:
      return "limit";
    case ErrorCode::Invalid:
      return "invalid";
    case ErrorCode::NotFound:
      return "notFound";
    case ErrorCode::Unstable:
      return "unstable";
    case ErrorCode::Missing:
      return "missing";
  }
  return "invalid";
}

nb::str decoded(std::string_view bytes, const char* errors) {
  PyObject* made =
      PyUnicode_DecodeUTF8(bytes.data(), static_cast<Py_ssize_t>(bytes.size()), errors);
  if (made == nullptr) {
    throw nb::python_error();
  }
  return nb::steal<nb::str>(made);
}

template <class Field>
void add_text(nb::class_<Diagnostic>& bound, const char* name, Field Diagnostic::* field,
              const char* meaning) {
  bound.def_prop_ro(
      name, [field](const Diagnostic& finding) { return message(finding.*field); }, meaning);
}

}  // namespace

nb::str text(std::string_view bytes) { return decoded(bytes, "surrogateescape"); }
nb::str message(std::string_view bytes) { return decoded(bytes, "backslashreplace"); }

nb::list to_list(const Diagnostics& diagnostics) {
  Diagnostics placed = diagnostics;
  if (!placed.empty()) {
    unlocked([&] {
      formats::find_places(placed, bytes::Files());
      return true;
    });
  }
  nb::list rows;
  for (const Diagnostic& finding : placed) {
    rows.append(nb::cast(finding));
  }
  return rows;
}

void raise(const Error& error, const Diagnostics& found) {
  Diagnostics all;
  all.add(error.diagnostic());
  for (const Diagnostic& finding : error.further()) {
    all.add(finding);
  }
  all.append(found);
  const nb::list rows = to_list(all);
  const bool no_file = error.diagnostic().rule == "file.not-found";
  const nb::object errors = nb::module_::import_("tenon_usd.errors");
  const nb::object kind =
      errors.attr("CLASSES")[no_file ? "fileNotFound" : code_name(error.code())];
  const nb::object made = kind(nb::str(rows[0]), rows);
  PyErr_SetObject(kind.ptr(), made.ptr());
  throw nb::python_error();
}

namespace {

void bind_related(nb::module_& module) {
  nb::class_<RelatedPrim> bound(module, "RelatedPrim",
                                "What a finding is about beside its own prim.");
  bound.def_prop_ro(
      "path", [](const RelatedPrim& related) { return message(related.path); },
      "Of a prim or a property.");
  bound.def_prop_ro(
      "role", [](const RelatedPrim& related) { return role_name(related.role); },
      "\"prim\", \"body\", \"collider\", \"joint\", \"articulation\", \"material\", \"scene\", "
      "\"collisionGroup\", \"property\", or \"target\": what a relationship names.");
  bound.def_prop_ro(
      "file", [](const RelatedPrim& related) { return message(related.file); },
      "The layer that the path is one of, where it is not the stage; often empty.");
}

}  // namespace

void bind_diagnostics(nb::module_& module) {
  bind_related(module);
  nb::class_<Diagnostic> bound(module, "Diagnostic",
                               "One finding about an input: what is wrong, where, and what to do "
                               "about it. Empty strings and zero numbers mean unknown.");
  bound.def_prop_ro(
      "severity", [](const Diagnostic& finding) { return severity_name(finding.severity); },
      "\"error\", \"warning\" or \"info\".");
  add_text(bound, "rule", &Diagnostic::rule, "Stable dotted name, such as \"joint.body-missing\".");
  add_text(bound, "message", &Diagnostic::message, "One sentence that names the offending value.");
  add_text(bound, "file", &Diagnostic::file, "The layer, as it was named.");
  bound.def_ro("line", &Diagnostic::line, "In the file, counted from 1; 0 where it is unknown.");
  bound.def_ro("column", &Diagnostic::column, "In bytes, counted from 1; 0 where it is unknown.");
  add_text(bound, "prim", &Diagnostic::prim, "Path of the prim.");
  add_text(bound, "property_name", &Diagnostic::property,
           "Its name, without the path of the prim.");
  add_text(bound, "fix", &Diagnostic::fix, "What can be done about it.");
  bound.def_prop_ro(
      "related",
      [](const Diagnostic& finding) {
        nb::list rows;
        for (const RelatedPrim& related : finding.related) {
          rows.append(nb::cast(related));
        }
        return rows;
      },
      nb::sig("def related(self) -> list[RelatedPrim]"),
      "What it is about beside its own prim: all that the message names, and more.");
  const auto shown = [](const Diagnostic& finding) { return message(finding.to_string()); };
  bound.def("__str__", shown);
  bound.def("__repr__", shown);
}

}  // namespace tenon::python
