// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// Reads layers of any format for tests/differential/crate_layers.py.
// `tenon_recrate text DIRECTORY FILE...` writes the canonical text of the N-th file to DIRECTORY/N;
// `tenon_recrate crate DIRECTORY FILE...` writes it as a binary layer to DIRECTORY/N.usdc;
// `tenon_recrate time REPEATS FILE` prints the milliseconds that opening takes, the fastest.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>

#include "tenon/formats/crate/writer.h"
#include "tenon/formats/open_layer.h"
#include "tenon/formats/text/write/writer.h"

namespace {

bool convert(const std::string& what, const std::string& from, const std::string& to) {
  tenon::Diagnostics diagnostics;
  const auto layer = tenon::formats::open_layer_file(from, diagnostics);
  for (const tenon::Diagnostic& diagnostic : diagnostics) {
    std::fprintf(stderr, "%s\n", diagnostic.to_string().c_str());
  }
  if (!layer) {
    std::fprintf(stderr, "%s\n", layer.error().to_string().c_str());
    return false;
  }
  if (what == "text") {
    std::ofstream(to, std::ios::binary) << tenon::formats::write_text(*layer);
    return true;
  }
  const auto crate = tenon::formats::write_crate(*layer);
  if (!crate) {
    std::fprintf(stderr, "%s\n", crate.error().to_string().c_str());
    return false;
  }
  std::ofstream(to + ".usdc", std::ios::binary) << *crate;
  return true;
}

int measure(int repeats, const std::string& path) {
  double fastest = 1e9;
  for (int i = 0; i < repeats; ++i) {
    tenon::Diagnostics diagnostics;
    const auto start = std::chrono::steady_clock::now();
    const auto layer = tenon::formats::open_layer_file(path, diagnostics);
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
    if (!layer) {
      return 1;
    }
    fastest = std::min(fastest, took.count());
  }
  std::printf("%.2f\n", fastest);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    std::fputs("usage: tenon_recrate text|crate DIRECTORY FILE... | time REPEATS FILE\n", stderr);
    return 2;
  }
  if (std::string(argv[1]) == "time") {
    return measure(std::atoi(argv[2]), argv[3]);
  }
  bool all = true;
  for (int i = 3; i < argc; ++i) {
    all = convert(argv[1], argv[i], std::string(argv[2]) + "/" + std::to_string(i - 3)) && all;
  }
  return all ? 0 : 1;
}
