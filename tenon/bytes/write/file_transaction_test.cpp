// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/bytes/write/file_transaction.h"

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <string>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "tenon/bytes/file_bytes.h"
#include "tenon/bytes/posix_files.h"
#include "tenon/bytes/read_record.h"
#include "tenon/bytes/write/edit_journal.h"
#include "tenon/bytes/write/folder_lock.h"
#include "tenon/bytes/write/killed_child.h"

namespace tenon::bytes {
namespace {

namespace fs = std::filesystem;
using Files = std::map<std::string, std::string>;

const Files kOld{{"hand.usda", "old"},
                 {"payloads/base.usda", "base"},
                 {"payloads/Physics/physics.usda", "old physics"},
                 {"payloads/Physics/physx.usda", "old physx"}};
const Files kChanges{{"payloads/Physics/physics.usda", "new physics"},
                     {"payloads/Physics/physx.usda", std::string(100000, 'x')}};

Files changed(Files files, const Files& changes) {
  for (const auto& [name, contents] : changes) {
    files[name] = contents;
  }
  return files;
}

class Transaction : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "tenon_transaction_XXXXXX").string();
    ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
    root_ = fs::canonical(pattern).string();
    put(kOld);
  }
  void TearDown() override { fs::remove_all(root_); }

  std::string at(const std::string& name) const { return root_ + "/" + name; }

  void put(const Files& files) const {
    for (const auto& [name, contents] : files) {
      fs::create_directories(fs::path(at(name)).parent_path());
      std::ofstream(at(name), std::ios::binary) << contents;
    }
  }

  /// What other programs look at: all but hidden folders, which a kill may leave.
  Files read() const {
    Files files;
    for (fs::recursive_directory_iterator entry(root_), end; entry != end; ++entry) {
      if (entry->path().filename().string().starts_with(".tenon-")) {
        entry.disable_recursion_pending();
      } else if (entry->is_regular_file()) {
        std::ifstream stream(entry->path(), std::ios::binary);
        files[entry->path().lexically_relative(root_).generic_string()] =
            std::string(std::istreambuf_iterator<char>(stream), {});
      }
    }
    return files;
  }

  Result<void> replace(const Files& changes, const CommitOptions& options = {}) const {
    FileTransaction transaction;
    for (const auto& [name, contents] : changes) {
      transaction.put(at(name), contents);
    }
    return transaction.commit(options);
  }

  /// What readers and the next writer wait for: that nobody is at work.
  void wait() const {
    std::set<std::string> folders{root_};
    for (const auto& entry : fs::recursive_directory_iterator(root_)) {
      if (entry.is_directory()) {
        folders.insert(entry.path().string());
      }
    }
    ASSERT_TRUE(FolderLock::take(folders).has_value());
  }

  std::string root_;
};

TEST_F(Transaction, ChangesThoseFilesAndNoOthers) {
  fs::create_symlink("../../hand.usda", at("payloads/Physics/link.usda"));
  ::chmod(at("payloads/Physics/physx.usda").c_str(), 0640);
  ::chmod(at("payloads/Physics").c_str(), 0750);
  const Files before = read();
  ASSERT_TRUE(replace(kChanges).has_value());
  EXPECT_EQ(read(), changed(before, kChanges));
  EXPECT_EQ(fs::read_symlink(at("payloads/Physics/link.usda")), "../../hand.usda");
  EXPECT_EQ(static_cast<unsigned>(fs::status(at("payloads/Physics/physx.usda")).permissions()),
            0640u);
  EXPECT_EQ(static_cast<unsigned>(fs::status(at("payloads/Physics")).permissions()), 0750u);
  EXPECT_EQ(std::distance(fs::directory_iterator(at("payloads")), fs::directory_iterator()), 2);
}

TEST_F(Transaction, AFileWithoutAFolderLeavesTheOthers) {
  Files more = kChanges;
  more["payloads/none/none.usda"] = "new";
  EXPECT_FALSE(replace(more).has_value());
  EXPECT_EQ(read(), kOld);
  ASSERT_TRUE(replace(more, {.make_folders = true}).has_value());
  EXPECT_EQ(read(), changed(kOld, more));
}

