// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// tenon_mutants: runs the program on damaged files of every format it reads, each in a process of
// its own, and judges what each run took, printed and left.
//   --program FILE           the program; needed
//   --seeds FOLDER...        whole files to damage; needed
//   --seed N                 1
//   --from I --count N       which mutants; 0 and 2000
//   --jobs J                 processes at once; 1
//   --sanitized              the program is built with sanitizers: 60 s, memory is not judged
//   --guarded-mb N           memory of the readers of foreign formats, by docs/limits.md; 1024
//   --findings FOLDER        keeps the files, the command line and the messages of each finding
//   --json FILE              also writes the counts
//   --formats NAME...        only those, of the names that the table of results has
//   --make I                 only writes the files of mutant I into the folder of findings
// Equal seeds and numbers give equal mutants. Exit 0: no finding; 1: findings; 2: usage.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include "fuzz/mutants/judge.h"
#include "fuzz/mutants/report.h"

namespace {

namespace fs = std::filesystem;
using namespace tenon::fuzz;  // NOLINT(google-build-using-namespace): a program of its own

struct Options {
  std::string program;
  std::vector<std::string> seeds;
  std::uint64_t seed = 1;
  std::uint64_t from = 0;
  std::uint64_t count = 2000;
  unsigned jobs = 1;
  bool sanitized = false;
  std::size_t guarded_mb = 1024;
  std::string findings = "findings";
  std::string json;
  std::vector<std::string> formats;
  bool only_make = false;
};

std::uint64_t number_of(const char* text) { return std::strtoull(text, nullptr, 10); }

/// False when a word is not understood.
bool take_option(Options& options, const std::string& name, const char* value) {
  if (name == "--program") {
    options.program = fs::absolute(value).string();
  } else if (name == "--seeds") {
    options.seeds.emplace_back(value);
  } else if (name == "--seed") {
    options.seed = number_of(value);
  } else if (name == "--from") {
    options.from = number_of(value);
  } else if (name == "--count") {
    options.count = number_of(value);
  } else if (name == "--jobs") {
    options.jobs = static_cast<unsigned>(number_of(value));
  } else if (name == "--guarded-mb") {
    options.guarded_mb = number_of(value);
  } else if (name == "--findings") {
    options.findings = fs::absolute(value).string();
  } else if (name == "--json") {
    options.json = value;
  } else if (name == "--formats") {
    options.formats.emplace_back(value);
  } else if (name == "--make") {
    options.only_make = true;
    options.from = number_of(value);
  } else {
    return false;
  }
  return true;
}

bool read_options(int argc, char** argv, Options& options) {
  std::string name;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--sanitized") == 0) {
      options.sanitized = true;
    } else if (std::strncmp(argv[i], "--", 2) == 0) {
      name = argv[i];
    } else if (!take_option(options, name, argv[i])) {
      return false;
    }
  }
  return !options.seeds.empty() && (options.only_make || !options.program.empty()) &&
         options.jobs > 0;
}

Dice dice_of(const Options& options, std::uint64_t number) {
  std::uint64_t mixed = options.seed * 0x9e3779b97f4a7c15 + number;
  for (const int shift : {30, 27, 31}) {
    mixed = (mixed ^ (mixed >> shift)) * 0xbf58476d1ce4e5b9;
  }
  return Dice(mixed);
}

struct Input {
  Mutant mutant;
  Command command;
};

Input input_of(const Options& options, const Seeds& seeds, std::uint64_t number) {
  Dice dice = dice_of(options, number);
  Input input;
  input.mutant = make_mutant(seeds, number, dice);
  input.command = command_for(input.mutant, dice);
  return input;
}

void write_command(const Command& command, const std::string& path) {
  std::ofstream file(path);
  for (const auto* words : {&command.before, &command.words}) {
    file << (words->empty() ? "" : "tenon");
    for (const std::string& word : *words) {
      file << " '" << word << "'";
    }
    file << (words->empty() ? "" : "\n");
  }
}

std::vector<std::string> environment_in(const std::string& folder) {
  std::vector<std::string> entries = {"PATH=/usr/bin:/bin",
                                      "LC_ALL=C",
                                      "HOME=" + folder,
                                      "TMPDIR=" + folder,
                                      "XDG_CACHE_HOME=" + folder + "/cache",
                                      "XDG_STATE_HOME=" + folder + "/state",
                                      "ASAN_OPTIONS=allocator_may_return_null=0",
                                      "UBSAN_OPTIONS=print_stacktrace=1"};
  if (const char* libraries = std::getenv("LD_LIBRARY_PATH")) {
    entries.push_back(std::string("LD_LIBRARY_PATH=") + libraries);
  }
  return entries;
}

