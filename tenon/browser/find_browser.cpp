// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <cstdlib>

#include "tenon/browser/browser_page.h"
#include "tenon/guard/driven_program.h"

namespace tenon::browser {
namespace {

constexpr const char* kHowToGet =
    "install it (apt-get install chromium), or name one with --browser or the environment variable "
    "TENON_CHROMIUM";

Error no_browser(const std::string& named) {
  if (named.empty()) {
    return Error(ErrorCode::Missing, "there is no Chromium here to draw pictures with")
        .with_rule("browser.missing")
        .with_fix(kHowToGet);
  }
  return Error(ErrorCode::Missing, "this is not a program")
      .in_file(named)
      .with_rule("browser.missing")
      .with_fix("name the program of a Chromium, or leave it out");
}

}  // namespace

Result<std::string> find_browser(const std::string& named) {
  std::string wanted = named;
  if (const char* variable = secure_getenv("TENON_CHROMIUM"); wanted.empty() && variable) {
    wanted = variable;
  }
  const std::vector<std::string> usual{"chromium",      "chromium-browser",
                                       "google-chrome", "google-chrome-stable",
                                       "chrome",        "chrome-headless-shell"};
  const auto found = guard::find_program(wanted.empty() ? usual : std::vector{wanted});
  return found ? Result<std::string>(*found) : no_browser(wanted);
}

}  // namespace tenon::browser
