// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/text/diagnostic_lines.h"

#include <functional>

#include <gtest/gtest.h>

namespace tenon::cli {
namespace {

using Message = std::function<std::string(std::size_t)>;

std::vector<Diagnostic> warnings(std::size_t count, const Message& message) {
  std::vector<Diagnostic> list;
  for (std::size_t i = 0; i < count; ++i) {
    Diagnostic d;
    d.severity = Severity::Warning;
    d.rule = "some.rule";
    d.message = message(i);
    d.file = "a.usda";
    d.line = static_cast<std::uint32_t>(i + 1);
    d.prim = "/p" + std::to_string(i);
    list.push_back(std::move(d));
  }
  return list;
}

std::vector<std::string> lines(const std::vector<Diagnostic>& list, bool all = false) {
  std::vector<Remark> remarks;
  for (const Diagnostic& d : list) {
    remarks.push_back({&d, ""});
  }
  return diagnostic_lines(remarks, false, all);
}

TEST(DiagnosticLines, ManyThatSayTheSameAreOneLineWithTheFirstPlace) {
  const auto list = warnings(20000, [](std::size_t) { return "no such schema"; });
  ASSERT_EQ(lines(list).size(), 1u);
  EXPECT_EQ(lines(list)[0],
            "a.usda:1: warning: no such schema (</p0>) [some.rule] (and 19,999 more like it; "
            "-v lists all)");
  EXPECT_EQ(lines(list, true).size(), 20000u);
}

TEST(DiagnosticLines, AMessageThatNamesItsOwnPrimIsTheSameForEach) {
  const auto list =
      warnings(20, [](std::size_t i) { return "</p" + std::to_string(i) + "> has no mass"; });
  EXPECT_EQ(lines(list).size(), 1u);
}

TEST(DiagnosticLines, FewStayAsTheyAre) {
  EXPECT_EQ(lines(warnings(3, [](std::size_t) { return "same"; })).size(), 3u);
  EXPECT_EQ(
      lines(warnings(3, [](std::size_t i) { return "no file \"" + std::to_string(i) + "\""; }))
          .size(),
      3u);
}

TEST(DiagnosticLines, OfAKindTheFirstStandForAll) {
  const auto list = warnings(
      500, [](std::size_t i) { return "joint \"j" + std::to_string(i) + "\" is skipped"; });
  ASSERT_EQ(lines(list).size(), kShownOfAKind);
  EXPECT_NE(lines(list).back().find("and 497 more like it"), std::string::npos);
}

TEST(DiagnosticLines, NumbersDoNotMakeAKind) {
  const std::vector<std::string> limits = {"-174 and -8.7", "31.2 and 259", "0 and 1e-05",
                                           "2 and 3"};
  const auto list = warnings(
      4, [&](std::size_t i) { return "the target 0 is outside of the limits " + limits[i]; });
  ASSERT_EQ(lines(list).size(), kShownOfAKind);
  EXPECT_NE(lines(list).back().find("and 1 more like it"), std::string::npos);
}

TEST(DiagnosticLines, NothingActsOnATerminalButColours) {
  Diagnostic d;
  d.message = "evil \033]0;title\a\nnext";
  EXPECT_EQ(diagnostic_line(d, true), "\033[31merror:\033[0m evil \\x1b]0;title\\x07\\x0anext");
}

}  // namespace
}  // namespace tenon::cli