Subject subject_of(const Options& options, const std::string& folder) {
  Subject subject;
  subject.program = options.program;
  subject.sanitized = options.sanitized;
  subject.guarded_bytes = options.guarded_mb << 20;
  subject.environment = environment_in(folder);
  Mutant empty;
  empty.asset = "empty.usda";
  empty.files.push_back({empty.asset, "#usda 1.0\n"});
  Command info;
  info.words = {"info", empty.asset};
  subject.base_bytes = run_and_judge(subject, empty, info, folder).run.peak_bytes;
  return subject;
}

void keep_finding(const Options& options, const Input& input, std::uint64_t number,
                  const std::string& folder) {
  const std::string kept = options.findings + "/" + std::to_string(number);
  std::error_code error;
  write_files(input.mutant, kept);
  write_command(input.command, kept + "/COMMAND");
  if (!input.mutant.damaged.empty()) {
    fs::copy_file(folder + "/case/" + input.mutant.damaged, kept + "/" + input.mutant.damaged,
                  fs::copy_options::overwrite_existing, error);
  }
  for (const char* name : {"stdout", "stderr"}) {
    fs::copy_file(folder + "/" + name, kept + "/" + name, fs::copy_options::overwrite_existing,
                  error);
  }
}

/// Takes numbers from `next` until there are none left; a line for each into `folder`/results.
void work(const Options& options, const Seeds& seeds, std::uint64_t* next,
          const std::string& folder) {
  fs::create_directories(folder);
  std::ofstream results(folder + "/results");
  const Subject subject = subject_of(options, folder);
  for (;;) {
    const std::uint64_t number = __atomic_fetch_add(next, 1, __ATOMIC_RELAXED);
    if (number >= options.from + options.count) {
      break;
    }
    const auto& formats = options.formats;
    if (!formats.empty() &&
        std::find(formats.begin(), formats.end(), format_of(number)) == formats.end()) {
      continue;
    }
    const Input input = input_of(options, seeds, number);
    const Verdict verdict = run_and_judge(subject, input.mutant, input.command, folder);
    Outcome outcome{number, input.mutant.format, input.command.row, verdict.run, 0, verdict.fault};
    outcome.share_of_memory = static_cast<double>(verdict.run.peak_bytes) /
                              static_cast<double>(subject.allowed_bytes(input.mutant));
    results << to_line(outcome) << "\n";
    if (!verdict.fault.empty()) {
      keep_finding(options, input, number, folder);
    }
  }
}

/// -> all outcomes; fewer than asked for when a process of this program broke off.
std::vector<Outcome> run_all(const Options& options, const Seeds& seeds,
                             const std::string& folder) {
  void* const shared = mmap(nullptr, sizeof(std::uint64_t), PROT_READ | PROT_WRITE,
                            MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  auto* const next = static_cast<std::uint64_t*>(shared);
  *next = options.from;
  for (unsigned job = 0; job < options.jobs; ++job) {
    if (fork() == 0) {
      work(options, seeds, next, folder + "/" + std::to_string(job));
      _exit(0);
    }
  }
  while (wait(nullptr) > 0) {
  }
  std::vector<Outcome> outcomes;
  for (unsigned job = 0; job < options.jobs; ++job) {
    read_lines(folder + "/" + std::to_string(job) + "/results", outcomes);
  }
  return outcomes;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  if (!read_options(argc, argv, options)) {
    std::fputs(
        "usage: tenon_mutants --program FILE --seeds FOLDER... [--seed N] [--from I] "
        "[--count N] [--jobs J] [--sanitized] [--guarded-mb N] [--findings FOLDER] "
        "[--json FILE] [--formats NAME...] [--make I]\n",
        stderr);
    return 2;
  }
  const Seeds seeds = Seeds::load(options.seeds);
  for (std::size_t kind = 0; kind < kKinds; ++kind) {
    const bool needed = static_cast<Kind>(kind) != Kind::Crate &&
                        static_cast<Kind>(kind) != Kind::Package &&
                        static_cast<Kind>(kind) != Kind::Other;
    if (needed && !seeds.has(static_cast<Kind>(kind))) {
      std::fprintf(stderr, "no seed of kind %zu there; see fuzz/mutants/seeds.h\n", kind);
      return 2;
    }
  }
  if (options.only_make) {
    const Input input = input_of(options, seeds, options.from);
    write_files(input.mutant, options.findings);
    write_command(input.command, options.findings + "/COMMAND");
    return 0;
  }
  char folder[] = "/tmp/tenon_mutants_XXXXXX";
  if (mkdtemp(folder) == nullptr) {
    std::perror(folder);
    return 2;
  }
  const std::vector<Outcome> outcomes = run_all(options, seeds, folder);
  fs::remove_all(folder);
  Totals totals = totals_of(outcomes);
  totals.seed = options.seed;
  totals.from = options.from;
  totals.wanted = options.formats.empty() ? options.count : outcomes.size();
  totals.seeds_digest = seeds.digest();
  totals.sanitized = options.sanitized;
  print(totals);
  if (!options.json.empty()) {
    std::ofstream(options.json) << to_json(totals);
  }
  return totals.is_clean() ? 0 : 1;
}
