// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Where Python has its packages is asked first, of the interpreter alone. Then it runs once more,
// through tenon-worker, which confines itself and becomes it. A package that the file asks for and
// that nobody named is looked for upward from the file, as those of meshes are; with its folder
// the run is made again, since what may be read is settled at its beginning.
#include "tenon/xacro/expand_xacro.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>

#include "tenon/base/limits/guard_limits.h"
#include "tenon/base/text/shell_word.h"
#include "tenon/base/text/shown_path.h"
#include "tenon/bytes/asset_roots.h"
#include "tenon/bytes/files.h"
#include "tenon/guard/driven_program.h"
#include "tenon/guard/worker_place.h"
#include "tenon/xacro/driver.h"

namespace tenon::xacro {
namespace {

namespace fs = std::filesystem;
using guard::DrivenProgram;
using guard::Waiting;
using Seconds = std::chrono::seconds;

/// An interpreter that has xacro, and the folders that it needs.
struct Python {
  std::string program;
  std::vector<std::string> folders;
};

struct Expansion {
  std::string kind;  ///< "done", "failed", "package"
  std::string text;
  std::string files;
};

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    lines.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return lines;
}

/// "#!/usr/bin/python3" of a script; empty for anything else.
std::string interpreter_of(const bytes::Files& files, const std::string& script) {
  bytes::FileRules rules;
  rules.max_bytes = 1u << 20;
  const auto bytes = files->open(script, rules);
  if (!bytes || !(*bytes)->text().starts_with("#!/")) {
    return {};
  }
  const std::string_view text = (*bytes)->text();
  const std::string line(text.substr(2, text.find_first_of(" \r\n") - 2));
  return fs::path(line).filename() == "env" ? std::string() : line;
}

std::optional<Python> asked(const std::string& program) {
  auto process = DrivenProgram::start(program, {{"-c", std::string(kAboutPython)}, {}});
  std::string answer;
  if (!process ||
      (*process)->receive(answer, Seconds(limits::kXacroWallSeconds)) != Waiting::Done) {
    return std::nullopt;
  }
  std::vector<std::string> folders = lines_of(answer);
  if (folders.empty() || folders.back() != "xacro") {
    return std::nullopt;
  }
  folders.pop_back();
  return Python{program, std::move(folders)};
}

/// That of the program xacro first, then the one that is called python3.
Result<Python> find_python(const bytes::Files& files, const std::string& path) {
  std::vector<std::string> programs;
  if (const auto script = guard::find_program({"xacro"})) {
    programs.push_back(interpreter_of(files, *script));
  }
  if (const auto python = guard::find_program({"python3"})) {
    programs.push_back(*python);
  }
  for (const std::string& program : programs) {
    if (auto python = program.empty() ? std::nullopt : asked(program)) {
      return *std::move(python);
    }
  }
  return Error(ErrorCode::Missing, "its macros are expanded by xacro, which is not installed")
      .in_file(path)
      .with_rule("xacro.missing")
      .with_fix("run `pip install xacro` in an active virtual environment, or set up ROS");
}

Error no_sandbox(const std::string& path) {
  return Error(ErrorCode::Missing,
               "xacro runs what the file says, and this machine's kernel cannot confine it")
      .in_file(path)
      .with_rule("xacro.sandbox")
      .with_fix("where you trust the file, run `xacro " + shell_word(shown_path(path)) +
                " > out.urdf` and convert out.urdf");
}

Error too_much(const std::string& path, const std::string& what) {
  return Error(ErrorCode::Limit, "expanding its macros " + what)
      .in_file(path)
      .with_rule("xacro.limit")
      .with_fix("look for macros and expressions that repeat without end");
}

class Expanding {
 public:
  Expanding(std::string path, const XacroOptions& options)
      : path_(std::move(path)), packages_(options.packages), options_(options) {}

  Result<ExpandedXacro> run() {
    TENON_CHECK(bytes::check_on_disk(options_.reading.files(), path_));
    TENON_TRY(python_, find_python(options_.reading.files(), path_));
    TENON_TRY(worker_, guard::worker_program());
    for (std::size_t i = 0; i < limits::kXacroPackages; ++i) {
      TENON_TRY(Expansion done, expand());
      if (done.kind == "done") {
        ExpandedXacro expanded;
        expanded.text = std::move(done.text);
        expanded.opened = lines_of(done.files);
        expanded.found_folders = std::move(found_folders_);
        return expanded;
      }
      if (done.kind != "package" || !find_package(done.text)) {
        return failed(done);
      }
    }
    return too_much(path_, "asks for too many packages");
  }

 private:
  Error failed(const Expansion& done) const {
    const bool package = done.kind == "package";
    const std::string file = done.files.empty() ? path_ : done.files;
    return Error(package ? ErrorCode::NotFound : ErrorCode::Parse,
                 package ? "the package \"" + done.text + "\" cannot be found"
                         : "xacro says: " + done.text.substr(0, 2000))
        .in_file(file)
        .with_rule(package ? "xacro.package" : "xacro.failed")
        .with_fix(package ? "give the package's folder: --package " + done.text + "=DIR"
                          : advice(done.text));
  }

  static std::string advice(const std::string& message) {
    if (message.find("Permission denied") != std::string::npos ||
        message.find("Errno 13") != std::string::npos) {
      return "let the file be read: --allow-read FOLDER";
    }
    return message.find("argument") != std::string::npos ? "give the argument: --arg NAME=VALUE"
                                                         : "correct the file there";
  }

