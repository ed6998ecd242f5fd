// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdio>

#include "cli/report.h"
#include "cli/verb.h"
#include "tenon/bytes/unpack_zip.h"
#include "tenon/bytes/zip_archive.h"
#include "tenon/pack_asset.h"
#include "tenon/tenon.h"

namespace tenon::cli {
namespace {

struct Options {
  std::string asset;
  std::string output;
  std::string folder;
  bool list = false;
  bool strict = false;
  std::vector<std::string> search_paths;
  std::vector<std::string> sandbox;
};

Json file_json(const formats::PackedFile& file) {
  return {{"name", file.name},
          {"source", file.source.empty() ? Json(nullptr) : Json(shown_path(file.source))},
          {"size", file.size},
          {"rewritten", file.rewritten},
          {"outside", file.outside}};
}

void note_files(const Report& report, const std::vector<formats::PackedFile>& files) {
  for (const formats::PackedFile& file : files) {
    if (file.outside) {
      report.note("from outside of the asset's folder: " + shown_path(file.source) + " as " +
                  file.name);
    }
  }
}

int pack(Report& report, const Options& options) {
  OpenOptions open;
  open.search_paths = options.search_paths;
  open.sandbox_roots = options.sandbox;
  if (!bytes::is_package_name(options.output)) {
    return report.fail(Error(ErrorCode::Invalid, options.output.empty()
                                                     ? "a package needs a place to be written to"
                                                     : "a package has a name that ends in .usdz")
                           .with_fix("give -o NAME.usdz"));
  }
  auto packed = pack_asset(options.asset, open, report.diagnostics);
  if (!packed) {
    return report.fail(packed.error());
  }
  const bool complete =
      std::none_of(report.diagnostics.begin(), report.diagnostics.end(),
                   [](const Diagnostic& finding) { return finding.rule == "package.missing"; });
  const bool write = complete || !options.strict;
  if (write) {
    if (auto written = write_output(options.output, packed->package); !written) {
      return report.fail(written.error());
    }
  }
  note_files(report, packed->files);
  report.note(write ? shown_path(options.output) + ": " + std::to_string(packed->files.size()) +
                          " files, " + std::to_string(packed->package.size()) + " bytes"
                    : "nothing is written: files are missing");
  Json files = Json::array();
  for (const formats::PackedFile& file : packed->files) {
    files.push_back(file_json(file));
  }
  return report.finish(write ? kOk : kNo, {{"output", write ? Json(options.output) : Json(nullptr)},
                                           {"size", packed->package.size()},
                                           {"complete", complete},
                                           {"files", std::move(files)}});
}

Result<bytes::ZipArchive> open_archive(const std::string& path) {
  TENON_TRY(const auto contents, bytes::FileBytes::open(path));
  if (!bytes::ZipArchive::is_zip(contents->text())) {
    return Error(ErrorCode::Invalid, "this is no package")
        .in_file(path)
        .with_fix("name a .usdz file; tenon zip ASSET -o NAME.usdz makes one");
  }
  return bytes::ZipArchive::open(contents);
}

/// Offset of the data of an entry in the file; the specification wants multiples of 64.
Result<std::size_t> data_offset(const bytes::FileBytes& file, const bytes::ZipArchive& archive,
                                const bytes::ZipEntry& entry) {
  TENON_TRY(const auto contents, archive.read(entry));
  return static_cast<std::size_t>(contents->text().data() - file.text().data());
}

int list(Report& report, const Options& options) {
  const auto file = bytes::FileBytes::open(options.asset);
  auto archive = open_archive(options.asset);
  if (!file || !archive) {
    return report.fail(file ? archive.error() : file.error());
  }
  auto again = bytes::ZipArchive::open(*file);  // offsets count from these bytes
  if (!again) {
    return report.fail(again.error());
  }
  Json entries = Json::array();
  for (const bytes::ZipEntry& entry : again->entries()) {
    const auto offset = data_offset(**file, *again, entry);
    const bool stored = entry.method == 0 && !entry.encrypted;
    const bool aligned = offset && *offset % 64 == 0;
    if (!report.json()) {
      std::printf("%12llu  %s%s\n", static_cast<unsigned long long>(entry.size), entry.name.c_str(),
                  !stored    ? "  (not stored: readers reject it)"
                  : !aligned ? "  (not at a multiple of 64 bytes)"
                             : "");
    }
    entries.push_back({{"name", entry.name},
                       {"size", entry.size},
                       {"offset", offset ? Json(*offset) : Json(nullptr)},
                       {"stored", stored},
                       {"aligned", aligned}});
  }
  return report.finish(kOk, {{"files", std::move(entries)}});
}

int extract(Report& report, const Options& options) {
  auto archive = open_archive(options.asset);
  if (!archive) {
    return report.fail(archive.error());
  }
  if (auto written = bytes::unpack_zip(*archive, options.folder); !written) {
    return report.fail(written.error());
  }
  Json files = Json::array();
  for (const bytes::ZipEntry& entry : archive->entries()) {
    files.push_back(entry.name);
  }
  report.note(std::to_string(files.size()) + " files in " + shown_path(options.folder));
  return report.finish(kOk, {{"folder", options.folder}, {"files", std::move(files)}});
}

int run_zip(const Globals& globals, const Options& options) {
  Report report(globals, "zip", options.asset);
  const int ways =
      (options.list ? 1 : 0) + (options.folder.empty() ? 0 : 1) + (options.output.empty() ? 0 : 1);
  if (ways > 1) {
    return report.fail(
        Error(ErrorCode::Invalid, "-o packs, --list lists, --extract unpacks: one at a time"));
  }
  return options.list              ? list(report, options)
         : !options.folder.empty() ? extract(report, options)
                                   : pack(report, options);
}

}  // namespace

void add_zip(const Command& parent, const Globals& globals, Chosen& chosen) {
  const Command verb = parent.add_subcommand(
      "zip", "Pack an asset with all its variants into one .usdz; list, unpack");
  auto options = std::make_shared<Options>();
  verb.add_option("asset", options->asset, "A USD file; with --list or --extract a .usdz")
      .required();
  verb.add_option("-o,--output", options->output, "The .usdz to write, in one step");
  verb.add_flag("--list", options->list, "Name the files of a package");
  verb.add_option("--extract", options->folder,
                  "Unpack into this folder, which must not exist yet; all or nothing");
  verb.add_flag("--strict", options->strict, "Write nothing when a file is missing, and answer no");
  verb.add_option("--search-path", options->search_paths, "As for other verbs").split_at_commas();
  verb.add_option("--sandbox", options->sandbox, "Open no file outside of these folders")
      .split_at_commas();
  verb.footer(
      "Everything that any variant names goes in: layers, textures, clips; files keep their "
      "places,\n"
      "those from outside of the asset's folder get one. What cannot be found is reported by "
      "name.\n\n"
      "Examples:\n"
      "  tenon zip hand.usda -o hand.usdz\n"
      "  tenon zip hand.usdz --list\n"
      "  tenon zip hand.usdz --extract hand");
  choose(verb, chosen, [&globals, options] { return run_zip(globals, *options); });
}

}  // namespace tenon::cli
