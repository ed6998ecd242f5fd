// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A power cut between any two steps of a transaction, as a model: of the names that a folder got or
// lost since it was synced, any may have reached the disk, in any combination. After the next
// transaction has followed the journal, files are all old or all new.
#include <functional>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tenon/bytes/write/edit_journal.h"

namespace tenon::bytes {
namespace {

using Kind = CommitStep::Kind;
using Names = std::map<std::string, std::string>;  // path, contents

std::string folder_above(const std::string& path) { return path.substr(0, path.rfind('/')); }

void take(const CommitStep& step, Names& names) {
  switch (step.kind) {
    case Kind::Link:
      names[step.to] = step.from;
      break;
    case Kind::Rename:
      if (names.contains(step.from)) {
        names[step.to] = names[step.from];
        names.erase(step.from);
      }
      break;
    case Kind::Remove:
      names.erase(step.to);
      break;
    case Kind::Sync:
      break;
  }
}

const std::vector<CommitStep> kHiddenNames{{Kind::Link, "new a", "/h/a/.tenon-1"},
                                           {Kind::Link, "new b", "/h/b/.tenon-2"}};
const std::vector<CommitStep> kRenames{{Kind::Rename, "/h/a/.tenon-1", "/h/a/one"},
                                       {Kind::Rename, "/h/b/.tenon-2", "/h/b/two"},
                                       {Kind::Remove, "", "/h/a/three"}};
const CommitStep kJournal{Kind::Link, "journal", "/h/.tenon-journal"};
const Names kOldNames{{"/h/a/one", "old a"}, {"/h/b/two", "old b"}, {"/h/a/three", "old c"}};
const Names kNewNames{{"/h/a/one", "new a"}, {"/h/b/two", "new b"}};

/// The files after the next transaction, without hidden names.
Names recovered(Names names) {
  if (names.contains(kJournal.to)) {
    for (const CommitStep& step : kRenames) {
      take(step, names);
    }
  }
  std::erase_if(names, [](const auto& name) { return name.first.find("/.") != std::string::npos; });
  return names;
}

/// Calls `see` with every state that a power cut may leave.
void each_state(const std::vector<CommitStep>& steps, const std::function<void(Names)>& see) {
  Names durable = kOldNames;
  std::vector<CommitStep> pending;
  for (std::size_t done = 0; done <= steps.size(); ++done) {
    for (std::size_t kept = 0; kept < std::size_t{1} << pending.size(); ++kept) {
      Names names = durable;
      for (std::size_t i = 0; i < pending.size(); ++i) {
        if ((kept >> i & 1u) != 0) {
          take(pending[i], names);
        }
      }
      see(names);
    }
    if (done == steps.size()) {
      break;
    }
    const CommitStep& step = steps[done];
    if (step.kind != Kind::Sync) {
      pending.push_back(step);
      continue;
    }
    std::erase_if(pending, [&](const CommitStep& before) {
      const bool reaches = folder_above(before.to) == step.to;
      if (reaches) {
        take(before, durable);
      }
      return reaches;
    });
  }
}

std::size_t mixed_states(const std::vector<CommitStep>& steps, std::size_t& states) {
  std::size_t mixed = 0;
  each_state(steps, [&](const Names& names) {
    const Names seen = recovered(names);
    mixed += seen != kOldNames && seen != kNewNames ? 1 : 0;
    ++states;
  });
  return mixed;
}

TEST(PowerCut, FilesAreAllOldOrAllNew) {
  const CommitPlan plan = ordered_with_journal(kHiddenNames, kJournal, "/h", kRenames, {});
  std::vector<CommitStep> steps = plan.before;
  steps.insert(steps.end(), plan.changes.begin(), plan.changes.end());
  std::size_t states = 0;
  EXPECT_EQ(mixed_states(steps, states), 0u);
  EXPECT_GT(states, 30u);
  Names end = kOldNames;
  for (const CommitStep& step : steps) {
    take(step, end);
  }
  EXPECT_EQ(end, kNewNames);
}

// Each sync is needed: without one, some state is neither.
TEST(PowerCut, NoSyncMayBeLeftOut) {
  const CommitPlan plan = ordered_with_journal(kHiddenNames, kJournal, "/h", kRenames, {});
  std::vector<CommitStep> steps = plan.before;
  steps.insert(steps.end(), plan.changes.begin(), plan.changes.end());
  for (std::size_t i = 0; i + 1 < steps.size(); ++i) {  // the last one hastens the end only
    if (steps[i].kind == Kind::Sync) {
      std::vector<CommitStep> fewer = steps;
      fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
      std::size_t states = 0;
      EXPECT_GT(mixed_states(fewer, states), 0u) << i << " " << steps[i].to;
    }
  }
}

TEST(PowerCut, FoldersThatAreNewAreSyncedInThoseAbove) {
  const CommitPlan plan =
      ordered_with_journal(kHiddenNames, kJournal, "/h", kRenames, {"/h/a", "/h/b"});
  bool synced = false;
  for (const CommitStep& step : plan.before) {
    if (step.to == kJournal.to) {
      break;
    }
    synced = synced || (step.kind == Kind::Sync && step.to == "/h");
  }
  EXPECT_TRUE(synced);
}

}  // namespace
}  // namespace tenon::bytes
