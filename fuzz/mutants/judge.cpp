// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "fuzz/mutants/judge.h"

#include <algorithm>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string_view>
#include <utility>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace tenon::fuzz {
namespace {

/// What this program itself took at most: a child counts that as its own from before it starts
/// another program, so less cannot be told apart.
std::size_t own_peak() {
  struct rusage usage = {};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024 + (8u << 20u);
}

namespace fs = std::filesystem;

constexpr std::size_t kMegabyte = 1u << 20;
constexpr std::size_t kCompositionBytes = 512 * kMegabyte;
/// Five bytes of text for each of limits::kRepeatedArrays.
constexpr std::size_t kRepeatedText = 640 * kMegabyte;
constexpr std::size_t kAddressSpace = 6144 * kMegabyte;
constexpr std::size_t kReadOfMessages = 256u << 10;
/// Composition under sanitizers, which are ten times slower, gets a tenth of limits::kComposeWork.
constexpr const char* kSanitizedWork = "4000000";

std::string start_of(const fs::path& path, std::size_t most) {
  std::ifstream file(path, std::ios::binary);
  std::string text(most, '\0');
  file.read(text.data(), static_cast<std::streamsize>(most));
  text.resize(static_cast<std::size_t>(std::max<std::streamsize>(file.gcount(), 0)));
  return text;
}

std::string first_line_with(const std::string& text, std::string_view word) {
  const std::size_t at = text.find(word);
  return text.substr(at, std::min<std::size_t>(text.find('\n', at) - at, 160));
}

/// Arcs of any layer may multiply until a limit of composition ends them.
bool is_large_composition(const std::string& errors) {
  return errors.find("[compose.index-capacity-exceeded]") != std::string::npos ||
         errors.find("[compose.work-exceeded]") != std::string::npos;
}

/// A crash, a report of a sanitizer, too much time or memory.
std::string fault_of_process(const Subject& subject, const ProgramRun& run, std::size_t allowed,
                             const std::string& errors) {
  for (const char* word :
       {"runtime error:", "ERROR: AddressSanitizer", "ERROR: LeakSanitizer", "[program."}) {
    if (errors.find(word) != std::string::npos) {
      return "report: " + first_line_with(errors, word);
    }
  }
  const double most = subject.limits().seconds;
  if (run.signal == SIGXCPU || run.signal == SIGALRM || run.signal == SIGKILL) {
    return "time: ended after " + std::to_string(run.seconds) + " s";
  }
  if (run.signal != 0) {
    return "signal: " + std::string(strsignal(run.signal));
  }
  if (run.seconds > most) {
    return "time: " + std::to_string(run.seconds) + " s";
  }
  if (!subject.sanitized && run.peak_bytes > std::max(allowed, own_peak())) {
    return "memory: " + std::to_string(run.peak_bytes >> 20) + " MB of " +
           std::to_string(allowed >> 20);
  }
  return run.exit > 4 ? "exit: " + std::to_string(run.exit) : "";
}

bool begins_as_layer(const std::string& path) {
  const std::string start = start_of(path, 8);
  const std::string_view wanted = path.ends_with(".usda")   ? "#usda"
                                  : path.ends_with(".usdc") ? "PXR-USDC"
                                                            : "PK\3\4";
  return start.starts_with(wanted);
}

bool is_there(const Command& command, const std::string& folder) {
  const fs::path output = fs::path(folder) / command.output;
  std::error_code error;
  switch (command.leaves) {
    case Leaves::Text:
      return fs::file_size(fs::path(folder).parent_path() / "stdout", error) > 0;
    case Leaves::Nothing:
      return true;
    case Leaves::Layer:
      return begins_as_layer(output.string());
    case Leaves::File:
    case Leaves::Log:
      return fs::is_regular_file(output, error) && fs::file_size(output, error) > 0;
    case Leaves::Folder:
      return fs::is_directory(output, error) && !fs::is_empty(output, error);
  }
  return false;
}

/// The run says that all is well and leaves nothing, or ends otherwise and says nothing.
std::string silent_fault(const Command& command, const ProgramRun& run, const std::string& folder,
                         const std::string& errors) {
  if (run.exit == 0) {
    return is_there(command, folder) ? "" : "silent: exit 0 without the output asked for";
  }
  std::error_code error;
  const bool printed = fs::file_size(fs::path(folder).parent_path() / "stdout", error) > 0;
  if (errors.empty() && !printed) {
    return "silent: exit " + std::to_string(run.exit) + " without a message";
  }
  if (run.exit == 2 && command.leaves != Leaves::Log && !command.output.empty() &&
      fs::exists(fs::path(folder) / command.output)) {
    return "left: exit 2, and " + command.output + " is there";
  }
  return "";
}

/// What stands beside an output and is of it: out_meshes of out.urdf, and the copy of what was
/// made.
bool belongs_to_output(const std::string& name, const std::string& output) {
  const std::string stem = output.substr(0, output.rfind('.'));
  return !output.empty() &&
         (name == output || name.starts_with(stem + "_") || name == ".tenon/" + output + ".base");
}

/// Files that nobody asked for, and inputs that changed.
std::string left_behind(const Mutant& mutant, const Command& command, const std::string& folder) {
  std::error_code error;
  for (auto entry = fs::recursive_directory_iterator(folder, error);
       entry != fs::recursive_directory_iterator(); entry.increment(error)) {
    const std::string name = entry->path().lexically_relative(folder).generic_string();
    if (belongs_to_output(name, command.output)) {
      entry.disable_recursion_pending();
      continue;
    }
    const bool known =
        (name == ".tenon" && !command.output.empty()) || name == mutant.damaged ||
        std::any_of(mutant.links.begin(), mutant.links.end(),
                    [&](const NamedFile& link) { return link.name == name; }) ||
        std::any_of(mutant.files.begin(), mutant.files.end(), [&](const NamedFile& file) {
          return file.name == name || file.name.starts_with(name + "/");
        });
    if (!known) {
      return "left: " + name;
    }
  }
  for (const NamedFile& file : mutant.files) {
    const std::string path = folder + "/" + file.name;
    if (!command.edits && mutant.other.empty() && fs::file_size(path, error) != file.bytes.size()) {
      return "left: the input " + file.name + " is not what it was";
    }
  }
  return "";
}

/// Whether a layer or package can be read to its last value and written again.
bool can_be_read(const Subject& subject, const std::string& name, const std::string& folder) {
  const std::string outer = fs::path(folder).parent_path().string();
  // What is binary need not have a text, and text may hold what no binary file can; a package holds
  // either.
  const std::string_view file = name;
  std::vector<std::string> formats{file.ends_with(".usda") ? "usda" : "usdc"};
  if (file.ends_with(".usdz")) {
    formats.emplace_back("usda");
  }
  return std::any_of(formats.begin(), formats.end(), [&](const std::string& format) {
    const ProgramCall call{{subject.program, "cat", name, "--format", format},
                           folder,
                           outer + "/stdout",
                           outer + "/stderr",
                           subject.environment};
    const ProgramRun run = run_program(call, subject.limits());
    return run.signal == 0 && run.exit == 0;
  });
}

/// `zip` puts files in as they are, so that a damaged value is no more damaged than before.
std::string fault_of_reading_back(const Subject& subject, const Command& command,
                                  const std::string& folder) {
  if (can_be_read(subject, command.output, folder)) {
    return "";
  }
  const std::string outer = fs::path(folder).parent_path().string();
  const std::string why = start_of(outer + "/stderr", 160);
  const bool copies = command.words.front() == "zip";
  return copies && !can_be_read(subject, command.words[1], folder)
             ? ""
             : "unreadable: " + command.output + " does not read back: " + why;
}

}  // namespace