TEST_F(Transaction, FoldersMadeForNothingGo) {
  Files more = kChanges;
  more["new/one.usda"] = "new";
  const CommitOptions refuse{.make_folders = true,
                             .check = []() -> Result<void> { return Error(ErrorCode::Io, "no"); }};
  EXPECT_FALSE(replace(more, refuse).has_value());
  EXPECT_FALSE(fs::exists(at("new")));
  EXPECT_EQ(read(), kOld);
}

TEST_F(Transaction, RemovesFilesAndFoldersThatAreEmptyThen) {
  FileTransaction transaction;
  transaction.put(at("hand.usda"), "new");
  transaction.remove(at("payloads/Physics/physics.usda"), root_);
  transaction.remove(at("payloads/Physics/physx.usda"), root_);
  transaction.remove(at("payloads/not_there.usda"), root_);
  ASSERT_TRUE(transaction.commit().has_value());
  EXPECT_EQ(read(), (Files{{"hand.usda", "new"}, {"payloads/base.usda", "base"}}));
  EXPECT_FALSE(fs::exists(at("payloads/Physics")));
}

TEST_F(Transaction, TheFoldersStayTheSame) {
  const auto before = stamp_of(root_);
  ASSERT_TRUE(replace(kChanges).has_value());
  EXPECT_EQ(stamp_of(root_)->identity, before->identity);
  EXPECT_EQ(std::distance(fs::directory_iterator(root_), fs::directory_iterator()), 2)
      << "no journal is left";
}

TEST_F(Transaction, OnePlaceTwiceIsRefusedByAnyOfItsNames) {
  fs::create_symlink("payloads", at("link"));
  fs::create_hard_link(at("hand.usda"), at("same.usda"));
  const std::string unseen = at("payloads/new.usda");
  for (const auto& [a, b] :
       std::map<std::string, std::string>{{at("hand.usda"), at("payloads/../hand.usda")},
                                          {at("payloads/base.usda"), at("link/base.usda")},
                                          {at("hand.usda") + "", at("same.usda")},
                                          {unseen, at("link/new.usda")}}) {
    FileTransaction transaction;
    transaction.put(a, "one");
    transaction.put(b, "two");
    const auto done = transaction.commit();
    ASSERT_FALSE(done.has_value()) << b;
    EXPECT_EQ(done.error().diagnostic().rule, "output.twice");
  }
}

TEST_F(Transaction, WhatWasReadIsNotReplacedByAnyOfItsNames) {
  fs::create_symlink("payloads", at("link"));
  fs::create_symlink("hand.usda", at("other.usda"));
  fs::create_hard_link(at("hand.usda"), at("same.usda"));
  ReadRecord record;
  record.install();
  ASSERT_TRUE(FileBytes::open(at("hand.usda")).has_value());
  ASSERT_TRUE(FileBytes::open(at("link/base.usda")).has_value());
  for (const char* name : {"hand.usda", "payloads/../hand.usda", "other.usda", "same.usda",
                           "payloads/base.usda", "link/base.usda"}) {
    const auto done = replace({{name, "new"}});
    ASSERT_FALSE(done.has_value()) << name;
    EXPECT_EQ(done.error().diagnostic().rule, "output.is-input");
  }
  EXPECT_TRUE(replace({{"payloads/Physics/physx.usda", "new"}}).has_value());
  EXPECT_TRUE(replace({{"hand.usda", "new"}}, {.in_place = true}).has_value());
  EXPECT_TRUE(replace({{"hand.usda", "newer"}}, {.in_place = true}).has_value())
      << "what this program wrote itself is no surprise";
  EXPECT_FALSE(check_holds_no_input(root_).has_value());
  EXPECT_TRUE(check_holds_no_input(at("payloads/Physics")).has_value());
}

