// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <type_traits>
#include <utility>

namespace tenon {
struct Diagnostic;
}

/// The fields of plain structs, found by the compiler: without a list, none is forgotten.
namespace tenon::wire {

/// A placeholder that converts to any field's type.
struct AnyField {
  template <class T>
  operator T() const noexcept;  // NOLINT(google-explicit-constructor): never called
};

template <class T, std::size_t... At>
constexpr bool takes_fields(std::index_sequence<At...>) {
  return requires { T{((void)At, AnyField{})...}; };
}

inline constexpr std::size_t kMaxFields = 48;

/// How many fields `T` has, an aggregate without bases; a struct with more than kMaxFields does
/// not compile. N: as many are known to be there.
template <class T, std::size_t N = 0>
constexpr std::size_t field_count() {
  static_assert(N <= kMaxFields, "raise kMaxFields");
  if constexpr (takes_fields<T>(std::make_index_sequence<N + 1>())) {
    return field_count<T, N + 1>();
  } else {
    return N;
  }
}

template <class T, class Call>
constexpr auto tied(T& of, const Call& call, std::integral_constant<std::size_t, 1>) {
  auto& [a] = of;
  return call(a);
}
template <class T, class Call>
constexpr auto tied(T& of, const Call& call, std::integral_constant<std::size_t, 2>) {
  auto& [a, b] = of;
  return call(a, b);
}
template <class T, class Call>
constexpr auto tied(T& of, const Call& call, std::integral_constant<std::size_t, 3>) {
  auto& [a, b, c] = of;
  return call(a, b, c);
}
template <class T, class Call>
constexpr auto tied(T& of, const Call& call, std::integral_constant<std::size_t, 4>) {
  auto& [a, b, c, d] = of;
  return call(a, b, c, d);
}
template <class T, class Call>
constexpr auto tied(T& of, const Call& call, std::integral_constant<std::size_t, 5>) {
  auto& [a, b, c, d, e] = of;
  return call(a, b, c, d, e);
}
template <class T, class Call>
constexpr auto tied(T& of, const Call& call, std::integral_constant<std::size_t, 6>) {
  auto& [a, b, c, d, e, f] = of;
  return call(a, b, c, d, e, f);
}
template <class T, class Call>
constexpr auto tied(T& of, const Call& call, std::integral_constant<std::size_t, 7>) {
  auto& [a, b, c, d, e, f, g] = of;
  return call(a, b, c, d, e, f, g);
}
template <class T, class Call>
constexpr auto tied(T& of, const Call& call, std::integral_constant<std::size_t, 8>) {
  auto& [a, b, c, d, e, f, g, h] = of;
  return call(a, b, c, d, e, f, g, h);
}
template <class T, class Call>
constexpr auto tied(T& of, const Call& call, std::integral_constant<std::size_t, 9>) {
  auto& [a, b, c, d, e, f, g, h, i] = of;
  return call(a, b, c, d, e, f, g, h, i);
}
template <class T, class Call>
constexpr auto tied(T& of, const Call& call, std::integral_constant<std::size_t, 10>) {
  auto& [a, b, c, d, e, f, g, h, i, j] = of;
  return call(a, b, c, d, e, f, g, h, i, j);
}
template <class T, class Call>
constexpr auto tied(T& of, const Call& call, std::integral_constant<std::size_t, 11>) {
  auto& [a, b, c, d, e, f, g, h, i, j, k] = of;
  return call(a, b, c, d, e, f, g, h, i, j, k);
}
template <class T, class Call>
constexpr auto tied(T& of, const Call& call, std::integral_constant<std::size_t, 12>) {
  auto& [a, b, c, d, e, f, g, h, i, j, k, l] = of;
  return call(a, b, c, d, e, f, g, h, i, j, k, l);
}
template <class T, class Call>
constexpr auto tied(T& of, const Call& call, std::integral_constant<std::size_t, 13>) {
  auto& [a, b, c, d, e, f, g, h, i, j, k, l, m] = of;
  return call(a, b, c, d, e, f, g, h, i, j, k, l, m);
}
template <class T, class Call>
constexpr auto tied(T& of, const Call& call, std::integral_constant<std::size_t, 14>) {
  auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n] = of;
  return call(a, b, c, d, e, f, g, h, i, j, k, l, m, n);
}
template <class T, class Call>
constexpr auto tied(T& of, const Call& call, std::integral_constant<std::size_t, 15>) {
  auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o] = of;
  return call(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o);
}
template <class T, class Call>
constexpr auto tied(T& of, const Call& call, std::integral_constant<std::size_t, 16>) {
  auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p] = of;
  return call(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p);
}
template <class T, class Call>
constexpr auto tied(T& of, const Call& call, std::integral_constant<std::size_t, 17>) {
  auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q] = of;
  return call(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q);
}
template <class T, class Call>
constexpr auto tied(T& of, const Call& call, std::integral_constant<std::size_t, 18>) {
  auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r] = of;
  return call(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r);
}
template <class T, class Call>
constexpr auto tied(T& of, const Call& call, std::integral_constant<std::size_t, 19>) {
  auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s] = of;
  return call(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s);
}
template <class T, class Call>
constexpr auto tied(T& of, const Call& call, std::integral_constant<std::size_t, 20>) {
  auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t] = of;
  return call(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t);
}
template <class T, class Call>
constexpr auto tied(T& of, const Call& call, std::integral_constant<std::size_t, 21>) {
  auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u] = of;
  return call(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u);
}
template <class T, class Call>
constexpr auto tied(T& of, const Call& call, std::integral_constant<std::size_t, 22>) {
  auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v] = of;
  return call(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v);
}
template <class T, class Call>
constexpr auto tied(T& of, const Call& call, std::integral_constant<std::size_t, 23>) {
  auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w] = of;
  return call(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w);
}
template <class T, class Call>
constexpr auto tied(T& of, const Call& call, std::integral_constant<std::size_t, 24>) {
  auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x] = of;
  return call(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x);
}

/// A struct that has a table of its fields says here how they are found:
///   template <class Of, class Call> static constexpr auto with(Of& of, const Call& call)
template <class T>
struct FieldTie;

/// Fields of a struct that has constructors are not counted. Another number than it has does not
/// compile.
template <>
struct FieldTie<Diagnostic> {
  template <class Of, class Call>
  static constexpr auto with(Of& of, const Call& call) {
    return tied(of, call, std::integral_constant<std::size_t, 13>());
  }
};

/// Calls `call(field, ...)` with all fields of a struct, in their order; -> what it returns.
template <class T, class Call>
constexpr auto with_fields(T& of, const Call& call) {
  using Plain = std::remove_const_t<T>;
  if constexpr (requires { FieldTie<Plain>::with(of, call); }) {
    return FieldTie<Plain>::with(of, call);
  } else {
    return tied(of, call, std::integral_constant<std::size_t, field_count<Plain>()>());
  }
}

template <class... T>
struct TypeList {};

struct ToTypes {
  template <class... T>
  constexpr TypeList<std::remove_const_t<T>...> operator()(T&...) const {
    return {};
  }
};

/// The types of the fields of a struct.
template <class T>
using FieldTypes = decltype(with_fields(std::declval<T&>(), ToTypes()));

}  // namespace tenon::wire
