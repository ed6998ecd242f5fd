// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "fuzz/mutants/report.h"

#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <sstream>

namespace tenon::fuzz {
namespace {

constexpr std::uint64_t kManyRuns = 30;

void add(Counts& counts, const Outcome& outcome) {
  ++counts.runs;
  if (outcome.fault.empty()) {
    ++counts.exits[static_cast<std::size_t>(outcome.run.exit)];
  } else {
    ++counts.findings;
  }
  counts.max_seconds = std::max(counts.max_seconds, outcome.run.seconds);
  counts.max_memory = std::max(counts.max_memory, outcome.share_of_memory);
}

void print_table(const char* title, const std::map<std::string, Counts>& rows) {
  std::printf("%-70s %7s %6s %6s %6s %6s %6s %8s %7s %6s\n", title, "runs", "0", "1", "2", "3", "4",
              "findings", "seconds", "memory");
  for (const auto& [name, counts] : rows) {
    std::printf("%-70s %7" PRIu64, name.c_str(), counts.runs);
    for (const std::uint64_t exits : counts.exits) {
      std::printf(" %6" PRIu64, exits);
    }
    std::printf(" %8" PRIu64 " %7.2f %5.0f%%\n", counts.findings, counts.max_seconds,
                100 * counts.max_memory);
  }
}

std::string json_text(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      quoted += '\\';
    }
    quoted +=
        static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) > 0x7e ? '?' : c;
  }
  return quoted + "\"";
}

}  // namespace

std::string to_line(const Outcome& outcome) {
  std::string fault = outcome.fault;
  std::replace(fault.begin(), fault.end(), '\n', ' ');
  std::replace(fault.begin(), fault.end(), '\t', ' ');
  std::ostringstream line;
  line << outcome.number << '\t' << outcome.format << '\t' << outcome.row << '\t'
       << outcome.run.exit << '\t' << outcome.run.signal << '\t' << outcome.run.seconds << '\t'
       << outcome.run.peak_bytes << '\t' << outcome.share_of_memory << '\t' << fault;
  return line.str();
}

void read_lines(const std::string& path, std::vector<Outcome>& outcomes) {
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string word;
    Outcome outcome;
    const auto next = [&] {
      word.clear();
      std::getline(words, word, '\t');
      return word;
    };
    outcome.number = std::strtoull(next().c_str(), nullptr, 10);
    outcome.format = next();
    outcome.row = next();
    outcome.run.exit = std::atoi(next().c_str());
    outcome.run.signal = std::atoi(next().c_str());
    outcome.run.seconds = std::strtod(next().c_str(), nullptr);
    outcome.run.peak_bytes = std::strtoull(next().c_str(), nullptr, 10);
    outcome.share_of_memory = std::strtod(next().c_str(), nullptr);
    std::getline(words, outcome.fault);
    outcomes.push_back(outcome);
  }
}

std::uint64_t Totals::runs() const {
  std::uint64_t runs = 0;
  for (const auto& [name, counts] : formats) {
    runs += counts.runs;
  }
  return runs;
}

std::vector<std::string> Totals::dead_rows() const {
  std::vector<std::string> dead;
  for (const auto& [name, counts] : rows) {
    if (counts.runs >= kManyRuns && counts.exits[0] + counts.exits[1] == 0) {
      dead.push_back(name);
    }
  }
  return dead;
}

bool Totals::is_clean() const {
  return runs() == wanted && findings.empty() && dead_rows().empty();
}

Totals totals_of(const std::vector<Outcome>& outcomes) {
  Totals totals;
  for (const Outcome& outcome : outcomes) {
    add(totals.formats[outcome.format], outcome);
    add(totals.rows[outcome.row], outcome);
    if (!outcome.fault.empty()) {
      ++totals.kinds[outcome.fault.substr(0, outcome.fault.find(':'))];
      totals.findings.push_back(outcome);
    }
  }
  std::sort(totals.findings.begin(), totals.findings.end(),
            [](const Outcome& a, const Outcome& b) { return a.number < b.number; });
  return totals;
}

void print(const Totals& totals) {
  for (const Outcome& finding : totals.findings) {
    std::printf("mutant %" PRIu64 " (%s) %s: %s\n", finding.number, finding.format.c_str(),
                finding.row.c_str(), finding.fault.c_str());
  }
  print_table("verb", totals.rows);
  print_table("format", totals.formats);
  for (const std::string& row : totals.dead_rows()) {
    std::printf("no run of `%s` ended with 0 or 1: it tests nothing\n", row.c_str());
  }
  std::printf("%" PRIu64 " of %" PRIu64 " mutants from %" PRIu64 ", seed %" PRIu64
              ", of seeds %016" PRIx64 ", %s: %zu findings",
              totals.runs(), totals.wanted, totals.from, totals.seed, totals.seeds_digest,
              totals.sanitized ? "under sanitizers" : "release", totals.findings.size());
  for (const auto& [kind, count] : totals.kinds) {
    std::printf(", %s %" PRIu64, kind.c_str(), count);
  }
  std::printf("\n");
}

std::string to_json(const Totals& totals) {
  std::ostringstream out;
  out << "{\"seed\": " << totals.seed << ", \"from\": " << totals.from
      << ", \"wanted\": " << totals.wanted << ", \"runs\": " << totals.runs()
      << ", \"sanitized\": " << (totals.sanitized ? "true" : "false") << ",\n \"seeds\": \""
      << std::hex << totals.seeds_digest << std::dec
      << "\",\n \"findings\": " << totals.findings.size() << ",\n \"kinds\": {";
  const char* separator = "";
  for (const auto& [kind, count] : totals.kinds) {
    out << separator << json_text(kind) << ": " << count;
    separator = ", ";
  }
  out << "},\n \"formats\": {";
  separator = "\n  ";
  for (const auto& [name, counts] : totals.formats) {
    out << separator << json_text(name) << ": {\"runs\": " << counts.runs
        << ", \"findings\": " << counts.findings
        << ", \"read\": " << counts.exits[0] + counts.exits[1]
        << ", \"seconds\": " << counts.max_seconds << ", \"memory\": " << counts.max_memory << "}";
    separator = ",\n  ";
  }
  out << "\n }}\n";
  return out.str();
}

}  // namespace tenon::fuzz
