// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "tenon/base/result.h"

/// The envelope of saved states, the same for every engine: what the bytes are of, and whether they
/// are whole.
namespace tenon::engines {

/// What a state belongs to; another one cannot continue it bit for bit.
struct StateOwner {
  std::string engine;
  std::string version;      ///< of the engine's library
  std::uint64_t scene = 0;  ///< scene::scene_hash
  double time_step = 0;     ///< [s]
};

/// `body` is what the engine alone understands.
std::string seal_state(const StateOwner& owner, std::string body);

/// The body of untrusted bytes, whose contents are still to be checked. Errors: Corrupt, or
/// Unsupported with the first difference between the owners.
Result<std::string> open_state(const StateOwner& owner, std::string_view bytes);

/// Corrupt (rule simulation.state).
Error bad_state(const std::string& why);

}  // namespace tenon::engines