  std::vector<std::string> words() const {
    std::vector<std::string> words{"run", std::to_string(limits::kXacroMemory),
                                   std::to_string(limits::kXacroSeconds)};
    for (const std::string& root : options_.reading.roots()) {
      words.push_back("r:" + root);
    }
    for (const std::string& folder : found_folders_) {
      words.push_back("r:" + folder);
    }
    for (const auto& [name, folder] : options_.packages) {
      words.push_back("r:" + folder);
    }
    for (const char* system : {"/usr", "/lib", "/lib64", "/bin", "/etc/ld.so.cache"}) {
      words.push_back(std::string("x:") + system);
    }
    for (const std::string& folder : python_.folders) {
      words.push_back("x:" + folder);
    }
    for (const char* device : {"/dev/null", "/dev/urandom"}) {
      words.push_back(std::string("r:") + device);
    }
    words.insert(words.end(), {"--", python_.program, "-B", "-s", "-c", std::string(kExpand),
                               bytes::absolute_file_path(path_)});
    for (const auto& [name, folder] : packages_) {
      words.push_back(name + "=" + bytes::absolute_file_path(folder));
    }
    words.emplace_back("--");
    for (const auto& [name, value] : options_.arguments) {
      words.push_back(name + "=" + value);
    }
    return words;
  }

  Result<Expansion> expand() const {
    DrivenProgram::Settings settings;
    settings.arguments = words();
    settings.environment = {"PYTHONDONTWRITEBYTECODE=1", "PYTHONHASHSEED=0", "LC_ALL=C.UTF-8"};
    settings.longest = limits::kXacroBytes;
    TENON_TRY(const auto process, DrivenProgram::start(worker_, settings));
    const auto deadline = std::chrono::steady_clock::now() + Seconds(limits::kXacroWallSeconds);
    Expansion expansion;
    for (std::string* part : {&expansion.kind, &expansion.text, &expansion.files}) {
      const auto left = std::chrono::ceil<DrivenProgram::Milliseconds>(
          deadline - std::chrono::steady_clock::now());
      switch (process->receive(*part, left)) {
        case Waiting::Done:
          break;
        case Waiting::Late:
          return too_much(path_,
                          "takes longer than " + std::to_string(limits::kXacroWallSeconds) + " s");
        case Waiting::TooLong:
          return too_much(path_,
                          "makes more than " + std::to_string(limits::kXacroBytes) + " bytes");
        case Waiting::Ended:
          return ended(*process);
      }
    }
    return expansion;
  }

  Error ended(const DrivenProgram& process) const {
    const std::string& words = process.last_words();
    if (words.find("tenon-worker: no sandbox") != std::string::npos) {
      return no_sandbox(path_);
    }
    if (words.find("MemoryError") != std::string::npos || words.empty()) {
      return too_much(path_, "took more than " + std::to_string(limits::kXacroMemory) +
                                 " bytes of memory or " + std::to_string(limits::kXacroSeconds) +
                                 " s of processor time");
    }
    const std::vector<std::string> lines = lines_of(words);
    return Error(ErrorCode::Parse, "xacro ended: " + lines.back())
        .in_file(path_)
        .with_rule("xacro.failed")
        .with_fix("try `xacro " + shell_word(shown_path(path_)) + "` on its own");
  }

  /// Upward from the file: a folder with a package.xml that says so, or one of that name among
  /// those that may be read anyway.
  bool find_package(const std::string& name) {
    const bytes::Files& files = options_.reading.files();
    if (options_.reading.is_closed() || name.empty() || name.find('/') != std::string::npos ||
        name == "." || name == "..") {
      return false;
    }
    const auto is_it = [&](const fs::path& folder) {
      const auto text = bytes::package_xml_of(files, folder.string());
      return text != nullptr &&
             text->text().find("<name>" + name + "</name>") != std::string_view::npos;
    };
    for (fs::path at = fs::path(bytes::absolute_file_path(path_)).parent_path();;
         at = at.parent_path()) {
      for (const fs::path& folder : {at, at / name}) {
        const bool is_named_so = folder.filename() == name &&
                                 files->kind(folder.string()) == bytes::NameKind::Folder &&
                                 options_.reading.allows(folder.string());
        if (is_named_so || is_it(folder)) {
          packages_[name] = folder.string();
          if (!options_.reading.allows(folder.string())) {
            found_folders_.push_back(files->real_path(folder.string()));
          }
          return true;
        }
      }
      if (at == at.parent_path()) {
        return false;
      }
    }
  }

  std::string path_;
  std::map<std::string, std::string> packages_;
  const XacroOptions& options_;
  Python python_;
  std::string worker_;
  std::vector<std::string> found_folders_;
};

}  // namespace

bool is_xacro(std::string_view text, const std::string& path) {
  if (path.ends_with(".xacro")) {
    return true;
  }
  // Files that xacro made have macros in comments.
  for (std::size_t at = text.find('<'); at < text.size(); at = text.find('<', at + 1)) {
    const std::string_view rest = text.substr(at);
    if (rest.starts_with("<xacro:")) {
      return true;
    }
    if (rest.starts_with("<!--")) {
      at = std::min(text.find("-->", at + 4), text.size() - 1);
    }
  }
  return false;
}

Result<ExpandedXacro> expand_xacro(const std::string& path, const XacroOptions& options) {
  return Expanding(path, options).run();
}

}  // namespace tenon::xacro
