// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// One thing is asked at a time; what the browser tells meanwhile is dealt with while the answer is
// waited for. The page has an address that no network is asked for: all its requests stop here
// (Fetch.requestPaused), its own is answered with its text, those for what it holds itself (blob:,
// data:) go on, others fail. Drawing is done by the processor, the same on every machine.
#include "tenon/browser/browser_page.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <optional>
#include <utility>

#include <nlohmann/json.hpp>

#include "tenon/base/limits/browser_limits.h"
#include "tenon/base/text/base64.h"
#include "tenon/bytes/write/temporary_folder.h"
#include "tenon/guard/driven_program.h"

namespace tenon::browser {
namespace {

using Json = nlohmann::json;
using guard::DrivenProgram;
using guard::Waiting;
using std::chrono::milliseconds;

constexpr const char* kAddress = "http://localhost/tenon";  // counts as safe, as films need
constexpr std::size_t kMostMessages = 50;
constexpr milliseconds kSlice{200};

constexpr std::array kSwitches{
    "--headless=new",
    "--remote-debugging-pipe",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--force-color-profile=srgb",
    "--force-device-scale-factor=1",
    "--hide-scrollbars",
    "--mute-audio",
    "--no-first-run",
    "--no-default-browser-check",
    "--disable-background-networking",
    "--disable-breakpad",
    "--disable-component-update",
    "--disable-default-apps",
    "--disable-domain-reliability",
    "--disable-extensions",
    "--disable-sync",
    "--disable-features=OptimizationHints,MediaRouter,Translate",
    "--metrics-recording-only",
    "--no-pings",
    "--password-store=basic",
    "--host-resolver-rules=MAP * ~NOTFOUND",
    "--proxy-server=0.0.0.0:9",
};

Error fault(ErrorCode code, const char* rule, std::string message) {
  return Error(code, std::move(message)).with_rule(rule);
}

std::string text_at(const Json& object, const char* key) {
  const auto at = object.is_object() ? object.find(key) : object.end();
  return at != object.end() && at->is_string() ? at->get<std::string>() : std::string();
}

const Json& part_at(const Json& object, const char* key) {
  static const Json none = Json::object();
  const auto at = object.is_object() ? object.find(key) : object.end();
  return at != object.end() ? *at : none;
}

std::string last_lines(const std::string& words) {
  constexpr std::size_t kShown = 400;
  std::string text = words.substr(words.size() - std::min(words.size(), kShown));
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) {
    text.pop_back();
  }
  return text;
}

std::vector<std::string> arguments_of(const BrowserOptions& options, const std::string& profile,
                                      std::size_t width, std::size_t height) {
  std::vector<std::string> arguments(kSwitches.begin(), kSwitches.end());
  if (!options.sandbox || guard::runs_as_root()) {
    arguments.emplace_back("--no-sandbox");  // Chromium has none for the administrator
  }
  arguments.push_back("--user-data-dir=" + profile);
  arguments.push_back("--window-size=" + std::to_string(width) + "," + std::to_string(height));
  arguments.emplace_back("about:blank");
  return arguments;
}

/// Whatever it leaves anywhere goes with the profile.
std::vector<std::string> environment_of(const std::string& profile) {
  return {"TMPDIR=" + profile, "XDG_CACHE_HOME=" + profile + "/cache",
          "XDG_CONFIG_HOME=" + profile + "/config"};
}

}  // namespace

struct BrowserPage::State {
  BrowserOptions options;
  std::string program;
  std::string version;
  std::string html;                // base64
  bytes::TemporaryFolder profile;  // outlives the process, which is declared after it
  std::unique_ptr<DrivenProgram> process;
  std::string session;
  std::vector<std::string> messages;
  std::uint64_t next_id = 1;
  bool interrupted = false;
  bool crashed = false;

  Result<void> start(std::size_t width, std::size_t height);
  Result<void> attach(std::size_t width, std::size_t height);
  std::uint64_t post(const char* method, Json parameters);
  Result<Json> call(const char* method, Json parameters);
  Result<Json> next_message();
  void hear(const Json& event);
  void answer_request(const Json& parameters);
  void note(std::string message);
  Error ended() const;
};

Result<void> BrowserPage::State::start(std::size_t width, std::size_t height) {
  TENON_TRY(program, find_browser(options.program));
  TENON_TRY(profile, bytes::TemporaryFolder::make());
  TENON_TRY(process, DrivenProgram::start(
                         program, {arguments_of(options, profile.path(), width, height),
                                   environment_of(profile.path()), limits::kBrowserAnswer}));
  TENON_TRY(const Json about, call("Browser.getVersion", Json::object()));
  version = text_at(about, "product");
  return attach(width, height);
}

