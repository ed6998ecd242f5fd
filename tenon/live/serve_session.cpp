// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The server puts what clients say into an inbox of bounded size, from which the thread of the
// session takes it; a client that says more than fits is dropped by the server. What comes out of
// the session is handed to the server, which is safe from any thread.
#include "tenon/live/serve_session.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <utility>

#include "tenon/base/parallel.h"

namespace tenon::live {
namespace {

using PaceClock = std::chrono::steady_clock;

constexpr std::size_t kMostWaiting = 4096;  // messages that nobody has looked at yet
constexpr auto kFrameTime = std::chrono::microseconds(16'667);
constexpr auto kIdleTime = std::chrono::milliseconds(100);  // also between looks at files

double seconds_between(PaceClock::time_point from, PaceClock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

/// From the thread of the server to that of the session.
class Inbox {
 public:
  bool put(serve::ClientEvent event) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (event.kind == serve::ClientEvent::Kind::Said && waiting_.size() >= kMostWaiting) {
        return false;
      }
      waiting_.push_back(std::move(event));
    }
    filled_.notify_one();
    return true;
  }
  void end() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      ended_ = true;
    }
    filled_.notify_one();
  }
  /// What has come until `then`, at once where there is something; nothing more after end().
  std::deque<serve::ClientEvent> take(PaceClock::time_point then, bool& ended) {
    std::unique_lock<std::mutex> lock(mutex_);
    filled_.wait_until(lock, then, [&] { return ended_ || !waiting_.empty(); });
    ended = ended_;
    return std::exchange(waiting_, {});
  }

 private:
  std::mutex mutex_;
  std::condition_variable filled_;
  std::deque<serve::ClientEvent> waiting_;
  bool ended_ = false;
};

/// Pictures are published before the messages that tell of them.
void send(serve::Server& server, Outbox& out) {
  if (out.picture != nullptr) {
    server.publish("scene.glb", {"model/gltf-binary", out.picture});
  }
  for (Outbox::Message& message : out.messages) {
    server.send(message.to, std::move(message.text));
  }
  if (out.frame) {
    server.send_frame(*std::move(out.frame));
  }
  out = {};
}

void hear(Session& session, const serve::ClientEvent& event, Outbox& out) {
  switch (event.kind) {
    case serve::ClientEvent::Kind::Came:
      session.greet(event.client, out);
      break;
    case serve::ClientEvent::Kind::Said:
      session.hear(event.client, event.text, out);
      break;
    case serve::ClientEvent::Kind::Left:
      session.forget(event.client);
      break;
  }
}

void live(serve::Server& server, Session& session, Inbox& inbox, std::optional<double> seconds) {
  const auto begin = PaceClock::now();
  auto last = begin;
  auto next = last;
  auto looked = last;
  bool ended = false;
  while (!ended) {
    Outbox out;
    for (const serve::ClientEvent& event : inbox.take(next, ended)) {
      hear(session, event, out);
      send(server, out);
    }
    const auto now = PaceClock::now();
    next = session.is_playing() ? std::min(next, last + kFrameTime) : next;
    if (now < next && !ended) {
      continue;  // woken by a message alone
    }
    session.advance(seconds_between(last, now), out);
    last = now;
    if (now - looked >= kIdleTime) {
      session.look_at_files(out);
      looked = PaceClock::now();
    }
    send(server, out);
    if (seconds && seconds_between(begin, now) >= *seconds) {
      server.stop();
    }
    next = now + (session.is_playing() ? PaceClock::duration(kFrameTime) : kIdleTime);
  }
}

}  // namespace

Json address_json(const serve::Server& server) {
  return {{"url", server.url()}, {"port", server.port()}, {"local", server.is_local()}};
}

Result<bool> serve_session(serve::Server& server, Session& session, std::optional<double> seconds) {
  if (session.asset().picture != nullptr) {
    server.publish("scene.glb", {"model/gltf-binary", session.asset().picture});
  }
  Inbox inbox;
  bool by_signal = false;
  const bool served = run_beside([&] { live(server, session, inbox, seconds); },
                                 [&] {
                                   by_signal = server.run([&](serve::ClientEvent event) {
                                     return inbox.put(std::move(event));
                                   });
                                   inbox.end();
                                 });
  if (!served) {
    return Error(ErrorCode::Io, "the system gives no second thread").with_rule("live.no-thread");
  }
  return by_signal;
}

}  // namespace tenon::live
