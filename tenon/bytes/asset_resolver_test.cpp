// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/bytes/asset_resolver.h"

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include "tenon/bytes/write/atomic_write.h"
#include "tenon/bytes/zip/zip_archive.h"

namespace tenon::bytes {
namespace {

/// A folder with some files, removed at the end.
class AssetResolverTest : public testing::Test {
 protected:
  AssetResolverTest() {
    std::string name = testing::TempDir() + "/resolver.XXXXXX";
    folder_ = std::filesystem::canonical(::mkdtemp(name.data())).string();
    for (const char* file : {"root.usda", "x.usda", "sub/x.usda", "sub/y.usda", "lib/z.usda"}) {
      put(file, "#usda 1.0\n");
    }
    const std::string inner = *write_zip({{"in.usda", "#usda 1.0\n"}});
    put("p.usdz", *write_zip({{"top/root.usda", "#usda 1.0\n"},
                              {"top/part.usda", "#usda 1.0\n"},
                              {"top/deep/in.usda", "#usda 1.0\n"},
                              {"tex.png", "PNG"},
                              {"nest.usdz", inner}}));
  }
  ~AssetResolverTest() override { std::filesystem::remove_all(folder_); }

  void put(const std::string& name, const std::string& contents) const {
    const std::filesystem::path path = folder_ + "/" + name;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << contents;
  }
  std::string in(const std::string& name) const { return folder_ + "/" + name; }