TEST_F(Transaction, WhatWasChangedMeanwhileIsNotReplaced) {
  ReadRecord record(ReadRecord::Digests::Yes);
  record.install();
  ASSERT_TRUE(FileBytes::open(at("hand.usda")).has_value());
  const auto times = fs::last_write_time(at("hand.usda"));
  std::ofstream(at("hand.usda"), std::ios::binary) << "odd";  // of the same size
  fs::last_write_time(at("hand.usda"), times);
  const auto done = replace({{"hand.usda", "new"}}, {.in_place = true});
  ASSERT_FALSE(done.has_value());
  EXPECT_TRUE(is_changed_meanwhile(done.error()));
  EXPECT_EQ(read().at("hand.usda"), "odd");
  record.clear();
  ASSERT_TRUE(FileBytes::open(at("hand.usda")).has_value());
  std::ofstream(at("hand.usda"), std::ios::binary) << "odd";  // written again, the same
  EXPECT_TRUE(replace({{"hand.usda", "new"}}, {.in_place = true}).has_value());
}

TEST_F(Transaction, TwoStatesOfOneFileInARunAreAChange) {
  ReadRecord record;
  record.install();
  ASSERT_TRUE(FileBytes::open(at("hand.usda")).has_value());
  std::ofstream(at("hand.usda"), std::ios::binary) << "longer than before";
  ASSERT_TRUE(FileBytes::open(at("hand.usda")).has_value());
  EXPECT_FALSE(replace({{"hand.usda", "new"}}, {.in_place = true}).has_value());
}

/// Writes a journal that this program might have written there; false where none is ever written.
bool write_journal(const std::string& folder, const std::vector<CommitStep>& steps) {
  const std::string path = folder + "/" + std::string(kJournalName);
  const int descriptor = ::open(path.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0666);
  const std::string birth = file_birth(descriptor);
  const int error = write_all(descriptor, journal_text(folder, birth, steps));
  ::close(descriptor);
  return error == 0 && !birth.empty();
}

/// The state after everything stops between two renames.
TEST_F(Transaction, TheNextOneFinishesWhatAnotherBegan) {
  put({{"payloads/Physics/.tenon-1-1", "late physics"}});
  if (!write_journal(
          root_, {{CommitStep::Kind::Rename, at(".tenon-1-0"), at("hand.usda")},  // done already
                  {CommitStep::Kind::Rename, at("payloads/Physics/.tenon-1-1"),
                   at("payloads/Physics/physics.usda")},
                  {CommitStep::Kind::Remove, "", at("payloads/base.usda")}})) {
    GTEST_SKIP() << "the file system keeps no times of birth";
  }
  ASSERT_TRUE(replace({{"payloads/Physics/physx.usda", "new"}}, {.in_place = true}).has_value());
  EXPECT_EQ(read(), (Files{{"hand.usda", "old"},
                           {"payloads/Physics/physics.usda", "late physics"},
                           {"payloads/Physics/physx.usda", "new"}}));
}

TEST_F(Transaction, AJournalOfAStrangerReachesNoFileOutside) {
  const std::string zero(1, '\0');
  fs::create_directory(at("inner"));
  fs::create_symlink("../payloads", at("inner/link"));
  for (const char* name : {"../hand.usda", "/etc/passwd", "link/base.usda", "a/../../hand.usda"}) {
    for (const std::string& from : {std::string(), std::string(".tenon-1-1")}) {
      put({{"inner/.tenon-1-1", "evil"}});
      const std::string path = at("inner/" + std::string(kJournalName));
      std::ofstream(path).close();
      const int descriptor = ::open(path.c_str(), O_WRONLY);
      const std::string text =
          journal_text(at("inner"), file_birth(descriptor), {}) + from + zero + name + zero;
      EXPECT_EQ(write_all(descriptor, text), 0);
      ::close(descriptor);
      ASSERT_TRUE(replace({{"inner/new.usda", "new"}}, {.in_place = true}).has_value()) << name;
      const Files after = read();
      EXPECT_EQ(after.at("hand.usda"), "old") << name;
      EXPECT_EQ(after.at("payloads/base.usda"), "base") << name;
    }
  }
}

