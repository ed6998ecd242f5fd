// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <utility>

#include "failure.h"
#include "interruptions.h"
#include "json.h"

namespace tenon::python {

using answers::Json;
/// A verb that Ctrl-C ends before it writes.
using Job = LeavableCall<Json>;

/// An answer with what was found on the way, as "diagnostics".
inline nb::object answered(const Json& json, const Diagnostics& found) {
  nb::object answer = to_python(json);
  answer["diagnostics"] = to_list(found);
  return answer;
}

/// What `verb(job)` answers; it owns all that it takes.
template <class Verb>
nb::object answer_of(Verb verb) {
  const auto job = std::make_shared<Job>();
  const Json json = or_raise(unlocked([&] { return (*job)(std::move(verb)); }), job->found);
  return answered(json, job->found);
}

}  // namespace tenon::python
