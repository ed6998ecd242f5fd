// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A live session as a machine of values: messages and passed time go in, messages, pose frames and
// pictures come out. It knows no sockets and no threads; its owner calls it from one thread.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tenon/base/function.h"
#include "tenon/base/result.h"
#include "tenon/live/edit_history.h"
#include "tenon/live/identifying.h"
#include "tenon/live/live_asset.h"
#include "tenon/live/messages.h"
#include "tenon/live/work.h"

namespace tenon::live {

/// Whom a message comes from and goes to; 0 is everyone.
using ClientNumber = std::uint64_t;

/// The answer to a request that takes long. `make` touches nothing of the session, so another
/// thread may call it; its result goes to Session::answer_late().
struct LateAnswer {
  ClientNumber client = 0;
  std::string request;
  Json id;
  Function<Result<Json>()> make;
  std::shared_ptr<Work> work{};  ///< what `make` tells meanwhile; null: nothing
  bool is_outside = false;       ///< another program works: it keeps no other answer waiting
};

/// What comes out of one call.
struct Outbox {
  struct Message {
    ClientNumber to = 0;
    std::string text;
  };
  std::vector<Message> messages;
  std::optional<std::string> frame;              ///< to everyone, pose_frame()
  std::vector<LateAnswer> late;                  ///< for the owner of the session to make
  std::shared_ptr<const std::string> picture{};  ///< not null: there is another one, for everyone
};

struct SessionOptions {
  LiveAssetOptions asset;
  std::string version;  ///< of tenon
  bool watch = false;   ///< look_at_files() opens the asset again when a file has changed
  WriteFiles write;     ///< empty: edits are refused
  IdentifyTools identify;
};

/// All requests that a session understands.
std::span<const MessageInfo> requests();

class Session {
 public:
  /// Errors: those of open_live_asset.
  static Result<Session> open(SessionOptions options);
  Session(Session&&) noexcept;
  Session& operator=(Session&&) noexcept;
  ~Session();

  const LiveAsset& asset() const;

  void greet(ClientNumber client, Outbox& out);
  void hear(ClientNumber client, std::string_view text, Outbox& out);
  /// Sends the result of LateAnswer::make to the client that asked.
  void answer_late(const LateAnswer& late, Result<Json> result, Outbox& out) const;
  /// What the client pulled is let go.
  void forget(ClientNumber client);
  /// Long requests of all clients are to end.
  void end_works();
  /// `seconds` have passed since the last call. Takes no longer than some 30 ms; time that cannot
  /// be simulated in that is skipped, and the rate of `state` tells it.
  void advance(double seconds, Outbox& out);
  /// Opens the asset again where a file that it was read from has changed. One that does not open
  /// any more is told, and what was there stays.
  void look_at_files(Outbox& out);
  bool is_playing() const;

  class State;

 private:
  explicit Session(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace tenon::live
