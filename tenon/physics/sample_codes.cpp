// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/physics/sample_codes.h"

#include <algorithm>
#include <utility>

namespace tenon::physics {

std::vector<double> ascending_codes(std::vector<double> codes) {
  std::sort(codes.begin(), codes.end());
  codes.erase(std::unique(codes.begin(), codes.end()), codes.end());
  return codes;
}

std::vector<double> sample_codes(const std::vector<stage::Attribute>& attributes) {
  std::vector<double> codes;
  for (const stage::Attribute& attribute : attributes) {
    const std::vector<double> samples = attribute.time_samples();
    codes.insert(codes.end(), samples.begin(), samples.end());
  }
  return ascending_codes(std::move(codes));
}

}  // namespace tenon::physics
