// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Shell scripts replace Chromium. They do not listen: requests come in a known order, so the
// answers are said in advance.
#include "tenon/browser/browser_page.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <unistd.h>

#include "tenon/base/text/base64.h"

namespace tenon::browser {
namespace {

namespace fs = std::filesystem;

/// Answers to all that opening a page asks for, and what follows.
std::string opened(const std::string& further) {
  std::string script = R"(say() { printf '%s\0' "$1" >&4; }
say '{"id":1,"result":{"product":"Fake/1"}}'
say '{"id":2,"result":{"targetId":"t"}}'
say '{"method":"Target.attachedToTarget","params":{}}'
say '{"id":3,"result":{"sessionId":"s"}}'
)";
  for (int id = 4; id <= 10; ++id) {
    script += "say '{\"id\":" + std::to_string(id) + ",\"result\":{}}'\n";
  }
  return script + further;
}

class FakeBrowser : public testing::Test {
 protected:
  FakeBrowser() : folder_(fs::temp_directory_path() / ("tenon_fake_" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
  }
  ~FakeBrowser() override { fs::remove_all(folder_); }

  BrowserOptions options_for(const std::string& script) const {
    const fs::path program = folder_ / "browser";
    std::ofstream(program) << "#!/bin/sh\n" << script;
    fs::permissions(program, fs::perms::owner_all);
    return named(program);
  }
  static BrowserOptions named(const fs::path& program) {
    BrowserOptions options;
    options.program = program.string();
    options.patience = 20;
    return options;
  }
  Result<std::unique_ptr<BrowserPage>> open(const std::string& script) const {
    return BrowserPage::open(options_for(script), "<p>page</p>", 64, 48);
  }
  std::unique_ptr<BrowserPage> page(const std::string& further) const {
    auto made = open(opened(further));
    EXPECT_TRUE(made) << made.error().to_string();
    return made ? *std::move(made) : nullptr;
  }
  static std::string rule(const Error& error) { return error.diagnostic().rule; }

  fs::path folder_;
};

TEST_F(FakeBrowser, AnswersScripts) {
  const auto page = this->page(R"(say '{"id":11,"result":{"result":{"value":{"a":[1,2]}}}}'
say '{"id":12,"result":{"result":{"value":"words"}}}'
say '{"id":13,"result":{"result":{"type":"undefined"}}}'
sleep 9)");
  EXPECT_EQ(*page->evaluate("x"), R"({"a":[1,2]})");
  EXPECT_EQ(*page->text("x"), "words");
  EXPECT_EQ(rule(page->text("x").error()), "browser.protocol");
  EXPECT_EQ(page->version(), "Fake/1");
}

TEST_F(FakeBrowser, WhosePageThrowsIsToldByWhatItThrew) {
  const auto page = this->page(R"(say '{"id":11,"result":{"exceptionDetails":{"text":"Uncaught",
"exception":{"description":"Error: no\n    at x"}}}}'; sleep 9)");
  const auto value = page->evaluate("x");
  ASSERT_FALSE(value);
  EXPECT_EQ(value.error().message(), "Error: no");
  EXPECT_EQ(value.error().code(), ErrorCode::Invalid);
}

TEST_F(FakeBrowser, GetsItsPageAndNothingElse) {
  const std::string heard = (folder_ / "heard").string();
  // The page's answer has id 11, that of the refusal 12, the script 13.
  const auto request = [](const std::string& url) {
    return R"(say '{"method":"Fetch.requestPaused","params":{"requestId":"r","request":{"url":")" +
           url + "\"}}}'\n";
  };
  const auto page =
      this->page(request("http://localhost/tenon") + request("http://evil.example/track") +
                 R"(say '{"method":"Runtime.consoleAPICalled",
"params":{"type":"warning","args":[{"value":"w"}]}}'
say '{"method":"Runtime.exceptionThrown","params":{"exceptionDetails":{"text":"Uncaught"}}}'
say '{"id":11,"result":{"result":{"value":1}}}'
say '{"id":12,"result":{}}'
say '{"id":13,"result":{"result":{"value":2}}}'
timeout 1 cat <&3 > )" +
                 heard + "; say '{\"id\":14,\"result\":{\"result\":{\"value\":3}}}'; sleep 9");
  // The first script has id 11, because the requests come later.
  EXPECT_EQ(*page->evaluate("x"), "1");
  EXPECT_EQ(page->messages(), (std::vector<std::string>{"refused: http://evil.example/track",
                                                        "warning: w", "thrown: Uncaught "}));
  EXPECT_EQ(*page->evaluate("x"), "3");
  std::ifstream file(heard, std::ios::binary);
  const std::string all{std::istreambuf_iterator<char>(file), {}};
  EXPECT_NE(all.find(base64_text("<p>page</p>")), std::string::npos);
  EXPECT_NE(all.find("BlockedByClient"), std::string::npos);
}

