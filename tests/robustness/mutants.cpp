// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// tenon_mutants COUNT FOLDER PATH...: opens COUNT damaged copies of the layer files at and below
// the paths, each in a process of its own, and of each text's crate; what crashes, takes more than
// 1 s for each megabyte or more memory than 64 MB and 40 times its size is a finding, which is kept
// in FOLDER (made when needed). The same paths give the same mutants. Exit 0: no finding.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "fuzz/crate_parts.h"
#include "tenon/formats/crate/writer.h"
#include "tenon/formats/open_layer.h"
#include "tests/robustness/measured_child.h"
#include "tests/robustness/open_input.h"

namespace {

namespace fs = std::filesystem;
using namespace tenon;  // NOLINT(google-build-using-namespace): a program of its own

constexpr std::uintmax_t kLargestSeed = 512u << 10;
constexpr std::size_t kLargestMutant = 4u << 20;

struct Seed {
  std::string name;
  std::string bytes;
};

std::string bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

bool is_crate(const std::string& bytes) { return bytes.starts_with("PXR-USDC"); }
bool is_text(const std::string& bytes) { return bytes.starts_with("#usda"); }

std::vector<fs::path> files_below(const std::vector<std::string>& places) {
  std::vector<fs::path> files;
  for (const std::string& place : places) {
    std::error_code error;
    if (fs::is_regular_file(place, error)) {
      files.emplace_back(place);
      continue;
    }
    for (const auto& entry : fs::recursive_directory_iterator(place, error)) {
      if (entry.is_regular_file(error) && entry.file_size(error) <= kLargestSeed) {
        files.push_back(entry.path());
      }
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// The layers among the files, and for each text also its crate.
std::vector<Seed> seeds_of(const std::vector<fs::path>& files) {
  std::vector<Seed> seeds;
  for (const fs::path& file : files) {
    std::string bytes = bytes_of(file);
    if (!is_crate(bytes) && !is_text(bytes)) {
      continue;
    }
    if (is_text(bytes)) {
      Diagnostics diagnostics;
      const auto layer =
          formats::read_layer(bytes::FileBytes::own(bytes), file.string(), diagnostics);
      const auto crate = layer ? formats::write_crate(*layer) : Result<std::string>("");
      if (crate && !crate->empty()) {
        seeds.push_back({file.string() + " as crate", *crate});
      }
    }
    seeds.push_back({file.string(), std::move(bytes)});
  }
  return seeds;
}

std::string mutant_of(const Seed& seed, std::uint64_t number) {
  return is_crate(seed.bytes) ? fuzz::mutate_crate(seed.bytes, number, kLargestMutant)
                              : fuzz::mutate_text(seed.bytes, number, kLargestMutant);
}

struct Totals {
  std::size_t outcomes[3] = {};
  std::size_t findings = 0;
  double most_seconds = 0;
  double most_memory = 0;  // of what is allowed
};

/// What is wrong with how the mutant is read and composed; "" for nothing.
std::string judge(const std::string& mutant, Totals& totals) {
  robustness::Allowance allowance = robustness::allowance_of(mutant.size());
  const auto read = robustness::measure([&] { return robustness::read_input(mutant); }, allowance);
  totals.most_seconds = std::max(totals.most_seconds, read.seconds);
  totals.most_memory = std::max(
      totals.most_memory, static_cast<double>(read.bytes) / static_cast<double>(allowance.bytes));
  if (const std::string excess = read.excess(allowance, robustness::Cost::Judge::Time);
      !excess.empty()) {
    return "read: " + excess;
  }
  if (read.outcome == robustness::kRefused) {
    ++totals.outcomes[robustness::kRefused];
    return "";
  }
  allowance.seconds *= 10;  // composition has limits of its own, but ends
  allowance.bytes *= 4;
  const auto composed =
      robustness::measure([&] { return robustness::compose_input(mutant); }, allowance);
  ++totals.outcomes[composed.outcome];
  const std::string excess = composed.excess(allowance, robustness::Cost::Judge::Time);
  return excess.empty() ? "" : "compose: " + excess;
}

void keep(const std::string& folder, std::uint64_t number, const std::string& mutant) {
  std::error_code error;
  fs::create_directories(folder, error);
  std::ofstream(folder + "/mutant_" + std::to_string(number), std::ios::binary) << mutant;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    std::fputs("usage: tenon_mutants COUNT FOLDER PATH...\n", stderr);
    return 2;
  }
  const std::uint64_t count = std::strtoull(argv[1], nullptr, 10);
  const std::vector<Seed> seeds = seeds_of(files_below({argv + 3, argv + argc}));
  if (seeds.empty()) {
    std::fputs("no layers there\n", stderr);
    return 2;
  }
  Totals totals;
  for (std::uint64_t number = 0; number < count; ++number) {
    const Seed& seed = seeds[number % seeds.size()];
    const std::string mutant = mutant_of(seed, number);
    const std::string fault = judge(mutant, totals);
    if (!fault.empty()) {
      ++totals.findings;
      std::printf("mutant %llu of %s: %s\n", static_cast<unsigned long long>(number),
                  seed.name.c_str(), fault.c_str());
      keep(argv[2], number, mutant);
    }
  }
  std::printf(
      "%llu mutants of %zu layers: %zu refused, %zu read, %zu composed, %zu findings; at most "
      "%.2f s and %.0f %% of the memory allowed\n",
      static_cast<unsigned long long>(count), seeds.size(), totals.outcomes[robustness::kRefused],
      totals.outcomes[robustness::kRead], totals.outcomes[robustness::kComposed], totals.findings,
      totals.most_seconds, 100 * totals.most_memory);
  return totals.findings == 0 ? 0 : 1;
}