  std::string folder_;
};

TEST_F(AssetResolverTest, FollowsTheRulesOfOpenUsd) {
  const AssetResolver resolver({{folder_ + "/lib"}, {}});
  struct Case {
    const char* asset_path;
    const char* anchor;
    const char* expected;  // "" for not found
  };
  const Case cases[] = {
      {"./x.usda", "root.usda", "x.usda"},
      {"x.usda", "root.usda", "x.usda"},
      {"x.usda", "sub/y.usda", "sub/x.usda"},
      {"./x.usda", "sub/y.usda", "sub/x.usda"},
      {"../x.usda", "sub/y.usda", "x.usda"},
      {"z.usda", "sub/y.usda", "lib/z.usda"},
      {"./z.usda", "sub/y.usda", ""},
      {"sub/../x.usda", "root.usda", "x.usda"},
      {"missing.usda", "root.usda", ""},
      {"sub", "root.usda", ""},
      {"p.usdz", "root.usda", "p.usdz"},
      {"./p.usdz[tex.png]", "root.usda", "p.usdz[tex.png]"},
      {"./p.usdz[none.png]", "root.usda", ""},
      {"./part.usda", "p.usdz", "p.usdz[top/part.usda]"},
      {"part.usda", "p.usdz[top/root.usda]", "p.usdz[top/part.usda]"},
      {"../tex.png", "p.usdz[top/root.usda]", "p.usdz[tex.png]"},
      {"part.usda", "p.usdz[top/deep/in.usda]", "p.usdz[top/part.usda]"},
      {"./part.usda", "p.usdz[top/deep/in.usda]", ""},
      {"tex.png", "p.usdz[top/root.usda]", ""},
      {"z.usda", "p.usdz[top/root.usda]", "lib/z.usda"},
      {"./tex.png", "p.usdz[top/root.usda]", ""},
      {"../../x.usda", "p.usdz[top/root.usda]", ""},
      {"x.usda", "p.usdz[top/root.usda]", ""},
      {"../nest.usdz[in.usda]", "p.usdz[top/root.usda]", "p.usdz[nest.usdz[in.usda]]"},
      {"./in.usda", "p.usdz[nest.usdz]", "p.usdz[nest.usdz[in.usda]]"},
      {"./in.usda", "p.usdz[nest.usdz[in.usda]]", "p.usdz[nest.usdz[in.usda]]"},
  };
  for (const Case& c : cases) {
    const auto found = resolver.resolve(c.asset_path, in(c.anchor));
    const std::string expected = *c.expected == '\0' ? "" : in(c.expected);
    EXPECT_EQ(found ? *found : "", expected) << c.asset_path << " in " << c.anchor;
  }
}

TEST_F(AssetResolverTest, OpensFilesInPackages) {
  const AssetResolver resolver;
  EXPECT_EQ((*resolver.open(in("p.usdz[tex.png]")))->text(), "PNG");
  EXPECT_EQ((*resolver.open(in("p.usdz[nest.usdz[in.usda]]")))->text(), "#usda 1.0\n");
  EXPECT_EQ(resolver.open(in("p.usdz[no]")).error().code(), ErrorCode::NotFound);
  EXPECT_EQ(resolver.open(in("none.usda")).error().code(), ErrorCode::NotFound);
  EXPECT_FALSE(resolver.open(in("x.usda[y]")));
}

TEST_F(AssetResolverTest, StaysInsideTheAllowedFolders) {
  const AssetResolver resolver({{}, {folder_ + "/sub"}});
  EXPECT_TRUE(resolver.resolve("./x.usda", in("sub/y.usda")));
  EXPECT_FALSE(resolver.resolve("../x.usda", in("sub/y.usda")));
  std::filesystem::create_symlink(in("x.usda"), in("sub/link.usda"));
  EXPECT_FALSE(resolver.resolve("./link.usda", in("sub/y.usda")));
  EXPECT_FALSE(resolver.open(in("x.usda")));
}

TEST_F(AssetResolverTest, RulesAreAskedAboutTheFileThatIsOpen) {
  std::filesystem::create_symlink(in("x.usda"), in("sub/other.usda"));
  std::string asked;
  FileRules rules;
  rules.check = [&](const std::string& real) {
    asked = real;
    return real.find("/sub/") == std::string::npos ? Result<void>(Error(ErrorCode::NotFound, "no"))
                                                   : Result<void>();
  };
  EXPECT_FALSE(FileBytes::open(in("sub/other.usda"), rules));
  EXPECT_EQ(asked, std::filesystem::canonical(in("x.usda")).string());
  EXPECT_TRUE(FileBytes::open(in("sub/x.usda"), rules));
}

TEST_F(AssetResolverTest, PipesAreNoFilesAndHoldNobodyUp) {
  ASSERT_EQ(::mkfifo(in("pipe.usda").c_str(), 0600), 0);
  EXPECT_EQ(FileBytes::open(in("pipe.usda")).error().code(), ErrorCode::Io);
}

TEST_F(AssetResolverTest, FilesThatMayNotBeMappedAreCopies) {
  put("large.usda", std::string(200'000, 'a'));
  FileRules rules;
  rules.may_map = false;
  const auto bytes = FileBytes::open(in("large.usda"), rules);
  ASSERT_TRUE(bytes);
  std::filesystem::resize_file(in("large.usda"), 10);
  EXPECT_EQ((*bytes)->text(), std::string(200'000, 'a'));
}

TEST_F(AssetResolverTest, TakesWhatStandsAroundNamesAway) {
  EXPECT_EQ(plain_asset_path("a.usda:SDF_FORMAT_ARGS:target=x"), "a.usda");
  EXPECT_EQ(plain_asset_path("file:///a/b%20c.usda"), "/a/b c.usda");
  EXPECT_EQ(plain_asset_path("file:"
                             "//localhost/a.usda"),
            "/a.usda");
  EXPECT_EQ(plain_asset_path("file:/a.usda"), "/a.usda");
  EXPECT_EQ(plain_asset_path("100%.usda"), "100%.usda");
  const AssetResolver resolver;
  EXPECT_EQ(*resolver.resolve("file://" + in("x.usda"), ""), in("x.usda"));
  EXPECT_EQ(*resolver.resolve("./x.usda:SDF_FORMAT_ARGS:a=b", in("root.usda")), in("x.usda"));
}

TEST_F(AssetResolverTest, SandboxHoldsForPackagesUrisAndSearchPaths) {
  const AssetResolver resolver({{folder_ + "/lib"}, {folder_ + "/sub"}});
  const std::string anchor = in("sub/y.usda");
  const std::vector<std::string> outside = {
      in("p.usdz"), in("p.usdz[tex.png]"), "../p.usdz[tex.png]", "file://" + in("x.usda"),
      "z.usda",     "../sub/../x.usda"};
  for (const std::string& path : outside) {
    const auto found = resolver.resolve(path, anchor);
    ASSERT_FALSE(found) << path;
    EXPECT_EQ(found.error().diagnostic().rule, "layer.outside") << path;
  }
  EXPECT_FALSE(resolver.open(in("p.usdz[tex.png]")));
  std::filesystem::create_directory_symlink(folder_ + "/lib", in("sub/lib"));
  EXPECT_FALSE(resolver.resolve("./lib/z.usda", anchor));
  EXPECT_TRUE(resolver.resolve("./x.usda", anchor));
}

TEST_F(AssetResolverTest, WritesInOneStepAndKeepsPermissions) {
  using std::filesystem::perms;
  const std::string file = in("sub/x.usda");
  std::filesystem::permissions(file, perms::owner_read | perms::owner_write);
  std::filesystem::create_symlink(file, in("link"));
  ASSERT_TRUE(write_file(in("link"), "new"));
  EXPECT_TRUE(std::filesystem::is_symlink(in("link")));
  EXPECT_EQ((*FileBytes::open(file))->text(), "new");
  EXPECT_EQ(std::filesystem::status(file).permissions(), perms::owner_read | perms::owner_write);
  EXPECT_EQ(write_file(in("nowhere/x.usda"), "x").error().code(), ErrorCode::Io);
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(in("sub"))) {
    files += entry.is_regular_file() ? 1 : 0;
  }
  EXPECT_EQ(files, 2u) << "no temporary file is left";
}

TEST_F(AssetResolverTest, MapsLargeFiles) {
  put("large", std::string(200'000, 'x') + "end");
  const auto bytes = FileBytes::open(in("large"));
  ASSERT_TRUE(bytes);
  ASSERT_EQ((*bytes)->size(), 200'003u);
  const auto tail = FileBytes::slice(*bytes, 200'000, 3);
  EXPECT_EQ(tail->text(), "end");
  EXPECT_EQ(FileBytes::open(folder_).error().code(), ErrorCode::Io);
}

/// Pages of files that this process holds in memory.
std::size_t file_pages() {
  std::size_t all = 0;
  std::size_t resident = 0;
  std::size_t of_files = 0;
  std::ifstream("/proc/self/statm") >> all >> resident >> of_files;
  return of_files;
}

TEST_F(AssetResolverTest, LetsGoOfPartsThatAreMapped) {
  const std::string contents = std::string(4'000'001, 'x') + std::string(4'000'000, 'y');
  put("large", contents);
  const auto bytes = FileBytes::open(in("large"));
  ASSERT_TRUE(bytes);
  EXPECT_EQ((*bytes)->text(), contents);
  const std::size_t before = file_pages();
  FileBytes::slice(*bytes, 4'000'001, 4'000'000)->let_go((*bytes)->span().subspan(4'000'001));
  const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  EXPECT_LE(file_pages() + 3'000'000 / page, before);
  (*bytes)->let_go((*bytes)->span().first(0));
  (*bytes)->let_go((*bytes)->span().subspan(1, 10));
  EXPECT_EQ((*bytes)->text(), contents);
  const auto own = FileBytes::own(contents);
  own->let_go(own->span());
  EXPECT_EQ(own->text(), contents);
}

}  // namespace
}  // namespace tenon::bytes
