// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/serve/server.h"

#include <atomic>
#include <csignal>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tenon/serve/test_socket.h"

namespace tenon::serve {
namespace {

Page page_of(const std::string& text) {
  return {"text/plain", std::make_shared<const std::string>(text)};
}

/// A server on a thread of its own that answers "echo X" with "X".
class ServerTest : public ::testing::Test {
 protected:
  void begin(const ServerLimits& limits = {}) {
    ServerOptions options;
    options.token = "secret";
    options.limits = limits;
    auto opened = Server::open(options);
    ASSERT_TRUE(opened) << opened.error().to_string();
    server_.emplace(*std::move(opened));
    server_->publish("", page_of("the page"));
    thread_ = std::thread([this] {
      by_signal_ = server_->run([this](const ClientEvent& event) { return take(event); });
    });
  }
  void TearDown() override {
    if (server_) {
      EXPECT_TRUE(answers()) << "the server does not live";
      end();
    }
  }
  void end() {
    server_->stop();
    thread_.join();
    server_.reset();
  }
  bool take(const ClientEvent& event) {
    came_ += event.kind == ClientEvent::Kind::Came ? 1 : 0;
    left_ += event.kind == ClientEvent::Kind::Left ? 1 : 0;
    if (event.kind == ClientEvent::Kind::Said && event.text.starts_with("echo ")) {
      server_->send(event.client, event.text.substr(5));
    }
    return event.text != "too much";
  }
  bool answers() {
    TestSocket socket(server_->port());
    return socket.get("/secret/").starts_with("HTTP/1.1 200");
  }
  std::string status(const std::string& target, const std::string& host = "localhost") {
    TestSocket socket(server_->port());
    return socket.get(target, host).substr(9, 3);
  }

