// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "failure.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <string_view>

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

/// What the library says to those who write C++ or type commands, as Python has it.
struct Words {
  std::string_view from;
  std::string_view to;
};
constexpr std::array kWords{
    Words{"switch it on in SimulationOptions::outputs when the simulation is made",
          "ask for it when the world is made: World(..., outputs=[...])"},
    Words{"other SimulationOptions::drives", "other drives"},
    Words{"other SimulationOptions::methods", "another integrator or solver"},
    Words{"--in or --engine", "layer= or engine="},
    Words{"--in", "layer="},
    Words{"--conflicts source", "conflicts=\"source\""},
    Words{"--conflicts edits", "conflicts=\"edits\""},
    Words{"--force", "force=True"},
    Words{"--update", "update=True"},
    Words{"--search-path", "search_paths="},
    Words{"--allow-read", "allow_read="},
    Words{"--package", "packages="},
    Words{"--engines", "engines="},
    Words{"tenon tree ASSET --attributes lists what there is", "Prim.properties lists all"},
    Words{"tenon set ASSET --type TYPE makes a new one", "type_name= makes a new one"},
    Words{"--reading", "readings="},
    Words{"--fix-base", "fix_base=True"},
    Words{"--match is", "add_matching() is"},
    Words{"leave --match out", "call add()"},
    Words{"as in '.*_collision=collider'", "as in \".*_collision\""},
    Words{"tenon check --list-rules names all", "tenon_usd.rules() names all"},
    Words{"--layer takes NAME=VALUE for", "set_metadata() takes"},
    Words{"--layer", "set_metadata():"},
    Words{"tenon tree lists all prims", "Stage.prims lists all"},
};

/// A whole option, and not the beginning of a longer one.
bool is_whole(const std::string& text, std::size_t end) {
  return end == text.size() ||
         (text[end] != '-' && std::isalnum(static_cast<unsigned char>(text[end])) == 0);
}

/// "--file-up Q is no up axis" is about file_up=; a command that is to be typed keeps its options.
void name_arguments(std::string& text) {
  if (text.find("tenon ") != std::string::npos) {
    return;
  }
  const auto is_letter = [&](std::size_t at) {
    return at < text.size() && (text[at] == '-' || (text[at] >= 'a' && text[at] <= 'z') ||
                                (text[at] >= '0' && text[at] <= '9'));
  };
  for (std::size_t at = text.find("--"); at != std::string::npos; at = text.find("--", at + 1)) {
    std::size_t end = at + 2;
    for (; is_letter(end); ++end) {
    }
    const bool is_option = end > at + 2 && text[at + 2] != '-' && (at == 0 || text[at - 1] == ' ');
    if (is_option) {
      std::string name = text.substr(at + 2, end - at - 2);
      std::replace(name.begin(), name.end(), '-', '_');
      const bool is_keyword = name == "with" || name == "for" || name == "import";
      text.replace(at, end - at, name + (is_keyword ? "_=" : "="));
    }
  }
}

void say_in_python(std::string& text) {
  for (const Words& words : kWords) {
    for (std::size_t at = text.find(words.from); at != std::string::npos;
         at = text.find(words.from, at + 1)) {
      if (is_whole(text, at + words.from.size())) {
        text.replace(at, words.from.size(), words.to);
      }
    }
  }
  name_arguments(text);
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
  for (Diagnostic& finding : placed) {
    say_in_python(finding.message);
    say_in_python(finding.fix);
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

// ---- pickles: a version, and every member; texts as bytes, whatever they are

constexpr int kPickleVersion = 1;

nb::bytes packed(const std::string& text) { return nb::bytes(text.data(), text.size()); }
std::string unpacked(nb::handle state) {
  const auto held = nb::cast<nb::bytes>(state);
  return {held.c_str(), held.size()};
}

void check_state(const nb::tuple& state, std::size_t size) {
  if (state.size() != size || nb::cast<int>(state[0]) != kPickleVersion) {
    throw nb::value_error("a finding of another version of tenon_usd");
  }
}

template <class Enum>
Enum enum_of(nb::handle state, Enum last) {
  const int number = nb::cast<int>(state);
  if (number < 0 || number > static_cast<int>(last)) {
    throw nb::value_error("a finding of another version of tenon_usd");
  }
  return static_cast<Enum>(number);
}

nb::tuple state_of(const RelatedPrim& related) {
  return nb::make_tuple(kPickleVersion, static_cast<int>(related.role), packed(related.path),
                        packed(related.file), related.line, related.column);
}

RelatedPrim related_of(const nb::tuple& state) {
  check_state(state, 6);
  RelatedPrim related;
  related.role = enum_of(state[1], RelatedRole::Target);
  related.path = unpacked(state[2]);
  related.file = unpacked(state[3]);
  related.line = nb::cast<std::uint32_t>(state[4]);
  related.column = nb::cast<std::uint32_t>(state[5]);
  return related;
}

nb::tuple state_of(const Diagnostic& finding) {
  nb::list related;
  for (const RelatedPrim& one : finding.related) {
    related.append(state_of(one));
  }
  return nb::make_tuple(kPickleVersion, static_cast<int>(finding.severity), packed(finding.rule),
                        packed(finding.message), packed(finding.file), finding.line, finding.column,
                        packed(finding.prim), packed(finding.property), packed(finding.fix),
                        finding.end_line, finding.end_column, related);
}

Diagnostic finding_of(const nb::tuple& state) {
  check_state(state, 13);
  Diagnostic finding;
  finding.severity = enum_of(state[1], Severity::Error);
  std::size_t at = 2;
  for (std::string* text : {&finding.rule, &finding.message, &finding.file}) {
    *text = unpacked(state[at++]);
  }
  finding.line = nb::cast<std::uint32_t>(state[at++]);
  finding.column = nb::cast<std::uint32_t>(state[at++]);
  for (std::string* text : {&finding.prim, &finding.property, &finding.fix}) {
    *text = unpacked(state[at++]);
  }
  finding.end_line = nb::cast<std::uint32_t>(state[at++]);
  finding.end_column = nb::cast<std::uint32_t>(state[at++]);
  for (const nb::handle one : nb::cast<nb::list>(state[at])) {
    finding.related.push_back(related_of(nb::cast<nb::tuple>(one)));
  }
  return finding;
}

template <class T, class Read>
void bind_pickle(nb::class_<T>& bound, const Read& read) {
  bound.def(
      "__getstate__", [](const T& self) { return state_of(self); },
      nb::sig("def __getstate__(self) -> tuple[Any, ...]"));
  bound.def(
      "__setstate__", [read](T& self, const nb::tuple& state) { new (&self) T(read(state)); },
      nb::sig("def __setstate__(self, state: tuple[Any, ...]) -> None"));
}

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
  bind_pickle(bound, &related_of);
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
  bind_pickle(bound, &finding_of);
}

}  // namespace tenon::python
