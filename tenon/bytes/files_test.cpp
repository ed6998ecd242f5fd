// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/bytes/files.h"

#include <filesystem>

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "tenon/bytes/asset_resolver.h"
#include "tenon/bytes/asset_roots.h"
#include "tenon/bytes/read_policy.h"
#include "tenon/bytes/read_record.h"
#include "tenon/bytes/write/atomic_write.h"
#include "tenon/bytes/zip/zip_archive.h"

namespace tenon::bytes {
namespace {

namespace fs = std::filesystem;

std::shared_ptr<const FileBytes> text(std::string contents) {
  return FileBytes::own(std::move(contents));
}

std::string read(const Files& files, const std::string& path) {
  const auto bytes = files->open(path, {});
  return bytes ? std::string((*bytes)->text()) : "(" + bytes.error().diagnostic().rule + ")";
}

/// "a/ b *c" for a folder with a folder, a file and something else.
std::string listed(const Files& files, const std::string& folder) {
  const auto entries = files->list(folder);
  if (!entries) {
    return "(none)";
  }
  std::string result;
  for (const FolderEntry& entry : *entries) {
    result += result.empty() ? "" : " ";
    result += entry.kind == NameKind::Folder ? entry.name + "/"
              : entry.kind == NameKind::File ? entry.name
                                             : "*" + entry.name;
  }
  return result;
}

/// A source of one's own: names in capitals mean the same as in small letters.
class FilesOfAnyCase : public FileSource {
 public:
  explicit FilesOfAnyCase(Files small) : small_(std::move(small)) {}

  NameKind kind(const std::string& path) const override { return small_->kind(small(path)); }
  std::string real_path(const std::string& path) const override {
    return small_->real_path(small(path));
  }
  Result<std::shared_ptr<const FileBytes>> open(const std::string& path,
                                                const FileRules& rules) const override {
    return small_->open(small(path), rules);
  }
  Result<std::vector<FolderEntry>> list(const std::string& folder) const override {
    return small_->list(small(folder));
  }
  bool is_on_disk(const std::string&) const override { return false; }

 private:
  static std::string small(std::string path) {
    for (char& c : path) {
      c = c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
    }
    return path;
  }

  Files small_;
};

/// A folder on the disk with one folder in it, links to both and a pipe.
class FilesTest : public testing::Test {
 protected:
  void SetUp() override {
    root_ = fs::canonical(testing::TempDir()) / ("files_" + std::to_string(::getpid()));
    fs::remove_all(root_);
    fs::create_directories(root_ / "real/deep");
    for (const char* name : {"real/a.usda", "real/deep/b.usda"}) {
      ASSERT_TRUE(write_file(at(name), name));
    }
    fs::create_symlink(at("real"), at("link"));
    fs::create_symlink(at("real/a.usda"), at("a_link.usda"));
    ASSERT_EQ(::mkfifo(at("pipe").c_str(), 0600), 0);
  }
  void TearDown() override { fs::remove_all(root_); }
  std::string at(const std::string& name) const { return (root_ / name).string(); }

