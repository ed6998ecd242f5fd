// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tenon/answers/json.h"

namespace tenon {

/// An engine, a library or a program that tenon can do without.
struct OptionalPart {
  std::string name;
  bool available = false;
  std::string version;     ///< where it is available
  std::string how_to_get;  ///< where it is not
};

struct OptionalParts {
  std::vector<OptionalPart> engines;
  std::vector<OptionalPart> libraries;

  bool has_all_engines() const;
};

/// Looks for all of them; starts the worker to hear about it.
OptionalParts optional_parts();

/// {"engines", "libraries": [{"name", "available", "version", "howToGet"}]}.
answers::Json parts_json(const OptionalParts& parts);

}  // namespace tenon
