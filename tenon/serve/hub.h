// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Internal to tenon/serve: the only header that knows Boost. A connection begins as one for HTTP
// and may become a WebSocket, which keeps its place among the connections that are counted.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core/error.hpp>
#include <boost/beast/core/string_type.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/message.hpp>

#include "tenon/serve/server.h"

namespace tenon::serve {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;

class SocketClient;

using Request = http::request<http::empty_body>;

/// What all connections share; of the serving thread alone, once it serves.
struct Hub {
  Hub() = default;
  Hub(const Hub&) = delete;
  Hub& operator=(const Hub&) = delete;
  ~Hub();

  void tell(ClientEvent event);  ///< drops the client whom nobody listens to any more

  ServerOptions options;
  bool local = true;
  std::map<std::string, Page> pages;
  Function<bool(ClientEvent)> receive;
  std::size_t connections = 0;
  Client last_client = 0;
  std::map<Client, std::shared_ptr<SocketClient>> clients;
  bool stopping = false;
  bool by_signal = false;
  // What waits in here goes before what it refers to.
  asio::io_context io{1};
  asio::ip::tcp::acceptor acceptor{io};
  asio::signal_set signals{io};
  asio::steady_timer tick{io};   ///< looks for clients that are stuck
  asio::steady_timer pause{io};  ///< before the next try to accept, or to the end
};

/// A place among the connections that are counted.
class Slot {
 public:
  explicit Slot(Hub& hub) : hub_(&hub) { ++hub.connections; }
  Slot(const Slot&) = delete;
  Slot& operator=(const Slot&) = delete;
  ~Slot() { --hub_->connections; }

 private:
  Hub* hub_;
};

/// Answers requests on a new connection until it ends or becomes a WebSocket.
void serve_connection(Hub& hub, asio::ip::tcp::socket socket);

/// Lets the request for a WebSocket, which may be granted, become one.
void serve_socket(Hub& hub, asio::ip::tcp::socket stream, std::unique_ptr<Slot> slot,
                  const Request& request);

// ---- of clients, which only the socket's source knows more of
void send_text(const std::shared_ptr<SocketClient>& client,
               const std::shared_ptr<const std::string>& text);
void send_frame(const std::shared_ptr<SocketClient>& client,
                const std::shared_ptr<const std::string>& frame);
/// Whether it has not taken anything for longer than ServerLimits::write_seconds.
bool is_stuck(const SocketClient& client);
void drop(const std::shared_ptr<SocketClient>& client);
void say_goodbye(const std::shared_ptr<SocketClient>& client);

inline std::string_view view_of(beast::string_view text) { return {text.data(), text.size()}; }

}  // namespace tenon::serve
