// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// One connection for HTTP: requests are read one after the other, judged by request_guard.h and
// answered from the pages of the hub. A page is written piece by piece, each within its own time,
// so that large ones reach slow readers and none waits for ever.
#include <array>
#include <chrono>
#include <utility>

#include <boost/asio/buffer.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/serializer.hpp>
#include <boost/beast/http/span_body.hpp>
#include <boost/beast/http/write.hpp>
#include <boost/beast/websocket/rfc6455.hpp>

#include "tenon/serve/hub.h"
#include "tenon/serve/request_guard.h"

namespace tenon::serve {
namespace {

using Response = http::response<http::span_body<const char>>;

std::chrono::milliseconds milliseconds(double seconds) {
  return std::chrono::milliseconds(static_cast<long>(seconds * 1000));
}

/// What a page may do: use what this server serves and nothing else.
std::string content_policy(std::string_view host) {
  return "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self'; "
         "img-src 'self' data: blob:; worker-src 'self' blob:; connect-src 'self' blob: ws://" +
         std::string(host) + "; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";
}

void set_common_fields(Response& response, const ServerOptions& options, std::string_view host) {
  response.set(http::field::cache_control, "no-store");
  response.set("Content-Security-Policy",
               options.content_policy.empty() ? content_policy(host) : options.content_policy);
  response.set("X-Content-Type-Options", "nosniff");
  response.set("X-Frame-Options", "DENY");
  response.set("Referrer-Policy", "no-referrer");  // the address holds the token
  response.set("Cross-Origin-Opener-Policy", "same-origin");
  response.set("Cross-Origin-Resource-Policy", "same-origin");
}

class HttpConnection : public std::enable_shared_from_this<HttpConnection> {
 public:
  HttpConnection(Hub& hub, asio::ip::tcp::socket socket)
      : hub_(hub), slot_(std::make_unique<Slot>(hub)), socket_(std::move(socket)) {}

  void read() {
    parser_.emplace();
    parser_->header_limit(static_cast<std::uint32_t>(hub_.options.limits.header_bytes));
    parser_->body_limit(0);
    close_after(hub_.options.limits.request_seconds);
    http::async_read(
        socket_, buffer_, *parser_,
        [self = shared_from_this()](beast::error_code fault, std::size_t) { self->answer(fault); });
  }

 private:
  void answer(beast::error_code fault) {
    deadline_.cancel();
    const bool is_of_text =
        fault.category() == http::make_error_code(http::error::bad_version).category();
    if (fault == http::error::end_of_stream || (fault && !is_of_text)) {
      return;  // it is gone, or never said anything
    }
    if (fault) {
      const bool too_long =
          fault == http::error::header_limit || fault == http::error::buffer_overflow;
      refuse(too_long ? http::status::request_header_fields_too_large : http::status::bad_request,
             "bad request\n", false);
      return;
    }
    answer(parser_->get());
  }

  void answer(const Request& request) {
    const bool keep = request.keep_alive();
    host_ = view_of(request[http::field::host]);
    const std::string_view target = view_of(request.target());
    if (!is_own_host(host_, hub_.local)) {
      host_.clear();
      refuse(http::status::forbidden,
             "open this page by the address that tenon printed, not by another name\n", keep);
    } else if (const auto route = route_of(target, hub_.options.token)) {
      answer(request, *route, keep);
    } else if (lacks_slash(target, hub_.options.token)) {
      redirect("/" + hub_.options.token + "/", keep);
    } else {
      refuse(http::status::not_found,
             "nothing is here: open the whole address that tenon printed, token included\n", keep);
    }
  }

  void answer(const Request& request, const std::string& route, bool keep) {
    const auto page = hub_.pages.find(route);
    if (request.method() != http::verb::get && request.method() != http::verb::head) {
      refuse(http::status::method_not_allowed, "only GET and HEAD are answered\n", keep);
    } else if (route == "ws") {
      upgrade(request, keep);
    } else if (page == hub_.pages.end()) {
      refuse(http::status::not_found, "there is no such page\n", keep);
    } else {
      write(http::status::ok, page->second, keep, request.method() == http::verb::head);
    }
  }

