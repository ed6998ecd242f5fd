// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/engines/physx/run/input_log.h"

#include "tenon/base/wire.h"

namespace tenon::engines::physx {

void InputLog::add(const Input& input) {
  if (!whole_) {
    return;
  }
  const std::string encoded = wire::encoded(input);
  if (bytes_.size() + encoded.size() > kMostBytes) {
    whole_ = false;
    bytes_ = {};
    return;
  }
  bytes_ += encoded;
}

std::optional<std::vector<Input>> read_inputs(std::string_view bytes) {
  wire::Decoder decoder(bytes);
  std::vector<Input> inputs;
  while (!decoder.is_done()) {
    Input input;
    decoder.read(input);
    if (!decoder.is_sound() || (!inputs.empty() && input.step < inputs.back().step)) {
      return std::nullopt;
    }
    inputs.push_back(std::move(input));
  }
  return inputs;
}

}  // namespace tenon::engines::physx
