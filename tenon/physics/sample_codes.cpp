// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/physics/sample_codes.h"

#include <algorithm>
#include <utility>

namespace tenon::physics {
namespace {

constexpr double kCodesPerFrame = 4;  ///< between authored samples

}  // namespace

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

std::vector<double> dense_codes(const ReadState& state, std::vector<double> codes,
                                std::size_t most) {
  if (state.readings.held_samples == HeldSamples::Held || codes.empty()) {
    return codes;
  }
  const double first = codes.front();
  const double last = codes.back();
  const double fps = state.stage.frames_per_second();
  const double frame = fps > 0 ? state.scene.time_codes_per_second / fps : 1;
  const double step = std::max(frame / kCodesPerFrame, (last - first) / static_cast<double>(most));
  for (std::size_t i = 1; i <= most; ++i) {
    const double code = first + static_cast<double>(i) * step;
    if (!(code < last)) {
      break;
    }
    codes.push_back(code);
  }
  return ascending_codes(std::move(codes));
}

}  // namespace tenon::physics
