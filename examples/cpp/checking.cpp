// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// What is wrong with an asset, what would correct it, and where a number of it comes from.
//   checking hand.usda /hand/palm
#include <cstdio>
#include <string>

#include "example.h"

#include "tenon/tenon.h"

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: checking ASSET PRIM\n");
    return 2;
  }
  const tenon::CheckOptions options;
  const tenon::CheckedAsset checked = or_exit(tenon::check_asset(argv[1], options));
  int errors = 0;
  for (const tenon::check::Finding& finding : checked.findings) {
    errors += finding.diagnostic.severity == tenon::Severity::Error ? 1 : 0;
    std::printf("%s\n", finding.diagnostic.to_string().c_str());
    if (finding.fix) {
      std::printf("  fix: %s\n", finding.fix->what.c_str());
    }
  }
  const auto files = or_exit(tenon::corrected_files(checked.findings, options.open.files));
  std::printf("findings: %zu\n", checked.findings.size());
  std::printf("errors: %d\n", errors);
  std::printf("files to correct: %zu\n", files.size());

  tenon::Diagnostics diagnostics;
  const auto stage = or_exit(tenon::open(argv[1], options.open, diagnostics));
  const std::string json =
      or_exit(tenon::explain(stage, argv[2], {}, options.readings, diagnostics));
  std::printf("%s\n", json.c_str());
  return errors == 0 ? 0 : 1;
}