  std::optional<Server> server_;
  std::thread thread_;
  std::atomic<int> came_ = 0;
  std::atomic<int> left_ = 0;
  std::atomic<bool> by_signal_ = false;
};

TEST_F(ServerTest, HandsOutPagesBehindTheToken) {
  begin();
  TestSocket socket(server_->port());
  const std::string head = socket.get("/secret/");
  EXPECT_TRUE(head.starts_with("HTTP/1.1 200"));
  for (const char* field :
       {"Content-Length: 8", "Content-Type: text/plain",
        "Content-Security-Policy: default-src 'none'", "X-Content-Type-Options: nosniff",
        "Referrer-Policy: no-referrer", "Cache-Control: no-store"}) {
    EXPECT_NE(head.find(field), std::string::npos) << field;
  }
  EXPECT_NE(socket.read_until("the page").find("the page"), std::string::npos);
  EXPECT_NE(socket.get("/secret/no").find("404"), std::string::npos) << "on the same connection";
  EXPECT_EQ(server_->url(), "http://127.0.0.1:" + std::to_string(server_->port()) + "/secret/");
}

TEST_F(ServerTest, TellsTheSizeOfAPageThatOnlyItsHeadIsAskedOf) {
  begin();
  TestSocket socket(server_->port());
  socket.send("HEAD /secret/ HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n");
  const std::string all = socket.read_until({});
  EXPECT_NE(all.find("Content-Length: 8"), std::string::npos);
  EXPECT_TRUE(all.ends_with("\r\n\r\n"));
}

TEST_F(ServerTest, ShowsWhatWasPublishedLast) {
  begin();
  server_->publish("scene.glb", page_of("one"));
  server_->publish("scene.glb", page_of("other"));
  TestSocket socket(server_->port());
  socket.get("/secret/scene.glb");
  EXPECT_NE(socket.read_until("other").find("other"), std::string::npos);
}

TEST_F(ServerTest, RefusesWhoHasNoTokenOrComesByAnotherName) {
  begin();
  for (const char* target : {"/", "/wrong/", "/secretx/", "/../secret/", "/%73ecret/"}) {
    EXPECT_EQ(status(target), "404") << target;
  }
  for (const char* target : {"/secret/../../etc/passwd", "/secret//etc/passwd", "/secret/..%2fx"}) {
    EXPECT_EQ(status(target), "404") << target;
  }
  EXPECT_EQ(status("/secret/", "evil.example"), "403");
  EXPECT_EQ(status("/secret/", ""), "403");
  EXPECT_EQ(status("/secret"), "308");
  EXPECT_EQ(status("/secret/ws"), "426");
}

TEST_F(ServerTest, RefusesWhatIsNoRequest) {
  begin();
  const std::string long_field(20000, 'x');
  const std::vector<std::pair<std::string, std::string>> rows = {
      {"garbage\r\n\r\n", "400"},
      {std::string("\0\x01\x02\xff\r\n\r\n", 8), "400"},
      {"POST /secret/ HTTP/1.1\r\nHost: localhost\r\n\r\n", "405"},
      {"GET /secret/ HTTP/1.1\r\nHost: localhost\r\nX: " + long_field + "\r\n\r\n", "431"},
      {"GET /secret/ HTTP/1.1\r\nHost: localhost\r\nContent-Length: 99999999999999999999\r\n\r\n",
       "400"},
      {"GET /secret/ HTTP/1.1\r\nHost: localhost\r\nContent-Length: 5\r\n\r\nhello", "400"},
  };
  for (const auto& [text, code] : rows) {
    TestSocket socket(server_->port());
    socket.send(text);
    EXPECT_EQ(socket.read_until("\r\n\r\n").substr(0, 12), "HTTP/1.1 " + code)
        << text.substr(0, 60);
  }
}

TEST_F(ServerTest, TakesAsManyConnectionsAsItMay) {
  begin({.connections = 4});
  {
    std::vector<std::unique_ptr<TestSocket>> sockets;
    for (int i = 0; i < 4; ++i) {
      sockets.push_back(std::make_unique<TestSocket>(server_->port()));
      EXPECT_TRUE(sockets.back()->get("/secret/").starts_with("HTTP/1.1 200"));
    }
    TestSocket fifth(server_->port());
    EXPECT_TRUE(fifth.read_until("\r\n\r\n").starts_with("HTTP/1.1 503"));
    sockets.clear();
  }
  for (int i = 0; i < 1000 && !answers(); ++i) {
    std::this_thread::yield();  // it hears of those that left
  }
}

TEST_F(ServerTest, ClosesHalfOpenConnections) {
  begin({.request_seconds = 0.05});
  TestSocket silent(server_->port());
  EXPECT_TRUE(silent.is_closed());
  TestSocket slow(server_->port());
  slow.send("GET /secret/ HTTP/1.1\r\nHos");
  EXPECT_TRUE(slow.is_closed());
}

TEST_F(ServerTest, CarriesTextBothWays) {
  begin();
  TestSocket one(server_->port());
  EXPECT_TRUE(one.upgrade("secret").starts_with("HTTP/1.1 101"));
  one.say("echo hello");
  EXPECT_EQ(one.hear().payload, "hello");
  TestSocket other(server_->port());
  EXPECT_TRUE(other.upgrade("secret", "Origin: http://localhost\r\n").starts_with("HTTP/1.1 101"));
  other.say("echo there");
  EXPECT_EQ(other.hear().payload, "there");
  server_->send(kEveryone, "all");
  EXPECT_EQ(one.hear().payload, "all");
  EXPECT_EQ(other.hear().payload, "all");
  EXPECT_EQ(came_, 2);
}

TEST_F(ServerTest, RefusesSocketsOfOtherSites) {
  begin();
  for (const char* origin : {"http://evil.example", "null", "https://localhost"}) {
    TestSocket socket(server_->port());
    EXPECT_TRUE(socket.upgrade("secret", "Origin: " + std::string(origin) + "\r\n")
                    .starts_with("HTTP/1.1 403"))
        << origin;
  }
  TestSocket wrong(server_->port());
  EXPECT_TRUE(wrong.upgrade("wrong").starts_with("HTTP/1.1 404"));
  EXPECT_EQ(came_, 0);
}

TEST_F(ServerTest, DropsClientsThatSayTooMuchOrNonsense) {
  begin({.message_bytes = 1000});
  const auto dropped = [&](const auto& say) {
    TestSocket socket(server_->port());
    socket.upgrade("secret");
    say(socket);
    while (socket.hear().opcode == 8) {
    }
    return socket.is_closed();
  };
  EXPECT_TRUE(dropped([](TestSocket& s) { s.say(std::string(1001, 'x')); })) << "too long";
  EXPECT_TRUE(dropped([](TestSocket& s) { s.say("bytes", 2); })) << "no text";
  EXPECT_TRUE(dropped([](TestSocket& s) { s.say("\xff\xfe"); })) << "no UTF-8";
  EXPECT_TRUE(dropped([](TestSocket& s) { s.send("garbage garbage garbage"); })) << "no frame";
  EXPECT_TRUE(dropped([](TestSocket& s) { s.say("too much"); })) << "not wanted";
  EXPECT_TRUE(dropped([](TestSocket& s) {
    s.send(std::string("\x81\xff\x7f\xff\xff\xff\xff\xff\xff\xff____", 14));
  })) << "longer than anything";
}

TEST_F(ServerTest, SkipsFramesForSlowClientsAndNeverTheNewest) {
  begin();
  TestSocket socket(server_->port());
  socket.upgrade("secret");
  socket.say("echo begin");
  EXPECT_EQ(socket.hear().payload, "begin");
  constexpr int kFrames = 400;
  for (int i = 1; i <= kFrames; ++i) {
    server_->send_frame(std::to_string(i) + "." + std::string(200000, 'x'));
  }
  int last = 0;
  int heard = 0;
  while (last < kFrames) {
    const TestSocket::Frame frame = socket.hear();
    ASSERT_EQ(frame.opcode, 2);
    const int number = std::stoi(frame.payload);
    EXPECT_GT(number, last);
    last = number;
    ++heard;
  }
  EXPECT_LT(heard, kFrames);
}

TEST_F(ServerTest, DropsWhoDoesNotTakeItsText) {
  begin({.waiting_bytes = 100000});
  TestSocket socket(server_->port());
  socket.upgrade("secret");
  socket.say("echo begin");
  EXPECT_EQ(socket.hear().payload, "begin");
  server_->send(kEveryone, std::string(20000000, 'x'));  // more than the system keeps
  server_->send(kEveryone, "more");
  for (int i = 0; i < 1000 && left_ == 0; ++i) {
    answers();
  }
  EXPECT_EQ(left_, 1);
}

TEST_F(ServerTest, SaysGoodbye) {
  begin();
  TestSocket socket(server_->port());
  socket.upgrade("secret");
  socket.say("echo begin");
  EXPECT_EQ(socket.hear().payload, "begin");
  server_->stop();
  const TestSocket::Frame frame = socket.hear();
  EXPECT_EQ(frame.opcode, 8);
  EXPECT_EQ(frame.payload, "\x03\xe9");  // 1001, going away
  thread_.join();
  EXPECT_FALSE(by_signal_);
  server_.reset();
}

TEST_F(ServerTest, StopsBySignal) {
  begin();
  EXPECT_TRUE(answers());  // it serves
  std::raise(SIGTERM);
  thread_.join();
  EXPECT_TRUE(by_signal_);
  server_.reset();
}

TEST(Server, HeedsASignalThatComesBeforeItRuns) {
  auto server = Server::open({});
  ASSERT_TRUE(server);
  server->heed_signals();
  std::raise(SIGTERM);
  EXPECT_TRUE(server->run([](const ClientEvent&) { return true; }));
}

TEST(Server, TellsWhyItCannotBeHad) {
  const auto no_address = Server::open({.bind = "localhost"});
  ASSERT_FALSE(no_address);
  EXPECT_EQ(no_address.error().code(), ErrorCode::Invalid);
  const auto strange = Server::open({.bind = "192.0.2.1"});  // for documentation alone (RFC 5737)
  ASSERT_FALSE(strange);
  EXPECT_EQ(strange.error().code(), ErrorCode::Io);
  const auto first = Server::open({});
  ASSERT_TRUE(first);
  EXPECT_EQ(first->token().size(), 32U);
  EXPECT_TRUE(first->is_local());
  const auto second = Server::open({.port = first->port()});
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().diagnostic().rule, "serve.bind");
}

}  // namespace
}  // namespace tenon::serve
