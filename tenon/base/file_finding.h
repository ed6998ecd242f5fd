// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "tenon/base/diagnostics.h"

namespace tenon {

/// A finding about a place in a file; line 0 where none is known.
inline Diagnostic file_finding(Severity severity, std::string rule, std::string message,
                               std::string file, std::uint32_t line = 0, std::string fix = {}) {
  Diagnostic finding;
  finding.severity = severity;
  finding.rule = std::move(rule);
  finding.message = std::move(message);
  finding.file = std::move(file);
  finding.line = line;
  finding.fix = std::move(fix);
  return finding;
}

}  // namespace tenon
