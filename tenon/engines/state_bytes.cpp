// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/engines/state_bytes.h"

#include <utility>

#include "tenon/base/content_digest.h"
#include "tenon/base/text/text_number.h"
#include "tenon/base/wire.h"

namespace tenon::engines {
namespace {

constexpr std::string_view kMagic = "tenon state 1\n";

struct Envelope {
  StateOwner owner;
  std::uint64_t digest = 0;  ///< of `body`
  std::string body;
};

Error other_owner(const std::string& why) {
  return Error(ErrorCode::Unsupported, "the saved state " + why).with_rule("simulation.state");
}

}  // namespace

Error bad_state(const std::string& why) {
  return Error(ErrorCode::Corrupt, "the saved state is damaged: " + why)
      .with_rule("simulation.state");
}

std::string seal_state(const StateOwner& owner, std::string body) {
  const std::uint64_t digest = content_digest(body);
  return std::string(kMagic) + wire::encoded(Envelope{owner, digest, std::move(body)});
}

Result<std::string> open_state(const StateOwner& owner, std::string_view bytes) {
  if (bytes.substr(0, kMagic.size()) != kMagic) {
    return bad_state("it does not begin as states of this version do");
  }
  auto envelope = wire::decoded<Envelope>(bytes.substr(kMagic.size()));
  if (!envelope || content_digest(envelope->body) != envelope->digest) {
    return bad_state("it is not whole");
  }
  const StateOwner& theirs = envelope->owner;
  if (theirs.engine != owner.engine || theirs.version != owner.version) {
    return other_owner("is of " + theirs.engine + " " + theirs.version + ", this is " +
                       owner.engine + " " + owner.version);
  }
  if (theirs.scene != owner.scene) {
    return other_owner("is of another scene");
  }
  if (theirs.time_step != owner.time_step) {
    return other_owner("has time steps of " + shortest(theirs.time_step) + " s, this has " +
                       shortest(owner.time_step) + " s");
  }
  return std::move(envelope->body);
}

}  // namespace tenon::engines