/// A window, told by what comes from it, with the page in it.
Result<void> BrowserPage::State::attach(std::size_t width, std::size_t height) {
  TENON_TRY(const Json made, call("Target.createTarget", {{"url", "about:blank"}}));
  TENON_TRY(
      const Json attached,
      call("Target.attachToTarget", {{"targetId", text_at(made, "targetId")}, {"flatten", true}}));
  session = text_at(attached, "sessionId");
  if (session.empty()) {
    return fault(ErrorCode::Io, "browser.protocol", "the browser opens no page").in_file(program);
  }
  Json everything = Json::object({{"urlPattern", "*"}});
  TENON_CHECK(call("Fetch.enable", {{"patterns", Json::array({std::move(everything)})}}));
  for (const char* part : {"Runtime.enable", "Log.enable", "Page.enable", "Inspector.enable"}) {
    TENON_CHECK(call(part, Json::object()));
  }
  TENON_CHECK(
      call("Emulation.setDeviceMetricsOverride",
           {{"width", width}, {"height", height}, {"deviceScaleFactor", 1}, {"mobile", false}}));
  TENON_TRY(const Json shown, call("Page.navigate", {{"url", kAddress}}));
  if (const std::string wrong = text_at(shown, "errorText"); !wrong.empty()) {
    return fault(ErrorCode::Io, "browser.protocol", "the browser does not show the page: " + wrong)
        .in_file(program);
  }
  return {};
}

std::uint64_t BrowserPage::State::post(const char* method, Json parameters) {
  const std::uint64_t id = next_id++;
  Json message = {{"id", id}, {"method", method}, {"params", std::move(parameters)}};
  if (!session.empty()) {
    message["sessionId"] = session;
  }
  process->post(message.dump(-1, ' ', true, Json::error_handler_t::replace));
  return id;
}

Result<Json> BrowserPage::State::call(const char* method, Json parameters) {
  const std::uint64_t id = post(method, std::move(parameters));
  for (;;) {
    TENON_TRY(Json message, next_message());
    const auto found = message.find("id");
    if (found == message.end()) {
      hear(message);
      if (crashed) {
        return ended();
      }
    } else if (found->is_number_unsigned() && found->get<std::uint64_t>() == id) {
      if (const auto wrong = message.find("error"); wrong != message.end()) {
        return fault(
                   ErrorCode::Io, "browser.protocol",
                   std::string("the browser refuses ") + method + ": " + text_at(*wrong, "message"))
            .in_file(program)
            .with_fix("use a Chromium of 2023 or later");
      }
      return part_at(message, "result");
    }
  }
}

Result<Json> BrowserPage::State::next_message() {
  std::string text;
  double waited = 0;
  for (;;) {
    if (interrupted || (options.go_on && !options.go_on())) {
      interrupted = true;
      return fault(ErrorCode::Invalid, "browser.interrupted", "interrupted");
    }
    const double left = std::min(options.patience - waited, kSlice.count() / 1000.0);
    const auto slice = milliseconds(std::max(1, static_cast<int>(1000 * left)));
    switch (process->receive(text, slice)) {
      case Waiting::Done: {
        Json message = Json::parse(text, nullptr, false);
        if (!message.is_object()) {
          return fault(ErrorCode::Io, "browser.protocol", "what the browser says is not understood")
              .in_file(program)
              .with_fix("name a Chromium with --browser or TENON_CHROMIUM");
        }
        return message;
      }
      case Waiting::Ended:
        return ended();
      case Waiting::TooLong:
        return fault(ErrorCode::Limit, "browser.protocol",
                     "the browser sent a message that is too large")
            .in_file(program);
      case Waiting::Late:
        waited += static_cast<double>(slice.count()) / 1000;
    }
    if (waited >= options.patience) {
      return fault(ErrorCode::Io, "browser.silent",
                   "the browser says nothing for " +
                       std::to_string(static_cast<int>(options.patience)) + " s")
          .in_file(program)
          .with_fix("draw less (--size, --simplify), or wait longer (--patience)");
    }
  }
}

void BrowserPage::State::hear(const Json& event) {
  const std::string method = text_at(event, "method");
  const Json& parameters = part_at(event, "params");
  if (method == "Fetch.requestPaused") {
    answer_request(parameters);
  } else if (method == "Runtime.consoleAPICalled") {
    std::string message = text_at(parameters, "type") + ":";
    for (const Json& argument : part_at(parameters, "args")) {
      const std::string value = text_at(argument, "value");
      message += " " + (value.empty() ? text_at(argument, "description") : value);
    }
    note(std::move(message));
  } else if (method == "Runtime.exceptionThrown") {
    const Json& details = part_at(parameters, "exceptionDetails");
    note("thrown: " + text_at(details, "text") + " " +
         text_at(part_at(details, "exception"), "description"));
  } else if (method == "Log.entryAdded") {
    const Json& entry = part_at(parameters, "entry");
    note(text_at(entry, "level") + ": " + text_at(entry, "text"));
  } else if (method == "Inspector.targetCrashed" || method == "Inspector.detached") {
    crashed = true;
  }
}

