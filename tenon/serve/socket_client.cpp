// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// One WebSocket. Text waits in a queue whose size is bounded; of frames only the newest waits, so
// that a slow reader sees fewer of them and never late ones. Everything runs on the serving thread.
#include <chrono>
#include <deque>
#include <utility>

#include <boost/asio/buffer.hpp>
#include <boost/asio/post.hpp>
#include <boost/beast/core/buffers_to_string.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/websocket/stream.hpp>

#include "tenon/serve/hub.h"

namespace tenon::serve {
namespace {

using SocketClock = std::chrono::steady_clock;
namespace websocket = beast::websocket;

SocketClock::duration duration_of(double seconds) {
  return std::chrono::duration_cast<SocketClock::duration>(std::chrono::duration<double>(seconds));
}

}  // namespace

class SocketClient : public std::enable_shared_from_this<SocketClient> {
 public:
  SocketClient(Hub& hub, asio::ip::tcp::socket stream, std::unique_ptr<Slot> slot)
      : hub_(hub), slot_(std::move(slot)), socket_(std::move(stream)) {}

  void accept(const Request& request) {
    const ServerLimits& limits = hub_.options.limits;
    socket_.set_option(websocket::stream_base::timeout{duration_of(limits.request_seconds),
                                                       duration_of(limits.silent_seconds), true});
    socket_.read_message_max(limits.message_bytes);
    socket_.auto_fragment(false);
    socket_.async_accept(request, [self = shared_from_this()](beast::error_code fault) {
      if (!fault && !self->hub_.stopping) {
        self->come();
      }
    });
  }

  void put_text(const std::shared_ptr<const std::string>& text) {
    waiting_bytes_ += text->size();
    texts_.push_back(text);
    const ServerLimits& limits = hub_.options.limits;
    if (waiting_bytes_ > limits.waiting_bytes || texts_.size() > limits.waiting_texts) {
      leave();
      return;
    }
    write_next();
  }

  void put_frame(const std::shared_ptr<const std::string>& frame) {
    frame_ = frame;
    write_next();
  }

  bool is_stuck() const {
    return writing_ &&
           SocketClock::now() - write_begin_ > duration_of(hub_.options.limits.write_seconds);
  }

  void say_goodbye() {
    socket_.async_close(websocket::close_code::going_away,
                        [self = shared_from_this()](beast::error_code) {});
  }

  void leave() {
    if (left_) {
      return;
    }
    left_ = true;
    const auto self = shared_from_this();  // the hub may be the last to know it
    hub_.clients.erase(number_);
    beast::error_code ignored;
    socket_.next_layer().close(ignored);
    hub_.tell({ClientEvent::Kind::Left, number_, {}});
  }

 private:
  void come() {
    number_ = ++hub_.last_client;
    hub_.clients.emplace(number_, shared_from_this());
    hub_.tell({ClientEvent::Kind::Came, number_, {}});
    read();
  }

  void read() {
    if (left_) {
      return;
    }
    socket_.async_read(buffer_, [self = shared_from_this()](beast::error_code fault, std::size_t) {
      self->take(fault);
    });
  }

  void take(beast::error_code fault) {
    if (fault || !socket_.got_text()) {
      leave();
      return;
    }
    std::string text = beast::buffers_to_string(buffer_.data());
    buffer_.consume(buffer_.size());
    hub_.tell({ClientEvent::Kind::Said, number_, std::move(text)});
    read();
  }

  void write_next() {
    if (writing_ != nullptr || left_) {
      return;
    }
    const bool is_text = !texts_.empty();
    if (is_text) {
      writing_ = std::move(texts_.front());
      texts_.pop_front();
    } else if (frame_ != nullptr) {
      writing_ = std::exchange(frame_, nullptr);
    } else {
      return;
    }
    write_begin_ = SocketClock::now();
    socket_.text(is_text);
    socket_.async_write(asio::buffer(*writing_),
                        [self = shared_from_this(), is_text](beast::error_code fault, std::size_t) {
                          self->waiting_bytes_ -= is_text ? self->writing_->size() : 0;
                          self->writing_ = nullptr;
                          fault ? self->leave() : self->write_next();
                        });
  }

  Hub& hub_;
  std::unique_ptr<Slot> slot_;
  websocket::stream<asio::ip::tcp::socket, false> socket_;  ///< false: compresses nothing
  beast::flat_buffer buffer_;
  Client number_ = 0;
  bool left_ = false;
  std::deque<std::shared_ptr<const std::string>> texts_;
  std::size_t waiting_bytes_ = 0;
  std::shared_ptr<const std::string> frame_;
  std::shared_ptr<const std::string> writing_;  // null: nothing is on its way
  SocketClock::time_point write_begin_;
};

Hub::~Hub() { clients.clear(); }

void Hub::tell(ClientEvent event) {
  const Client client = event.client;
  const bool listens = !receive || stopping || receive(std::move(event));
  const auto found = clients.find(client);
  if (!listens && found != clients.end()) {
    drop(found->second);
  }
}

void serve_socket(Hub& hub, asio::ip::tcp::socket stream, std::unique_ptr<Slot> slot,
                  const Request& request) {
  std::make_shared<SocketClient>(hub, std::move(stream), std::move(slot))->accept(request);
}

void send_text(const std::shared_ptr<SocketClient>& client,
               const std::shared_ptr<const std::string>& text) {
  client->put_text(text);
}

void send_frame(const std::shared_ptr<SocketClient>& client,
                const std::shared_ptr<const std::string>& frame) {
  client->put_frame(frame);
}

bool is_stuck(const SocketClient& client) { return client.is_stuck(); }

void drop(const std::shared_ptr<SocketClient>& client) { client->leave(); }

void say_goodbye(const std::shared_ptr<SocketClient>& client) { client->say_goodbye(); }

}  // namespace tenon::serve
