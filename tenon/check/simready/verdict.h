// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace tenon::check::simready {

struct Requirement;

enum class Verdict : unsigned char { Pass, Fail, Open };
/// "pass", "fail", "open".
std::string_view verdict_name(Verdict verdict);

struct CodeVerdict {
  const Requirement* requirement = nullptr;
  Verdict verdict = Verdict::Pass;
  std::string reason{};  ///< of Open
};

}  // namespace tenon::check::simready