  void upgrade(const Request& request, bool keep) {
    const std::string_view origin = view_of(request[http::field::origin]);
    const bool has_origin = request.find(http::field::origin) != request.end();
    if (!beast::websocket::is_upgrade(request)) {
      refuse(http::status::upgrade_required, "this is for WebSockets\n", keep);
    } else if (has_origin && !is_own_origin(origin, host_)) {
      refuse(http::status::forbidden, "pages of other sites may not come in\n", false);
    } else {
      serve_socket(hub_, std::move(socket_), std::move(slot_), request);
    }
  }

  /// What is under way ends then, with an error.
  void close_after(double seconds) {
    deadline_.expires_after(milliseconds(seconds));
    deadline_.async_wait([weak = weak_from_this()](beast::error_code stopped) {
      const auto self = weak.lock();
      if (self != nullptr && !stopped) {
        beast::error_code ignored;
        self->socket_.close(ignored);
      }
    });
  }

  void refuse(http::status status, const std::string& why, bool keep) {
    write(status, {"text/plain; charset=utf-8", std::make_shared<const std::string>(why)}, keep,
          false);
  }

  void redirect(const std::string& place, bool keep) {
    location_ = place;
    refuse(http::status::permanent_redirect, "see " + place + "\n", keep);
  }

  void write(http::status status, const Page& page, bool keep, bool head) {
    contents_ = page.contents;
    response_.emplace(status, 11);
    response_->set(http::field::content_type, page.type);
    set_common_fields(*response_, hub_.options, host_);
    if (!location_.empty()) {
      response_->set(http::field::location, std::exchange(location_, {}));
    }
    response_->keep_alive(keep);
    if (!head) {
      response_->body() = beast::span<const char>(contents_->data(), contents_->size());
    }
    response_->content_length(contents_->size());
    serializer_.emplace(*response_);
    write_piece();
  }

  void write_piece() {
    close_after(hub_.options.limits.write_seconds);
    http::async_write_some(socket_, *serializer_,
                           [self = shared_from_this()](beast::error_code fault, std::size_t) {
                             self->deadline_.cancel();
                             if (!fault || fault == http::error::need_buffer) {
                               self->written();
                             }
                           });
  }

  void written() {
    if (!serializer_->is_done()) {
      write_piece();
      return;
    }
    const bool keep = response_->keep_alive();
    serializer_.reset();
    response_.reset();
    contents_.reset();
    if (keep && !hub_.stopping) {
      read();
    } else {
      beast::error_code ignored;
      socket_.shutdown(asio::ip::tcp::socket::shutdown_send, ignored);
    }
  }

  Hub& hub_;
  std::unique_ptr<Slot> slot_;
  asio::ip::tcp::socket socket_;
  asio::steady_timer deadline_{hub_.io};
  beast::flat_buffer buffer_{64 << 10};
  std::optional<http::request_parser<http::empty_body>> parser_;
  std::optional<Response> response_;
  std::optional<http::response_serializer<http::span_body<const char>>> serializer_;
  std::shared_ptr<const std::string> contents_;  // what the response shows a part of
  std::string host_;
  std::string location_;
};

}  // namespace

void serve_connection(Hub& hub, asio::ip::tcp::socket socket) {
  beast::error_code ignored;
  if (hub.connections >= hub.options.limits.connections) {
    constexpr std::string_view kFull =
        "HTTP/1.1 503 Service Unavailable\r\nConnection: close\r\n"
        "Content-Type: text/plain; charset=utf-8\r\nContent-Length: 96\r\n\r\n"
        "Too many connections to tenon view are open. Close some of its pages, then load this one "
        "again.\n";
    socket.non_blocking(true, ignored);
    socket.write_some(asio::buffer(kFull.data(), kFull.size()), ignored);
    socket.shutdown(asio::ip::tcp::socket::shutdown_send, ignored);
    return;
  }
  socket.set_option(asio::ip::tcp::no_delay(true), ignored);
  std::make_shared<HttpConnection>(hub, std::move(socket))->read();
}

}  // namespace tenon::serve