  fs::path root_;
};

TEST_F(FilesTest, TheDiskIsTheDefault) {
  const Files disk;
  EXPECT_EQ(disk->kind(at("real/a.usda")), NameKind::File);
  EXPECT_EQ(disk->kind(at("link")), NameKind::Folder);
  EXPECT_EQ(disk->kind(at("pipe")), NameKind::Other);
  EXPECT_EQ(disk->kind(at("none")), NameKind::Nothing);
  EXPECT_EQ(disk->real_path(at("link/deep/../a.usda")), at("real/a.usda"));
  EXPECT_EQ(disk->real_path(at("link/none/x")), at("real/none/x"));
  EXPECT_EQ(read(disk, at("link/a.usda")), "real/a.usda");
  EXPECT_EQ(read(disk, at("none")), "(file.not-found)");
  EXPECT_EQ(read(disk, at("pipe")), "(file.unreadable)");
  EXPECT_EQ(listed(disk, at("")), "a_link.usda *link *pipe real/");
  EXPECT_EQ(disk->list(at("none")).error().code(), ErrorCode::NotFound);
  EXPECT_EQ(disk->list(at("real/a.usda")).error().code(), ErrorCode::Io);
  EXPECT_EQ(*files_below(disk, at("real")),
            (std::vector<std::string>{at("real/a.usda"), at("real/deep/b.usda")}));
  EXPECT_TRUE(check_on_disk(disk, at("real/a.usda")));
}

TEST_F(FilesTest, AFolderOfLinksToItselfEndsTheWalk) {
  fs::create_symlink(at("real"), at("real/deep/up"));
  EXPECT_EQ(files_below(Files(), at("real"))->size(), 2u);
}

TEST_F(FilesTest, AFileThatGetsShorterIsNotReadInPart) {
  const std::string shorter = "/sys/kernel/mm/transparent_hugepage/enabled";  // says 4,096 bytes
  std::error_code error;
  if (fs::file_size(shorter, error) < 4096 || error) {
    GTEST_SKIP() << "no sysfs";
  }
  EXPECT_EQ(read(Files(), shorter), "(file.unreadable)");
}

TEST_F(FilesTest, MemoryHoldsFilesInFolders) {
  const Files files = Files::in_memory({{"/r/a.usda", text("A")},
                                        {"/r/deep/../deep/b.usda", text("B")},
                                        {"/r/deep.usda", text("C")}});
  EXPECT_EQ(files->kind("/r/a.usda"), NameKind::File);
  EXPECT_EQ(files->kind("/r/./deep/../a.usda"), NameKind::File);
  EXPECT_EQ(files->kind("/r/deep"), NameKind::Folder);
  EXPECT_EQ(files->kind("/r/deep/"), NameKind::Folder);
  EXPECT_EQ(files->kind("/"), NameKind::Folder);
  EXPECT_EQ(files->kind("/r/dee"), NameKind::Nothing);
  EXPECT_EQ(files->real_path("/r/deep/../x"), "/r/x");
  EXPECT_EQ(read(files, "/r/deep/b.usda"), "B");
  EXPECT_EQ(read(files, "/r/deep"), "(file.not-found)");
  EXPECT_EQ(listed(files, "/r"), "a.usda deep/ deep.usda");
  EXPECT_EQ(listed(files, "/"), "r/");
  EXPECT_EQ(files->list("/none").error().code(), ErrorCode::NotFound);
  EXPECT_EQ(*files_below(files, "/"),
            (std::vector<std::string>{"/r/a.usda", "/r/deep.usda", "/r/deep/b.usda"}));
  EXPECT_EQ(check_on_disk(files, "/r/a.usda").error().diagnostic().rule, "file.not-on-disk");
}

TEST_F(FilesTest, MemoryNeverFallsThroughToTheDisk) {
  const Files files = Files::in_memory({{at("real/other.usda"), text("O")}});
  for (const std::string& name : {at("real/a.usda"), at("link/a.usda"), at("a_link.usda")}) {
    ASSERT_EQ(Files()->kind(name), NameKind::File);
    EXPECT_EQ(files->kind(name), NameKind::Nothing) << name;
    EXPECT_EQ(read(files, name), "(file.not-found)") << name;
    EXPECT_EQ(files->real_path(name), name) << "no link of the disk is followed";
    EXPECT_FALSE(AssetResolver({{at("real")}, {}, files}).resolve(name, "")) << name;
    EXPECT_FALSE(open_identifier(files, name)) << name;
    EXPECT_FALSE(ReadPolicy({"/"}, files).open(name)) << name;
  }
  EXPECT_EQ(listed(files, at("real")), "other.usda");
  EXPECT_FALSE(AssetResolver({{at("real")}, {}, files}).resolve("a.usda", ""));
  EXPECT_TRUE(AssetResolver({{at("real")}, {}, files}).resolve("other.usda", ""));
  EXPECT_TRUE(ReadPolicy({at("real/deep")}, files).roots().empty()) << "no folder of the memory";
  ASSERT_TRUE(write_file(at("package.xml"), "<package format=\"2\"/>"));
  EXPECT_EQ(ros_package_of(files, at("real")), std::nullopt);
}

TEST_F(FilesTest, UnsavedTextWinsUnderEveryNameOfItsFile) {
  const Files files =
      Files().with({{at("link/a.usda"), text("unsaved")}, {at("real/new/n.usda"), text("new")}});
  for (const char* name : {"real/a.usda", "link/a.usda", "a_link.usda", "real/deep/../a.usda"}) {
    EXPECT_EQ(read(files, at(name)), "unsaved") << name;
    EXPECT_FALSE(check_on_disk(files, at(name))) << name;
  }
  EXPECT_EQ(read(files, at("real/deep/b.usda")), "real/deep/b.usda");
  EXPECT_TRUE(check_on_disk(files, at("real/deep/b.usda")));
  EXPECT_EQ(files->kind(at("link/new")), NameKind::Folder);
  EXPECT_EQ(read(files, at("link/new/n.usda")), "new");
  EXPECT_EQ(listed(files, at("link")), "a.usda deep/ new/");
  EXPECT_EQ(read(Files(), at("real/a.usda")), "real/a.usda") << "the disk is as it was";
}

TEST_F(FilesTest, UnsavedTextOverUnsavedText) {
  const Files memory = Files::in_memory({{"/a", text("1")}, {"/b", text("1")}});
  const Files twice = memory.with({{"/a", text("2")}}).with({{"/c", text("3")}});
  EXPECT_EQ(read(twice, "/a") + read(twice, "/b") + read(twice, "/c"), "213");
  EXPECT_EQ(read(memory, "/a") + read(memory, "/c"), "1(file.not-found)");
}

TEST_F(FilesTest, ASourceOfOnesOwnIsAskedInThePlaceOfTheDisk) {
  const Files files(std::make_shared<const FilesOfAnyCase>(
      Files::in_memory({{"/r/a.usda", text("A")}, {"/s/b.usda", text("B")}})));
  const AssetResolver resolver({{}, {"/R"}, files});
  EXPECT_EQ(*resolver.resolve("./A.usda", "/r/root.usda"), "/r/A.usda");
  EXPECT_EQ((*resolver.open("/R/A.USDA"))->text(), "A");
  EXPECT_EQ(resolver.open("/S/B.usda").error().diagnostic().rule, "layer.outside");
  EXPECT_EQ(read(files.with({{"/R/A.usda", text("unsaved")}}), "/r/a.USDA"), "unsaved");
  EXPECT_EQ(files_below(files, "/R")->size(), 1u);
}

TEST_F(FilesTest, RulesHoldForWhatIsInMemoryToo) {
  const Files files = Files::in_memory({{"/r/a", text("12345")}});
  FileRules rules;
  rules.max_bytes = 4;
  EXPECT_EQ(files->open("/r/a", rules).error().code(), ErrorCode::Limit);
  rules.max_bytes = 5;
  rules.check = [](const std::string& real) -> Result<void> {
    return Error(ErrorCode::Invalid, real);
  };
  EXPECT_EQ(files->open("/r/../r/a", rules).error().diagnostic().message, "/r/a");
}

TEST_F(FilesTest, WhatIsInMemoryIsNoInputOnTheDisk) {
  ReadRecord record;
  record.install();
  ASSERT_EQ(read(Files().with({{at("real/a.usda"), text("unsaved")}}), at("real/a.usda")),
            "unsaved");
  EXPECT_FALSE(record.has(stamp_of(at("real/a.usda"))->identity));
  ASSERT_EQ(read(Files(), at("real/a.usda")), "real/a.usda");
  EXPECT_TRUE(record.has(stamp_of(at("real/a.usda"))->identity));
}

TEST_F(FilesTest, PackagesAndSandboxesWorkInMemory) {
  const Files files =
      Files::in_memory({{"/r/p.usdz", text(*write_zip({{"root.usda", "R"}, {"t/x.png", "X"}}))},
                        {"/r/a.usda", text("A")},
                        {"/s/b.usda", text("B")}});
  const AssetResolver resolver({{}, {"/r"}, files});
  EXPECT_EQ((*resolver.open("/r/p.usdz[t/x.png]"))->text(), "X");
  EXPECT_EQ(*resolver.resolve("t/x.png", "/r/p.usdz"), "/r/p.usdz[t/x.png]");
  EXPECT_EQ(*resolver.resolve("a.usda", "/r/b.usda"), "/r/a.usda");
  EXPECT_EQ(resolver.resolve("../s/b.usda", "/r/a.usda").error().diagnostic().rule,
            "layer.outside");
  EXPECT_FALSE(ReadPolicy({"/r"}, files).open("/s/b.usda"));
  EXPECT_EQ(roots_of_asset(files, "/r/payloads/x.usda"),
            (std::vector<std::string>{"/r/payloads", "/r"}));
}

}  // namespace
}  // namespace tenon::bytes