ProgramLimits Subject::limits() const {
  return {sanitized ? 60.0 : 10.0, sanitized ? 0 : kAddressSpace};
}

std::size_t Subject::allowed_bytes(const Mutant& mutant) const {
  const std::size_t by_size = base_bytes + 64 * kMegabyte + 40 * mutant.size();
  switch (mutant.bound) {
    case Bound::File:
      return by_size;
    case Bound::Composition:
      return std::max(by_size, kCompositionBytes);
    case Bound::Guarded:
      return by_size + guarded_bytes;
    case Bound::Arrays:
      return by_size + kRepeatedText;
  }
  return by_size;
}

void write_files(const Mutant& mutant, const std::string& folder) {
  for (const NamedFile& file : mutant.files) {
    const fs::path path = fs::path(folder) / file.name;
    std::error_code error;
    fs::create_directories(path.parent_path(), error);
    std::ofstream(path, std::ios::binary) << file.bytes;
  }
  for (const NamedFile& link : mutant.links) {
    std::error_code error;
    fs::create_symlink(link.bytes, fs::path(folder) / link.name, error);
  }
}

namespace {

std::string whole_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// What comes before the run: a first command, and damage to the state that it saved.
void prepare(const Subject& subject, const Mutant& mutant, const Command& command,
             ProgramCall call) {
  if (command.before.empty()) {
    return;
  }
  call.words.assign(1, subject.program);
  call.words.insert(call.words.end(), command.before.begin(), command.before.end());
  run_program(call, subject.limits());
  const std::string path = call.folder + "/" + mutant.damaged;
  if (!mutant.damaged.empty() && fs::exists(path)) {
    Dice dice(mutant.damage);
    const std::string damaged = damaged_state(whole_file(path), dice);
    std::ofstream(path, std::ios::binary) << damaged;
  }
}

/// The run, and while it lasts a process that writes the asset over and over, where it is to.
ProgramRun run_beside_writer(const ProgramCall& call, const ProgramLimits& limits,
                             const Mutant& mutant) {
  if (mutant.other.empty()) {
    return run_program(call, limits);
  }
  const std::string path = call.folder + "/" + mutant.asset;
  const pid_t writer = fork();
  if (writer == 0) {
    for (;;) {
      for (const std::string& bytes : {mutant.other, mutant.files.back().bytes}) {
        std::fstream(path, std::ios::binary | std::ios::in | std::ios::out) << bytes;
        usleep(300);
      }
    }
  }
  const ProgramRun run = run_program(call, limits);
  kill(writer, SIGKILL);
  waitpid(writer, nullptr, 0);
  return run;
}

}  // namespace