void BrowserPage::State::answer_request(const Json& parameters) {
  const std::string url = text_at(part_at(parameters, "request"), "url");
  const std::string request = text_at(parameters, "requestId");
  if (url == kAddress) {
    const Json type =
        Json::object({{"name", "Content-Type"}, {"value", "text/html; charset=utf-8"}});
    post("Fetch.fulfillRequest", {{"requestId", request},
                                  {"responseCode", 200},
                                  {"responseHeaders", Json::array({type})},
                                  {"body", html}});
  } else if (url.starts_with("blob:") || url.starts_with("data:")) {
    post("Fetch.continueRequest", {{"requestId", request}});
  } else {
    if (!url.ends_with("/favicon.ico")) {
      note("refused: " + url);
    }
    post("Fetch.failRequest", {{"requestId", request}, {"errorReason", "BlockedByClient"}});
  }
}

void BrowserPage::State::note(std::string message) {
  if (messages.size() < kMostMessages) {
    messages.push_back(std::move(message));
  }
}

Error BrowserPage::State::ended() const {
  process->end();
  const std::string& words = process->last_words();
  if (words.find("sandbox") != std::string::npos && version.empty()) {
    return fault(ErrorCode::Missing, "browser.sandbox", "the browser may not make its sandbox here")
        .in_file(program)
        .with_fix("let users make namespaces, or do without it: --no-sandbox");
  }
  std::string message = crashed ? "the browser's page has crashed" : "the browser has ended";
  if (const std::string last = last_lines(words); !crashed && !last.empty()) {
    message += "; it said: " + last;
  }
  return fault(ErrorCode::Io, "browser.ended", std::move(message))
      .in_file(program)
      .with_fix("draw less (--size, --simplify), or name another Chromium with --browser");
}

Result<std::unique_ptr<BrowserPage>> BrowserPage::open(const BrowserOptions& options,
                                                       std::string_view html, std::size_t width,
                                                       std::size_t height) {
  if (html.size() > limits::kBrowserPage) {
    return fault(
               ErrorCode::Limit, "browser.page-too-large",
               "the page is too large for a browser: " + std::to_string(html.size() >> 20) + " MB")
        .with_fix("simplify the picture's meshes (--simplify)");
  }
  auto state = std::make_unique<State>();
  state->options = options;
  state->html = base64_text(html);
  TENON_CHECK(state->start(width, height));
  return std::unique_ptr<BrowserPage>(new BrowserPage(std::move(state)));
}

BrowserPage::BrowserPage(std::unique_ptr<State> state) : state_(std::move(state)) {}
BrowserPage::~BrowserPage() = default;

Result<std::string> BrowserPage::evaluate(std::string_view script) {
  TENON_TRY(const Json answer, state_->call("Runtime.evaluate", {{"expression", script},
                                                                 {"awaitPromise", true},
                                                                 {"returnByValue", true}}));
  if (const auto thrown = answer.find("exceptionDetails"); thrown != answer.end()) {
    std::string what = text_at(part_at(*thrown, "exception"), "description");
    what = what.empty() ? text_at(*thrown, "text") : what.substr(0, what.find("\n    at "));
    return fault(ErrorCode::Invalid, "browser.script", std::move(what));
  }
  return part_at(part_at(answer, "result"), "value").dump();
}

Result<std::string> BrowserPage::text(std::string_view script) {
  TENON_TRY(const std::string value, evaluate(script));
  const Json parsed = Json::parse(value, nullptr, false);
  if (!parsed.is_string()) {
    return fault(ErrorCode::Io, "browser.protocol", "the page does not answer with text");
  }
  return parsed.get<std::string>();
}

Result<std::string> BrowserPage::screenshot() {
  TENON_TRY(const Json answer, state_->call("Page.captureScreenshot", {{"format", "png"}}));
  std::optional<std::string> png = bytes_of_base64(text_at(answer, "data"));
  if (!png || !png->starts_with("\x89PNG")) {
    return fault(ErrorCode::Io, "browser.protocol", "the browser answers with no picture")
        .in_file(state_->program);
  }
  return *std::move(png);
}

const std::vector<std::string>& BrowserPage::messages() const { return state_->messages; }
bool BrowserPage::interrupted() const { return state_->interrupted; }
const std::string& BrowserPage::version() const { return state_->version; }

}  // namespace tenon::browser
