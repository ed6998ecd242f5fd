// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdio>

#include "cli/output.h"
#include "cli/progress.h"
#include "cli/report.h"
#include "cli/verb.h"
#include "tenon/asset/answers/package_json.h"
#include "tenon/asset/missing_input.h"
#include "tenon/asset_policy.h"
#include "tenon/base/text/counted.h"
#include "tenon/base/text/shown_path.h"
#include "tenon/pack_asset.h"

namespace tenon::cli {
namespace {

struct ZipArguments {
  std::string asset;
  std::string output;
  std::string folder;
  bool list = false;
  bool strict = false;
  FileAccess files;
};

void note_files(const Report& report, const std::vector<formats::PackedFile>& files) {
  for (const formats::PackedFile& file : files) {
    if (file.outside) {
      report.note("from outside the asset's folder: " + shown_path(file.source) + " as " +
                  file.name);
    }
  }
}

int pack(Report& report, const ZipArguments& options) {
  const OpenOptions open = options.files.open_options();
  if (options.output.empty()) {
    return report.fail(
        Error(ErrorCode::Invalid, "say where to write the package").with_fix("give -o NAME.usdz"));
  }
  Outputs outputs;
  if (auto claimed = outputs.claim(OutputKind::Package, options.output); !claimed) {
    return report.fail(claimed.error());
  }
  auto packed = pack_asset(options.asset, open, report.diagnostics);
  if (!packed) {
    return report.fail(packed.error());
  }
  const bool complete =
      std::none_of(report.diagnostics.begin(), report.diagnostics.end(), tells_of_missing_input);
  const bool refused = left_out(report.diagnostics);
  const bool write = (complete && !refused) || !options.strict;
  const std::size_t size = packed->package.size();
  if (write) {
    outputs.put(options.output, std::move(packed->package));
    if (auto written = outputs.commit(); !written) {
      return report.fail(written.error());
    }
  }
  note_files(report, packed->files);
  report.note(write ? shown_path(options.output) + ": " + counted(packed->files.size(), "file") +
                          ", " + counted(size, "byte")
                    : "nothing is written: files are missing");
  PackedAnswer answer;
  answer.output = write ? options.output : "";
  answer.size = size;
  answer.complete = complete && !refused;
  return report.finish(write && !refused ? kOk : kNo, packed_json(answer, packed->files));
}

int list(Report& report, const ZipArguments& options) {
  const auto entries = list_package(options.asset, options.files.open_options());
  if (!entries) {
    return report.fail(entries.error());
  }
  for (const PackageEntry& entry : *entries) {
    if (!report.json()) {
      print("%12llu  %s%s\n", static_cast<unsigned long long>(entry.size), entry.name.c_str(),
            !entry.stored         ? "  (not stored: readers reject it)"
            : !entry.is_aligned() ? "  (not at a multiple of 64 bytes)"
                                  : "");
    }
  }
  return report.finish(kOk, package_list_json(*entries));
}

int extract(Report& report, const ZipArguments& options) {
  const auto archive = open_package(options.asset, options.files.open_options());
  if (!archive) {
    return report.fail(archive.error());
  }
  if (auto written = unpack(*archive, options.folder); !written) {
    const bool is_about_package = written.error().diagnostic().file.empty();
    return report.fail(is_about_package ? Error(written.error()).in_file(options.asset)
                                        : written.error());
  }
  report.note(std::to_string(archive->entries().size()) + " files in " +
              shown_path(options.folder));
  return report.finish(kOk, unpacked_json(*archive, options.folder));
}

int run_zip(const Globals& globals, const ZipArguments& options) {
  Report report(globals, "zip", options.asset);
  const Progress progress(
      globals, (options.folder.empty() ? "packing " : "unpacking ") + shown_path(options.asset));
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
  auto options = std::make_shared<ZipArguments>();
  verb.add_option("asset", options->asset, "A USD file; with --list or --extract a .usdz")
      .required()
      .file_only();
  verb.add_option("-o,--output", options->output, "The .usdz to write, in one step");
  verb.add_flag("--list", options->list, "Name the files of a package");
  verb.add_option("--extract", options->folder,
                  "Unpack into this folder, which must not exist yet; all or nothing");
  verb.add_flag("--strict", options->strict, "Write nothing when a file is missing, and answer no")
      .not_with({"--list", "--extract"});
  options->files.add_to(verb);
  verb.footer(
      "Everything that any variant names goes in: layers, textures, clips; files keep their "
      "places,\n"
      "those from outside of the asset's folder, which --allow-read lets in, get one. What cannot "
      "be\nfound or may not be read is reported by name.\n\n"
      "Examples:\n"
      "  tenon zip hand.usda -o hand.usdz\n"
      "  tenon zip hand.usdz --list\n"
      "  tenon zip hand.usdz --extract hand");
  choose(verb, chosen, [&globals, options] { return run_zip(globals, *options); });
}

}  // namespace tenon::cli