TEST_F(FakeBrowser, MakesPictures) {
  const auto page =
      this->page("say '{\"id\":11,\"result\":{\"data\":\"" + base64_text("\x89PNG and so on") +
                 "\"}}'; say '{\"id\":12,\"result\":{\"data\":\"AAAA\"}}'; sleep 9");
  EXPECT_EQ(*page->screenshot(), "\x89PNG and so on");
  EXPECT_EQ(rule(page->screenshot().error()), "browser.protocol");
}

TEST_F(FakeBrowser, ThatEndsIsAnErrorWithItsLastWords) {
  const auto at_once = open("echo 'no display' >&2; exit 1");
  ASSERT_FALSE(at_once);
  EXPECT_EQ(rule(at_once.error()), "browser.ended");
  EXPECT_EQ(at_once.error().code(), ErrorCode::Io);
  EXPECT_NE(at_once.error().message().find("no display"), std::string::npos);
  const auto page = this->page("kill -9 $$");
  EXPECT_EQ(rule(page->evaluate("x").error()), "browser.ended");
}

TEST_F(FakeBrowser, WhosePageCrashesIsAnError) {
  const auto page =
      this->page(R"(say '{"method":"Inspector.targetCrashed","params":{}}'; sleep 9)");
  const auto value = page->evaluate("x");
  ASSERT_FALSE(value);
  EXPECT_EQ(rule(value.error()), "browser.ended");
  EXPECT_NE(value.error().message().find("crashed"), std::string::npos);
}

TEST_F(FakeBrowser, WithoutASandboxSaysHowToGoOn) {
  const auto page = open("echo 'FATAL: No usable sandbox! If you' >&2; exit 1");
  ASSERT_FALSE(page);
  EXPECT_EQ(page.error().code(), ErrorCode::Missing);
  EXPECT_NE(page.error().diagnostic().fix.find("--no-sandbox"), std::string::npos);
}

TEST_F(FakeBrowser, ThatSaysNothingIsWaitedForAWhile) {
  BrowserOptions options = options_for("sleep 100");
  options.patience = 0.3;
  const auto page = BrowserPage::open(options, "", 64, 48);
  ASSERT_FALSE(page);
  EXPECT_EQ(rule(page.error()), "browser.silent");
}

TEST_F(FakeBrowser, ThatTalksNonsenseIsAnError) {
  for (const char* nonsense : {"garbage", "[1]", "7", "null"}) {
    const auto page = open("printf '%s\\0' '" + std::string(nonsense) + "' >&4; sleep 9");
    ASSERT_FALSE(page);
    EXPECT_EQ(rule(page.error()), "browser.protocol");
  }
  const auto refusing =
      open(R"(printf '{"id":1,"error":{"message":"no such thing"}}\0' >&4; sleep 9)");
  ASSERT_FALSE(refusing);
  EXPECT_NE(refusing.error().message().find("no such thing"), std::string::npos);
  const auto empty =
      open(R"(for i in 1 2 3; do printf '{"id":%d,"result":3}\0' $i >&4; done; sleep 9)");
  ASSERT_FALSE(empty);
  EXPECT_EQ(rule(empty.error()), "browser.protocol");
}

TEST_F(FakeBrowser, IsInterrupted) {
  BrowserOptions options = options_for("sleep 100");
  options.go_on = [] { return false; };
  EXPECT_EQ(rule(BrowserPage::open(options, "", 64, 48).error()), "browser.interrupted");
}

TEST_F(FakeBrowser, LeavesNoProfile) {
  const std::string kept = (folder_ / "profile").string();
  const auto page = open(
      "for word in \"$@\"; do case $word in --user-data-dir=*) folder=${word#*=};"
      "esac; done; echo $folder > " +
      kept + "; echo x > $folder/file; echo x > $TMPDIR/other; exit 1");
  ASSERT_FALSE(page);
  std::string profile;
  std::ifstream(kept) >> profile;
  EXPECT_FALSE(profile.empty());
  EXPECT_FALSE(fs::exists(profile)) << profile;
}

TEST_F(FakeBrowser, ThatIsNotThereIsMissing) {
  const auto page = BrowserPage::open(named(folder_ / "none"), "", 64, 48);
  ASSERT_FALSE(page);
  EXPECT_EQ(page.error().code(), ErrorCode::Missing);
  EXPECT_EQ(rule(page.error()), "browser.missing");
}

TEST_F(FakeBrowser, IsFoundByTheEnvironment) {
  const std::string program = options_for("exit 0").program;
  setenv("TENON_CHROMIUM", program.c_str(), 1);
  EXPECT_EQ(*find_browser(""), program);
  setenv("TENON_CHROMIUM", "/no/such/browser", 1);
  const auto none = find_browser("");
  unsetenv("TENON_CHROMIUM");
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().diagnostic().file, "/no/such/browser");
}

}  // namespace
}  // namespace tenon::browser
