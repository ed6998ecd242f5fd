// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A server for one program on one machine: the pages given to it, behind a secret token, and
// WebSockets that carry text both ways and frames of bytes to every client. It has no files behind
// it, so there is no path to leave. What untrusted clients can make it keep is bounded by
// ServerLimits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "tenon/base/function.h"
#include "tenon/base/result.h"

/// Pages and messages over HTTP/1.1 (RFC 9112) and WebSocket (RFC 6455); knows no USD.
namespace tenon::serve {

/// What a GET is answered with.
struct Page {
  std::string type;  ///< of its contents: "text/html; charset=utf-8"
  std::shared_ptr<const std::string> contents;
};

/// A WebSocket, counted from 1; the number of one that left is not used again.
using Client = std::uint64_t;
inline constexpr Client kEveryone = 0;

struct ClientEvent {
  enum class Kind : unsigned char { Came, Said, Left };
  Kind kind = Kind::Came;
  Client client = 0;
  std::string text{};  ///< of Said
};

/// What one server keeps for others at most, and how long it waits for them.
struct ServerLimits {
  std::size_t connections = 32;  ///< at the same time; further ones get an answer and are closed
  std::size_t header_bytes = 8 << 10;
  std::size_t message_bytes = 64 << 10;  ///< of what a client says
  std::size_t waiting_bytes = 64 << 20;  ///< of text that a client has not taken yet
  std::size_t waiting_texts = 2048;
  double request_seconds = 10;  ///< until a request is there as a whole
  double write_seconds = 20;    ///< until a client takes the next piece
  double silent_seconds = 40;   ///< a client that answers no ping for so long is gone
};

struct ServerOptions {
  std::string bind = "127.0.0.1";  ///< an address of this machine, as numbers
  std::uint16_t port = 0;          ///< 0: any that is free
  std::string token{};             ///< the first part of every path; empty: 128 random bits
  std::string content_policy{};    ///< Content-Security-Policy; empty: pages of this server alone
  ServerLimits limits{};
};

class Server {
 public:
  /// Bound, and waiting for run(). Errors: Invalid (usage.value) for what is no address, Io
  /// (serve.bind) for one that cannot be used.
  static Result<Server> open(const ServerOptions& options);
  Server(Server&&) noexcept;
  Server& operator=(Server&&) noexcept;
  ~Server();

  const std::string& token() const;
  std::uint16_t port() const;
  /// Only programs of this machine can reach it.
  bool is_local() const;
  std::string url() const;  ///< "http://127.0.0.1:4711/TOKEN/", the first of urls()
  /// How others reach it. Bound to every network: by each address of this machine.
  std::vector<std::string> urls() const;

  // ---- from any thread, before and while it runs

  /// From now on GET /TOKEN/`name` is answered with `page`; "ws" is taken by the WebSocket.
  void publish(const std::string& name, Page page);
  /// Text to a client, or to everyone. One that does not take it in time is dropped.
  void send(Client client, std::string text);
  /// Bytes to everyone; a client that is still busy with older ones gets the newest alone.
  void send_frame(std::string bytes);
  /// Says goodbye to all clients and lets run() return.
  void stop();

  // ---- from one thread

  /// From now on SIGINT and SIGTERM end run(); one that arrives before it ends it at once. For
  /// programs that print the address before run().
  void heed_signals();
  /// Serves until stop() or until SIGINT or SIGTERM arrives; true where it was such a signal.
  /// `receive` hears of clients on this thread and must not wait; where it answers false to what
  /// a client says, that client is dropped: it says more than can be done.
  bool run(const Function<bool(ClientEvent event)>& receive);

 private:
  class State;
  explicit Server(std::shared_ptr<State> state);
  std::shared_ptr<State> state_;
};

}  // namespace tenon::serve
