// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "tenon/base/function.h"
#include "tenon/base/result.h"

/// Pages that a local Chromium draws without a window, for pictures and films. It is controlled
/// over a pair of sockets (its DevTools protocol); nothing goes through a network.
namespace tenon::browser {

struct BrowserOptions {
  std::string program;   ///< find_browser() is asked for it
  bool sandbox = true;   ///< Chromium's own, which its processes are held by
  double patience = 60;  ///< how long it may say nothing [s]
  /// Asked several times a second; false ends the work.
  Function<bool()> go_on;
};

/// The program: `named`, a path or a name; else the environment variable TENON_CHROMIUM; else
/// chromium, chromium-browser, google-chrome and others like them by PATH. Errors: Missing, with
/// how to get one ("browser.missing").
Result<std::string> find_browser(const std::string& named);

/// A page in a browser of its own, whose profile is a temporary folder. It gets only its own text:
/// other requests are refused and noted in messages(). Errors of all functions: Missing where the
/// browser cannot be started ("browser.missing", "browser.sandbox"), Io where it ends
/// ("browser.ended"), is silent for too long ("browser.silent") or breaks its protocol
/// ("browser.protocol"), Limit for data that is too large, Invalid after an interrupt.
class BrowserPage {
 public:
  /// Starts the browser and shows `html`, `width` by `height` pixels.
  static Result<std::unique_ptr<BrowserPage>> open(const BrowserOptions& options,
                                                   std::string_view html, std::size_t width,
                                                   std::size_t height);
  ~BrowserPage();
  BrowserPage(const BrowserPage&) = delete;
  BrowserPage& operator=(const BrowserPage&) = delete;

  /// Runs a script in the page and waits for its value, promises included; -> the value as JSON.
  /// Errors: also Invalid with what the script threw ("browser.script").
  Result<std::string> evaluate(std::string_view script);
  /// The same for a script whose value is text.
  Result<std::string> text(std::string_view script);
  /// What the window shows, a PNG.
  Result<std::string> screenshot();

  /// Messages of the page's console, its exceptions and refused requests, as far as known.
  const std::vector<std::string>& messages() const;
  /// BrowserOptions::go_on has ended the work.
  bool interrupted() const;
  /// "Chrome/130.0.1".
  const std::string& version() const;

 private:
  struct State;
  explicit BrowserPage(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace tenon::browser
