// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <type_traits>
#include <utility>

namespace tenon {

template <class Signature>
class Function;

/// Anything that can be called with these arguments, or nothing. Copies share what they call. For
/// headers: `<functional>` is ten thousand lines, which every includer would parse.
template <class Answer, class... Arguments>
class Function<Answer(Arguments...)> {
 public:
  Function() = default;
  Function(std::nullptr_t) {}
  template <class Callable>
    requires(!std::is_same_v<std::remove_cvref_t<Callable>, Function> &&
             std::is_invocable_r_v<Answer, std::decay_t<Callable>&, Arguments...>)
  Function(Callable&& callable) {
    if constexpr (std::is_pointer_v<std::remove_cvref_t<Callable>> ||
                  requires { callable.operator bool(); }) {
      if (!callable) {
        return;
      }
    }
    held_ = std::make_shared<Held<std::decay_t<Callable>>>(std::forward<Callable>(callable));
  }

  explicit operator bool() const { return held_ != nullptr; }
  /// Only when there is something to call.
  Answer operator()(Arguments... arguments) const {
    return held_->call(std::forward<Arguments>(arguments)...);
  }

 private:
  struct Base {
    Base() = default;
    Base(const Base&) = delete;
    Base& operator=(const Base&) = delete;
    virtual ~Base() = default;
    virtual Answer call(Arguments... arguments) = 0;
  };
  template <class Callable>
  struct Held final : Base {
    template <class From>
    explicit Held(From&& from) : callable(std::forward<From>(from)) {}
    Answer call(Arguments... arguments) override {
      return static_cast<Answer>(callable(std::forward<Arguments>(arguments)...));
    }
    Callable callable;
  };

  std::shared_ptr<Base> held_;
};

}  // namespace tenon
