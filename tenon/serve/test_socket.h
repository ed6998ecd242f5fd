// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

namespace tenon::serve {

/// A client that sends whatever a test wants, right or wrong.
class TestSocket {
 public:
  explicit TestSocket(std::uint16_t port) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const timeval patience{20, 0};
    ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof(patience));
    ::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof(address));
  }
  TestSocket(const TestSocket&) = delete;
  TestSocket& operator=(const TestSocket&) = delete;
  ~TestSocket() { ::close(socket_); }

  void send(std::string_view text) const {
    ::send(socket_, text.data(), text.size(), MSG_NOSIGNAL);
  }
  /// Until `end` was read, the other side closes, or 20 s are over.
  std::string read_until(std::string_view end) {
    std::array<char, 4096> piece{};
    while (end.empty() || buffer_.find(end) == std::string::npos) {
      const ssize_t count = ::recv(socket_, piece.data(), piece.size(), 0);
      if (count <= 0) {
        closed_ = count == 0 || errno == ECONNRESET;
        break;
      }
      buffer_.append(piece.data(), static_cast<std::size_t>(count));
    }
    return buffer_;
  }
  /// Reads to the end; whether the other side has closed.
  bool is_closed() {
    read_until({});
    return closed_;
  }
  std::string get(const std::string& target, const std::string& host = "localhost",
                  const std::string& more = "") {
    buffer_.clear();
    send("GET " + target + " HTTP/1.1\r\nHost: " + host + "\r\n" + more + "\r\n");
    return read_until("\r\n\r\n");
  }

  // ---- WebSocket (RFC 6455)

  /// The head of the answer.
  std::string upgrade(const std::string& token, const std::string& more = "") {
    std::string head =
        get("/" + token + "/ws", "localhost",
            "Connection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
            "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n" +
                more);
    buffer_.erase(0, buffer_.find("\r\n\r\n") + 4);
    return head;
  }
  void say(const std::string& text, char opcode = 1) const {
    std::string frame{static_cast<char>(0x80 | opcode)};
    if (text.size() < 126) {
      frame += static_cast<char>(0x80 | text.size());
    } else {
      frame += static_cast<char>(0x80 | 127);
      for (int shift = 56; shift >= 0; shift -= 8) {
        frame += static_cast<char>(text.size() >> shift & 0xff);
      }
    }
    send(frame + std::string(4, '\0') + text);  // masked by nothing
  }
  struct Frame {
    int opcode = -1;  ///< -1: the other side has closed
    std::string payload{};
  };
  Frame hear() {
    if (!fill(2)) {
      return {};
    }
    Frame frame{buffer_[0] & 0x0f};
    std::uint64_t size = buffer_[1] & 0x7f;
    std::size_t head = 2;
    const std::size_t more = size == 126 ? 2 : size == 127 ? 8 : 0;
    if (more > 0) {
      fill(2 + more);
      size = 0;
      for (std::size_t i = 0; i < more; ++i) {
        size = size << 8 | static_cast<unsigned char>(buffer_[2 + i]);
      }
      head += more;
    }
    if (!fill(head + size)) {
      return {};
    }
    frame.payload = buffer_.substr(head, size);
    buffer_.erase(0, head + size);
    return frame;
  }

 private:
  bool fill(std::size_t size) {
    std::array<char, 65536> piece{};
    while (buffer_.size() < size) {
      const ssize_t count = ::recv(socket_, piece.data(), piece.size(), 0);
      if (count <= 0) {
        return false;
      }
      buffer_.append(piece.data(), static_cast<std::size_t>(count));
    }
    return true;
  }

  int socket_;
  std::string buffer_;
  bool closed_ = false;
};

}  // namespace tenon::serve
