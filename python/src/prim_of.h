// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "failure.h"
#include "opened_stage.h"

#include "tenon/base/path.h"

namespace tenon::python {

using StagePtr = std::shared_ptr<OpenedStage>;

inline Path path_of(const std::string& written) { return or_raise(Path::parse(written)); }

/// A prim as Python holds it.
struct PrimOf {
  StagePtr stage;
  Path path;

  bool operator==(const PrimOf&) const = default;
};

/// Raises that there is no prim at the path, with the one that was meant.
[[noreturn]] void raise_no_prim(const stage::Stage& stage, Path wanted);

/// Calls with the prim; raises where it is not there any more.
template <class Call>
auto with_prim(const PrimOf& prim, const Call& call) {
  const auto stage = prim.stage->access();
  const stage::Prim found = stage->prim(prim.path);
  if (!found) {
    raise_no_prim(*stage, prim.path);
  }
  return call(found);
}

template <class Names>
nb::list words_of(const Names& names) {
  nb::list result;
  for (const auto& name : names) {
    if constexpr (requires { name.str(); }) {
      result.append(text(name.str()));
    } else {
      result.append(text(name));
    }
  }
  return result;
}

}  // namespace tenon::python
