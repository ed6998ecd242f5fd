// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// An output passes three steps. A claim judges its name and place before the work and changes
// nothing: the ending by the table below, two outputs with one place, a place that cannot be
// written. A put collects contents. The commit compares names with contents, writes all files in
// one transaction and prints last, so that a commit that fails prints nothing. A standard stream
// that is closed gets /dev/null, opened the wrong way round: no file of the run can take its
// number, and using it is an error. Whether all was printed is known only at the end, and decides
// the exit code too.
#include "cli/output.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <optional>
#include <span>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "tenon/asset/updating/base_copy.h"
#include "tenon/bytes/asset_resolver.h"
#include "tenon/bytes/posix_files.h"
#include "tenon/bytes/write/file_transaction.h"
#include "tenon/bytes/zip/unpack_zip.h"
#include "tenon/formats/save_layer.h"

namespace tenon::cli {
namespace {

namespace fs = std::filesystem;
using formats::LayerFormat;

/// One kind of output: how its name may end.
struct KindRow {
  OutputKind kind;
  const char* what;
  std::array<std::string_view, 5> endings;
  bool others;           ///< also endings that no row names
  bool standard_output;  ///< "-" will do
};

constexpr KindRow kKinds[] = {
    {OutputKind::Layer, "a layer", {".usda", ".usdc", ".usd", ".usdz"}, false, true},
    {OutputKind::NamedFormat, "a layer", {".usda", ".usdc", ".usd", ".usdz"}, true, true},
    {OutputKind::Overlay, "a layer over an asset", {".usda", ".usdc", ".usd"}, false, true},
    {OutputKind::Package, "a package", {".usdz"}, false, false},
    {OutputKind::Log, "a log", {".csv", ".jsonl", ".npz"}, false, true},
    {OutputKind::NamedLog, "a log", {".csv", ".jsonl", ".npz"}, true, true},
    {OutputKind::State, "a saved state", {".state"}, true, true},
    {OutputKind::Description,
     "a robot's description",
     {".xml", ".urdf", ".sdf", ".srdf", ".py"},
     false,
     false},
    {OutputKind::Pairs, "a list of pairs", {".srdf"}, false, false},
    {OutputKind::Poses, "a file of poses", {".json"}, false, false},
    {OutputKind::Dump, "a dump", {".json"}, true, true},
    {OutputKind::Sarif, "a SARIF log", {".sarif", ".json"}, true, true},
    {OutputKind::Baseline, "a baseline", {".json"}, true, true},
    {OutputKind::Comparison, "a comparison", {".html", ".json", ".csv"}, false, false},
    {OutputKind::Motion, "a motion", {".usda", ".usdc", ".usd", ".glb"}, false, true},
    {OutputKind::Page, "a page", {".html"}, false, true},
    {OutputKind::Picture, "a picture", {".png"}, false, false},
    {OutputKind::Recording, "a picture or a film", {".png", ".webm", ".mp4"}, false, false},
};

const KindRow& row_of(OutputKind kind) {
  return *std::find_if(std::begin(kKinds), std::end(kKinds),
                       [&](const KindRow& row) { return row.kind == kind; });
}

std::string ending_of(const std::string& path) {
  std::string ending = fs::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

bool has_ending(const KindRow& row, const std::string& ending) {
  return !ending.empty() &&
         std::find(row.endings.begin(), row.endings.end(), ending) != row.endings.end();
}

bool fits(const KindRow& row, const std::string& path) {
  const std::string ending = ending_of(path);
  const bool known = std::any_of(std::begin(kKinds), std::end(kKinds),
                                 [&](const KindRow& other) { return has_ending(other, ending); });
  return has_ending(row, ending) || (row.others && !known);
}

Error wrong_kind(const KindRow& row, const std::string& path) {
  std::string endings;
  for (const std::string_view ending : row.endings) {
    if (!ending.empty()) {
      endings += (endings.empty() ? "" : ", ") + std::string(ending);
    }
  }
  return Error(ErrorCode::Invalid, std::string("this is no name of ") + row.what)
      .in_file(path)
      .with_rule("output.kind")
      .with_fix("name a file that ends in " + endings);
}

/// Devices and pipes hold nothing that could be lost, and have whatever name they have.
bool is_device(const std::string& path) {
  struct stat info = {};
  return ::stat(path.c_str(), &info) == 0 && !S_ISREG(info.st_mode) && !S_ISDIR(info.st_mode);
}

Result<void> check_place(const std::string& path) {
  std::error_code error;
  if (fs::is_directory(path, error)) {
    return Error(ErrorCode::Io, "cannot write the file: it is a folder")
        .in_file(path)
        .with_rule("file.unwritable")
        .with_fix("name a file in it");
  }
  const fs::path place = bytes::absolute_file_path(path);
  const fs::path real = fs::weakly_canonical(place, error);
  if (::access((error ? place : real).parent_path().c_str(), W_OK) != 0) {
    return bytes::unwritable(path, "file", errno);
  }
  return {};
}

std::optional<LayerFormat> format_of_contents(std::string_view contents) {
  if (contents.starts_with("#usda")) {
    return LayerFormat::Text;
  }
  if (contents.starts_with("PXR-USDC")) {
    return LayerFormat::Crate;
  }
  return contents.starts_with("PK\x03\x04") ? std::optional(LayerFormat::Package) : std::nullopt;
}

/// The descriptor stays taken by something that can be neither read nor written as it should be.
void keep_taken(int descriptor, int flags) {
  if (::fcntl(descriptor, F_GETFD) < 0) {
    const int opened = ::open("/dev/null", flags);
    if (opened >= 0 && opened != descriptor) {
      ::dup2(opened, descriptor);
      ::close(opened);
    }
  }
}

}  // namespace

Result<void> Outputs::claim(OutputKind kind, const std::string& path) {
  if (path.empty()) {
    return {};
  }
  const KindRow& row = row_of(kind);
  const bool printed = path == "-";
  if (printed ? !row.standard_output : !is_device(path) && !fits(row, path)) {
    return wrong_kind(row, path);
  }
  std::error_code error;
  const std::string place =
      printed ? path : fs::weakly_canonical(bytes::absolute_file_path(path), error).string();
  if (!is_device(path) && std::find(claimed_.begin(), claimed_.end(), place) != claimed_.end()) {
    return Error(ErrorCode::Invalid, "two outputs of this run have this place")
        .in_file(printed ? "standard output" : path)
        .with_rule("output.twice")
        .with_fix("name two files");
  }
  claimed_.push_back(place);
  return printed || is_device(path) ? Result<void>() : check_place(path);
}

void Outputs::put(const std::string& path, std::string contents) {
  files_.emplace_back(path, std::move(contents));
}

void Outputs::put_beside(const std::string& path, std::string contents) {
  make_folders_ = true;
  put(path, std::move(contents));
}

void Outputs::put_all(MadeFiles files) {
  for (MadeFile& file : files) {
    put_beside(file.path, std::move(file.contents));
  }
}

Result<void> Outputs::commit() const {
  bytes::FileTransaction transaction;
  for (const auto& [path, contents] : files_) {
    const std::optional<LayerFormat> format = format_of_contents(contents);
    if (path != "-" && format && !in_place_) {
      TENON_CHECK(check_layer_name(path, *format));
    }
    if (path != "-") {
      transaction.put(path, contents);
    }
  }
  std::vector<bytes::ReplacedFile> replaced;
  TENON_CHECK(transaction.commit({.in_place = in_place_,
                                  .make_folders = make_folders_,
                                  .check = check_,
                                  .replaced = in_place_ ? &replaced : nullptr}));
  keep_for_undo(edit_.verb, edit_.asset, std::move(replaced), bytes::Files());
  for (const auto& [path, contents] : files_) {
    if (path == "-") {
      print_data(contents);
    }
  }
  return {};
}

Result<void> check_layer_name(const std::string& path, LayerFormat format) {
  const std::string ending = ending_of(path);
  const bool fits =
      (ending != ".usda" && ending != ".usdc" && ending != ".usdz" && ending != ".usd") ||
      (ending == ".usda" && format == LayerFormat::Text) ||
      (ending == ".usdc" && format == LayerFormat::Crate) ||
      (ending == ".usdz" && format == LayerFormat::Package) ||
      (ending == ".usd" && format != LayerFormat::Package);
  if (fits) {
    return {};
  }
  const char* proper = format == LayerFormat::Text    ? ".usda"
                       : format == LayerFormat::Crate ? ".usdc"
                                                      : ".usdz";
  const char* what = format == LayerFormat::Text    ? "text"
                     : format == LayerFormat::Crate ? "a binary layer"
                                                    : "a package";
  return Error(ErrorCode::Invalid, "a file that ends in " + ending + " cannot hold " + what)
      .in_file(path)
      .with_rule("output.kind")
      .with_fix("name a file that ends in " + std::string(proper));
}

Result<void> write_asset(const structure::Package& package, const std::string& folder,
                         structure::WriteOptions options, const std::string& verb) {
  std::vector<bytes::ReplacedFile> replaced;
  options.replaced = options.in_place ? &replaced : nullptr;
  Result<void> written = write_with_base(package, folder, options);
  keep_for_undo(verb, folder + "/" + package.interface, std::move(replaced), bytes::Files());
  return written;
}

Result<void> write_edits(const std::vector<EditedFile>& files, const EditOf& edit) {
  std::vector<bytes::ReplacedFile> replaced;
  Result<void> written = write_files(files, &replaced);
  keep_for_undo(edit.verb, edit.asset, std::move(replaced), bytes::Files());
  return written;
}

Result<void> write_undone(const UndoneEdit& edit) { return restore_undone(edit); }

Result<void> unpack(const bytes::ZipArchive& archive, const std::string& folder) {
  return bytes::unpack_zip(archive, folder);
}

void begin_output() {
  static bytes::ReadRecord read_files;
  read_files.install();
  keep_taken(STDIN_FILENO, O_WRONLY);
  keep_taken(STDOUT_FILENO, O_RDONLY);
  keep_taken(STDERR_FILENO, O_RDONLY);
  std::signal(SIGPIPE, SIG_IGN);
#ifdef SIGXFSZ
  std::signal(SIGXFSZ, SIG_IGN);
#endif
}

int finish_output(int code) {
  int error = printing_error();
  errno = 0;
  const bool failed = std::fflush(stdout) != 0 || std::ferror(stdout) != 0;
  if (failed && error == 0) {
    error = errno == 0 ? EIO : errno;
  }
  if (error == 0 && !std::cout.flush()) {
    error = EIO;
  }
  // Some file systems tell only now that there is no room.
  if (error == 0 && ::close(::dup(STDOUT_FILENO)) != 0 && errno != EBADF) {
    error = errno;
  }
  if (error == 0) {
    return code;
  }
  if (error != EPIPE) {
    std::fprintf(stderr, "tenon: error: standard output cannot be written: %s\n",
                 error == EBADF ? "it is closed" : std::strerror(error));
  }
  return code == kInterrupted ? code : kFailed;
}

}  // namespace tenon::cli
