// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "options.h"

#include "failure.h"
#include <nanobind/stl/map.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "tenon/asset/physics_options.h"
#include "tenon/bytes/file_bytes.h"

namespace tenon::python {
namespace {

using namespace nb::literals;

template <class Type>
void bind_option(nb::class_<OpenArguments>& bound, const char* name, Type OpenOptions::* field,
                 const char* meaning) {
  bound.def_prop_rw(
      name, [field](const OpenArguments& arguments) { return arguments.open.*field; },
      [field](OpenArguments& arguments, Type value) { arguments.open.*field = std::move(value); },
      meaning);
}

}  // namespace

physics::Readings readings_of(const OpenArguments& arguments) {
  physics::Readings readings;
  for (const auto& [name, value] : arguments.readings) {
    or_raise(physics::set_reading(readings, name, value));
  }
  return readings;
}

OpenOptions open_options_of(const OpenArguments& arguments) {
  return with_readings(arguments.open, readings_of(arguments));
}

void bind_options(nb::module_& module) {
  nb::class_<OpenArguments> bound(module, "OpenArguments", "How an asset is opened and read.");
  bound.def(nb::init<>());
  bind_option(bound, "physics", &OpenOptions::physics_variant,
              "Variant of the variant sets \"Physics\".");
  bind_option(bound, "physics_below", &OpenOptions::physics_below,
              "The same of prims below the default prim, as far as they have the variant.");
  bind_option(bound, "physics_of", &OpenOptions::physics_of, "\"PRIM=VARIANT\" of single prims.");
  bind_option(bound, "overrides", &OpenOptions::overrides,
              "\"PATH.attribute=value\", which win over the files.");
  bind_option(bound, "session", &OpenOptions::session_path, "A session layer file.");
  bind_option(bound, "payloads", &OpenOptions::load_payloads, "Whether payloads are loaded.");
  bind_option(bound, "load", &OpenOptions::load, "Prims whose payloads are loaded; empty: all.");
  bind_option(bound, "mask", &OpenOptions::mask, "Prims that are composed; empty: all.");
  bind_option(bound, "muted", &OpenOptions::muted, "Layers that count as absent.");
  bind_option(bound, "variant_fallbacks", &OpenOptions::variant_fallbacks,
              "Variants to select where none is, by variant set.");
  bind_option(bound, "search_paths", &OpenOptions::search_paths,
              "Folders that asset paths are looked up in.");
  bind_option(bound, "sandbox", &OpenOptions::sandbox_roots,
              "Folders that files may be read from; empty: all.");
  bind_option(bound, "allow_read", &OpenOptions::allowed_reads,
              "Folders and files that may go into outputs.");
  bind_option(bound, "max_work", &OpenOptions::max_work,
              "Units of work that composition may take; 0: as usual.");
  bound.def(
      "set_contents",
      [](OpenArguments& arguments, const std::string& path, const nb::bytes& contents) {
        bytes::FileMap files;
        files[path] = bytes::FileBytes::own(std::string(contents.c_str(), contents.size()));
        arguments.open.files = arguments.open.files.with(std::move(files));
      },
      "path"_a, "contents"_a, "Bytes in place of a file.");
  bound.def_rw("readings", &OpenArguments::readings,
               "Readings of the physics that differ from the usual ones, by name.");
}

}  // namespace tenon::python