/// An archive or a repository may bring a journal along, with a file to put in somebody's place.
TEST_F(Transaction, AJournalThatWasCopiedHereIsNotFollowed) {
  const std::vector<CommitStep> steps{
      {CommitStep::Kind::Rename, at(".tenon-1-1"), at("payloads/Physics/physics.usda")},
      {CommitStep::Kind::Remove, "", at("payloads/base.usda")}};
  put({{".tenon-1-1", "evil"}});
  write_journal(root_, steps);
  const std::string journal = at(std::string(kJournalName));
  fs::copy_file(journal, at("copy"));
  fs::rename(at("copy"), journal);
  ASSERT_TRUE(replace({{"payloads/Physics/physx.usda", "new"}}, {.in_place = true}).has_value());
  EXPECT_EQ(read().at("payloads/Physics/physics.usda"), kOld.at("payloads/Physics/physics.usda"));
  EXPECT_EQ(read().at("payloads/base.usda"), "base");
  EXPECT_FALSE(fs::exists(journal));
}

TEST_F(Transaction, DevicesAreWrittenToDirectly) {
  FileTransaction transaction;
  transaction.put("/dev/null", "one");
  transaction.put(at("hand.usda"), "new");
  EXPECT_TRUE(transaction.commit().has_value());
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  FileTransaction full;
  full.put("/dev/full", "one");
  full.put(at("hand.usda"), "newer");
  EXPECT_FALSE(full.commit().has_value());
  EXPECT_EQ(read().at("hand.usda"), "new") << "all or nothing";
}

TEST_F(Transaction, FollowsLinksToFilesElsewhere) {
  fs::create_directory(at("elsewhere"));
  fs::rename(at("payloads/base.usda"), at("elsewhere/base.usda"));
  fs::create_symlink("../elsewhere/base.usda", at("payloads/base.usda"));
  ASSERT_TRUE(replace({{"payloads/base.usda", "new"}, {"hand.usda", "new"}}).has_value());
  EXPECT_TRUE(fs::is_symlink(at("payloads/base.usda")));
  EXPECT_EQ(read().at("elsewhere/base.usda"), "new");
  EXPECT_EQ(read().at("hand.usda"), "new");
}

TEST_F(Transaction, AKillAtAnySystemCallLeavesTheOldOrTheNew) {
  int old_ones = 0;
  int new_ones = 0;
  const Files wanted = changed(kOld, kChanges);
  for (int call = 1;; ++call) {
    fs::remove_all(root_);
    put(kOld);
    const std::optional<bool> killed =
        killed_at(call, [&] { return replace(kChanges).has_value(); });
    if (!killed) {
      GTEST_SKIP() << "processes may not be traced here";
    }
    wait();
    const Files after = read();
    ASSERT_TRUE(after == kOld || after == wanted) << "killed at call " << call;
    ++(after == wanted ? new_ones : old_ones);
    if (!*killed) {
      EXPECT_EQ(after, wanted);
      break;
    }
    ASSERT_LT(call, 5000);
  }
  EXPECT_GT(old_ones, 15);
  EXPECT_GT(new_ones, 2);
}

TEST_F(Transaction, ARequestToEndLeavesNoHiddenNamesAndNoEmptyFolders) {
  constexpr const char* kNew = "made/here/new.usda";
  for (int call = 1;; ++call) {
    fs::remove_all(root_);
    put(kOld);
    const std::optional<bool> ended = killed_at(
        call,
        [&] {
          FileTransaction transaction;
          transaction.put(at(kNew), "new");
          return transaction.commit({.make_folders = true}).has_value();
        },
        SIGTERM);
    if (!ended) {
      GTEST_SKIP() << "processes may not be traced here";
    }
    ASSERT_EQ(fs::exists(at("made")), fs::exists(at(kNew))) << "at call " << call;
    for (fs::recursive_directory_iterator entry(root_), end; entry != end; ++entry) {
      ASSERT_FALSE(entry->path().filename().string().starts_with(".tenon-")) << "at call " << call;
    }
    if (!*ended) {
      break;
    }
    ASSERT_LT(call, 5000);
  }
}

}  // namespace
}  // namespace tenon::bytes