Verdict run_and_judge(const Subject& subject, const Mutant& mutant, const Command& command,
                      const std::string& folder) {
  const std::string inside = folder + "/case";
  ProgramCall call{
      {subject.program}, inside, folder + "/stdout", folder + "/stderr", subject.environment};
  call.words.insert(call.words.end(), command.words.begin(), command.words.end());
  if (subject.sanitized && mutant.bound == Bound::Composition) {
    call.words.insert(call.words.end(), {"--max-work", kSanitizedWork});
  }
  Verdict verdict;
  // By the clock alone a program that waits for ever ends as one on a machine that stood still: it
  // gets a second run.
  for (int attempt = 0; attempt == 0 || (attempt == 1 && verdict.run.signal == SIGALRM);
       ++attempt) {
    std::error_code error;
    fs::remove_all(inside, error);
    fs::remove_all(folder + "/state", error);  // of `tenon undo`
    fs::create_directories(inside, error);
    write_files(mutant, inside);
    prepare(subject, mutant, command, call);
    verdict.run = run_beside_writer(call, subject.limits(), mutant);
  }
  const std::string errors = start_of(folder + "/stderr", kReadOfMessages);
  std::size_t allowed = subject.allowed_bytes(mutant);
  if (is_large_composition(errors)) {
    allowed = std::max(allowed, kCompositionBytes);
  }
  verdict.fault = fault_of_process(subject, verdict.run, allowed, errors);
  if (verdict.fault.empty()) {
    verdict.fault = silent_fault(command, verdict.run, inside, errors);
  }
  if (verdict.fault.empty()) {
    verdict.fault = left_behind(mutant, command, inside);
  }
  if (verdict.fault.empty() && verdict.run.exit == 0 && command.leaves == Leaves::Layer) {
    verdict.fault = fault_of_reading_back(subject, command, inside);
  }
  return verdict;
}

}  // namespace tenon::fuzz
