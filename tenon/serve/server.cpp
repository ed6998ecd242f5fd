// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What other threads ask for is posted to the serving thread, which alone touches connections. At
// the end clients are told that it goes away, and have a moment to hear it.
#include "tenon/serve/server.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <utility>
#include <vector>

#include <boost/asio/ip/address.hpp>
#include <boost/asio/post.hpp>

#include "tenon/base/system/random_bytes.h"
#include "tenon/serve/hub.h"
#include "tenon/serve/own_addresses.h"

namespace tenon::serve {
namespace {

using asio::ip::tcp;

constexpr std::size_t kTokenBytes = 16;
constexpr auto kRetry = std::chrono::milliseconds(100);
constexpr auto kGoodbye = std::chrono::milliseconds(300);
constexpr auto kTick = std::chrono::seconds(1);

void accept_next(Hub& hub) {
  hub.acceptor.async_accept([&hub](beast::error_code fault, tcp::socket socket) {
    if (hub.stopping) {
      return;
    }
    if (!fault) {
      serve_connection(hub, std::move(socket));
      accept_next(hub);
      return;
    }
    // No file descriptors are left, or the peer is gone already.
    hub.pause.expires_after(kRetry);
    hub.pause.async_wait([&hub](beast::error_code stopped) {
      if (!stopped && !hub.stopping) {
        accept_next(hub);
      }
    });
  });
}

void look_for_stuck(Hub& hub) {
  hub.tick.expires_after(kTick);
  hub.tick.async_wait([&hub](beast::error_code stopped) {
    if (stopped || hub.stopping) {
      return;
    }
    std::vector<std::shared_ptr<SocketClient>> stuck;
    for (const auto& [number, client] : hub.clients) {
      if (is_stuck(*client)) {
        stuck.push_back(client);
      }
    }
    for (const auto& client : stuck) {
      drop(client);
    }
    look_for_stuck(hub);
  });
}

void stop_serving(Hub& hub) {
  if (hub.stopping) {
    return;
  }
  hub.stopping = true;
  beast::error_code ignored;
  hub.acceptor.close(ignored);
  hub.signals.cancel(ignored);
  hub.tick.cancel();
  if (hub.clients.empty()) {
    hub.io.stop();
    return;
  }
  for (const auto& [number, client] : hub.clients) {
    say_goodbye(client);
  }
  hub.pause.expires_after(kGoodbye);
  hub.pause.async_wait([&hub](beast::error_code) { hub.io.stop(); });
}

Error cannot_bind(const ServerOptions& options, const beast::error_code& fault) {
  return Error(ErrorCode::Io, "no server can be had on " + options.bind + ", port " +
                                  std::to_string(options.port) + ": " + fault.message())
      .with_rule("serve.bind")
      .with_fix("give another --port, 0 for any that is free, or another --bind");
}

Result<void> listen(Hub& hub) {
  beast::error_code fault;
  const auto address = asio::ip::make_address(hub.options.bind, fault);
  if (fault) {
    return Error(ErrorCode::Invalid, "`" + hub.options.bind + "` is not an address")
        .with_rule("usage.value")
        .with_fix("give it as numbers: 127.0.0.1 for this machine alone, 0.0.0.0 for all networks");
  }
  hub.local = address.is_loopback();
  const tcp::endpoint endpoint(address, hub.options.port);
  hub.acceptor.open(endpoint.protocol(), fault);
  if (!fault) {
    hub.acceptor.set_option(asio::socket_base::reuse_address(true), fault);
    hub.acceptor.bind(endpoint, fault);
  }
  if (!fault) {
    hub.acceptor.listen(asio::socket_base::max_listen_connections, fault);
  }
  if (!fault) {
    hub.options.port = hub.acceptor.local_endpoint(fault).port();
  }
  return fault ? Result<void>(cannot_bind(hub.options, fault)) : Result<void>();
}

}  // namespace

class Server::State : public Hub {};

Server::Server(std::shared_ptr<State> state) : state_(std::move(state)) {}
Server::Server(Server&&) noexcept = default;
Server& Server::operator=(Server&&) noexcept = default;
Server::~Server() = default;

Result<Server> Server::open(const ServerOptions& options) {
  auto state = std::make_shared<State>();
  state->options = options;
  if (options.token.empty()) {
    TENON_TRY(state->options.token, random_hex(kTokenBytes));
  }
  TENON_CHECK(listen(*state));
  return Server(std::move(state));
}

const std::string& Server::token() const { return state_->options.token; }
std::uint16_t Server::port() const { return state_->options.port; }
bool Server::is_local() const { return state_->local; }

std::string Server::url() const { return urls().front(); }

std::vector<std::string> Server::urls() const {
  const std::string& bind = state_->options.bind;
  beast::error_code ignored;
  std::vector<std::string> addresses;
  if (asio::ip::make_address(bind, ignored).is_unspecified()) {
    addresses = own_addresses(bind.find(':') != std::string::npos);
    if (addresses.empty()) {
      addresses.emplace_back("127.0.0.1");  // of every network there is only this
    }
  } else {
    addresses.push_back(bind);
  }
  std::vector<std::string> urls;
  for (const std::string& address : addresses) {
    const bool v6 = address.find(':') != std::string::npos;
    urls.push_back("http://" + (v6 ? "[" + address + "]" : address) + ":" + std::to_string(port()) +
                   "/" + token() + "/");
  }
  return urls;
}

void Server::publish(const std::string& name, Page page) {
  asio::post(state_->io, [hub = state_.get(), name, page = std::move(page)]() mutable {
    hub->pages[name] = std::move(page);
  });
}

void Server::send(Client client, std::string text) {
  auto shared = std::make_shared<const std::string>(std::move(text));
  asio::post(state_->io, [hub = state_.get(), client, shared = std::move(shared)] {
    std::vector<std::shared_ptr<SocketClient>> to;  // who is dropped leaves the map
    for (const auto& [number, one] : hub->clients) {
      if (client == kEveryone || client == number) {
        to.push_back(one);
      }
    }
    for (const auto& one : to) {
      send_text(one, shared);
    }
  });
}

void Server::send_frame(std::string bytes) {
  auto shared = std::make_shared<const std::string>(std::move(bytes));
  asio::post(state_->io, [hub = state_.get(), shared = std::move(shared)] {
    for (const auto& [number, one] : hub->clients) {
      serve::send_frame(one, shared);
    }
  });
}

void Server::stop() {
  asio::post(state_->io, [hub = state_.get()] { stop_serving(*hub); });
}

void Server::heed_signals() {
  beast::error_code ignored;
  state_->signals.add(SIGINT, ignored);
  state_->signals.add(SIGTERM, ignored);
}

bool Server::run(const Function<bool(ClientEvent event)>& receive) {
  Hub& hub = *state_;
  hub.receive = receive;
  heed_signals();
  hub.signals.async_wait([&hub](beast::error_code fault, int) {
    if (!fault) {
      hub.by_signal = true;
      stop_serving(hub);
    }
  });
  accept_next(hub);
  look_for_stuck(hub);
  hub.io.run();
  hub.receive = nullptr;
  return hub.by_signal;
}

}  // namespace tenon::serve
