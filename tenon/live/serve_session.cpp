// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Four threads: the server, the session, and two for answers that take long, one of them for those
// that another program makes. The server puts what
// clients say into an inbox of bounded size, from which the thread of the session takes it; a
// client that says more than its part is dropped by the server, and no other. What comes out of the
// session is handed to the server, which is safe from any thread.
#include "tenon/live/serve_session.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <map>
#include <mutex>
#include <utility>

#include "tenon/base/parallel.h"

namespace tenon::live {
namespace {

using PaceClock = std::chrono::steady_clock;

// Not yet looked at, of one client; what others send closes nobody's connection.
constexpr std::size_t kMostMessages = 1024;
constexpr std::size_t kMostMessageBytes = 2 << 20;
constexpr std::size_t kMostLate = 16;  // answers that are to be made
constexpr auto kFrameTime = std::chrono::microseconds(16'667);
constexpr auto kIdleTime = std::chrono::milliseconds(100);  // also between looks at files

double seconds_between(PaceClock::time_point from, PaceClock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

struct MadeAnswer {
  LateAnswer late;
  Result<Json> result;
};

/// Input of the session.
struct Letters {
  std::deque<serve::ClientEvent> events;
  std::deque<MadeAnswer> answers;
};

/// Messages that wait, of one client.
struct Waiting {
  std::size_t count = 0;
  std::size_t bytes = 0;
};

/// From the other threads to that of the session.
class Inbox {
 public:
  void put(MadeAnswer answer) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      waiting_.answers.push_back(std::move(answer));
    }
    filled_.notify_one();
  }
  bool put(serve::ClientEvent event) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (event.kind == serve::ClientEvent::Kind::Said) {
        Waiting& own = waiting_of_[event.client];
        if (own.count >= kMostMessages || own.bytes > kMostMessageBytes) {
          return false;
        }
        ++own.count;
        own.bytes += event.text.size();
      }
      waiting_.events.push_back(std::move(event));
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
  Letters take(PaceClock::time_point then, bool& ended) {
    std::unique_lock<std::mutex> lock(mutex_);
    filled_.wait_until(lock, then, [&] {
      return ended_ || !waiting_.events.empty() || !waiting_.answers.empty();
    });
    ended = ended_;
    waiting_of_.clear();
    return std::exchange(waiting_, {});
  }

 private:
  std::mutex mutex_;
  std::condition_variable filled_;
  Letters waiting_;
  std::map<serve::Client, Waiting> waiting_of_;
  bool ended_ = false;
};

/// What takes long, one after the other on a thread of its own, so that time goes on meanwhile.
class LateAnswers {
 public:
  /// False when too many wait.
  bool put(LateAnswer& late) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (waiting_.size() >= kMostLate) {
        return false;
      }
      waiting_.push_back(std::move(late));
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
  /// Makes answers until end().
  void run(Inbox& inbox) {
    while (auto late = next()) {
      Result<Json> result = late->make();
      inbox.put({*std::move(late), std::move(result)});
    }
  }

 private:
  std::optional<LateAnswer> next() {
    std::unique_lock<std::mutex> lock(mutex_);
    filled_.wait(lock, [&] { return ended_ || !waiting_.empty(); });
    if (ended_) {
      return std::nullopt;
    }
    LateAnswer late = std::move(waiting_.front());
    waiting_.pop_front();
    return late;
  }

  std::mutex mutex_;
  std::condition_variable filled_;
  std::deque<LateAnswer> waiting_;
  bool ended_ = false;
};

/// Hands over late answers; a client with too many requests at once is refused.
void hand_over(LateAnswers& answers, LateAnswers& outside, const Session& session, Outbox& out) {
  for (LateAnswer& late : std::exchange(out.late, {})) {
    if (!(late.is_outside ? outside : answers).put(late)) {
      session.answer_late(late,
                          Error(ErrorCode::Limit, "too many requests at once")
                              .with_rule("live.busy")
                              .with_fix("wait for the earlier requests"),
                          out);
    }
  }
}

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

void live(serve::Server& server, Session& session, Inbox& inbox, LateAnswers& answers,
          LateAnswers& outside, std::optional<double> seconds) {
  const auto begin = PaceClock::now();
  auto last = begin;
  auto next = last;
  auto looked = last;
  bool ended = false;
  while (!ended) {
    Outbox out;
    Letters letters = inbox.take(next, ended);
    for (const serve::ClientEvent& event : letters.events) {
      hear(session, event, out);
      hand_over(answers, outside, session, out);
      send(server, out);
    }
    for (MadeAnswer& answer : letters.answers) {
      session.answer_late(answer.late, std::move(answer.result), out);
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
    // The clock of frames does not lag behind because one came a little late.
    const PaceClock::duration pause = session.is_playing() ? kFrameTime : kIdleTime;
    next = std::max(next + pause, now + pause / 2);
  }
  session.end_works();
  answers.end();
  outside.end();
}

}  // namespace

Json address_json(const serve::Server& server) {
  return {{"url", server.url()},
          {"urls", server.urls()},
          {"port", server.port()},
          {"local", server.is_local()}};
}

Result<bool> serve_session(serve::Server& server, Session& session, std::optional<double> seconds) {
  if (session.asset().picture != nullptr) {
    server.publish("scene.glb", {"model/gltf-binary", session.asset().picture});
  }
  Inbox inbox;
  LateAnswers answers;
  LateAnswers outside;
  bool by_signal = false;
  const auto serve_pages = [&] {
    by_signal = server.run([&](serve::ClientEvent event) { return inbox.put(std::move(event)); });
    inbox.end();
  };
  bool lived = false;
  const auto serve_live = [&] {
    lived =
        run_beside([&] { live(server, session, inbox, answers, outside, seconds); }, serve_pages);
    answers.end();
    outside.end();
  };
  bool aside = false;
  const auto serve_late = [&] {
    aside = run_beside([&] { outside.run(inbox); }, serve_live);
    answers.end();
  };
  const bool served = run_beside([&] { answers.run(inbox); }, serve_late) && aside && lived;
  if (!served) {
    return Error(ErrorCode::Io, "the system gives no second thread").with_rule("live.no-thread");
  }
  return by_signal;
}

}  // namespace tenon::live
