// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <tuple>
#include <type_traits>
#include <utility>

/// The fields of plain structs, found by the compiler: nobody lists them, so none is forgotten.
namespace tenon::wire {

/// Stands for a value of any field.
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
/// not compile.
template <class T, std::size_t N = kMaxFields + 1>
constexpr std::size_t field_count() {
  if constexpr (N == 0 || takes_fields<T>(std::make_index_sequence<N>())) {
    static_assert(N <= kMaxFields, "raise kMaxFields");
    return N;
  } else {
    return field_count<T, N - 1>();
  }
}

template <class T>
constexpr auto tied(T& of, std::integral_constant<std::size_t, 1>) {
  auto& [a] = of;
  return std::tie(a);
}
template <class T>
constexpr auto tied(T& of, std::integral_constant<std::size_t, 2>) {
  auto& [a, b] = of;
  return std::tie(a, b);
}
template <class T>
constexpr auto tied(T& of, std::integral_constant<std::size_t, 3>) {
  auto& [a, b, c] = of;
  return std::tie(a, b, c);
}
template <class T>
constexpr auto tied(T& of, std::integral_constant<std::size_t, 4>) {
  auto& [a, b, c, d] = of;
  return std::tie(a, b, c, d);
}
template <class T>
constexpr auto tied(T& of, std::integral_constant<std::size_t, 5>) {
  auto& [a, b, c, d, e] = of;
  return std::tie(a, b, c, d, e);
}
template <class T>
constexpr auto tied(T& of, std::integral_constant<std::size_t, 6>) {
  auto& [a, b, c, d, e, f] = of;
  return std::tie(a, b, c, d, e, f);
}
template <class T>
constexpr auto tied(T& of, std::integral_constant<std::size_t, 7>) {
  auto& [a, b, c, d, e, f, g] = of;
  return std::tie(a, b, c, d, e, f, g);
}
template <class T>
constexpr auto tied(T& of, std::integral_constant<std::size_t, 8>) {
  auto& [a, b, c, d, e, f, g, h] = of;
  return std::tie(a, b, c, d, e, f, g, h);
}
template <class T>
constexpr auto tied(T& of, std::integral_constant<std::size_t, 9>) {
  auto& [a, b, c, d, e, f, g, h, i] = of;
  return std::tie(a, b, c, d, e, f, g, h, i);
}
template <class T>
constexpr auto tied(T& of, std::integral_constant<std::size_t, 10>) {
  auto& [a, b, c, d, e, f, g, h, i, j] = of;
  return std::tie(a, b, c, d, e, f, g, h, i, j);
}
template <class T>
constexpr auto tied(T& of, std::integral_constant<std::size_t, 11>) {
  auto& [a, b, c, d, e, f, g, h, i, j, k] = of;
  return std::tie(a, b, c, d, e, f, g, h, i, j, k);
}
template <class T>
constexpr auto tied(T& of, std::integral_constant<std::size_t, 12>) {
  auto& [a, b, c, d, e, f, g, h, i, j, k, l] = of;
  return std::tie(a, b, c, d, e, f, g, h, i, j, k, l);
}
template <class T>
constexpr auto tied(T& of, std::integral_constant<std::size_t, 13>) {
  auto& [a, b, c, d, e, f, g, h, i, j, k, l, m] = of;
  return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m);
}
template <class T>
constexpr auto tied(T& of, std::integral_constant<std::size_t, 14>) {
  auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n] = of;
  return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m, n);
}
template <class T>
constexpr auto tied(T& of, std::integral_constant<std::size_t, 15>) {
  auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o] = of;
  return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o);
}
template <class T>
constexpr auto tied(T& of, std::integral_constant<std::size_t, 16>) {
  auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p] = of;
  return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p);
}
template <class T>
constexpr auto tied(T& of, std::integral_constant<std::size_t, 17>) {
  auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q] = of;
  return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q);
}
template <class T>
constexpr auto tied(T& of, std::integral_constant<std::size_t, 18>) {
  auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r] = of;
  return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r);
}
template <class T>
constexpr auto tied(T& of, std::integral_constant<std::size_t, 19>) {
  auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s] = of;
  return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s);
}
template <class T>
constexpr auto tied(T& of, std::integral_constant<std::size_t, 20>) {
  auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t] = of;
  return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t);
}
template <class T>
constexpr auto tied(T& of, std::integral_constant<std::size_t, 21>) {
  auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u] = of;
  return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u);
}
template <class T>
constexpr auto tied(T& of, std::integral_constant<std::size_t, 22>) {
  auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v] = of;
  return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v);
}
template <class T>
constexpr auto tied(T& of, std::integral_constant<std::size_t, 23>) {
  auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w] = of;
  return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w);
}
template <class T>
constexpr auto tied(T& of, std::integral_constant<std::size_t, 24>) {
  auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x] = of;
  return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x);
}

/// A struct that has a table of its fields says here how they are tied:
///   template <class Of> static constexpr auto tie(Of& of)
template <class T>
struct FieldTie;

/// References to all fields of a struct, in their order.
template <class T>
constexpr auto fields_of(T& of) {
  using Plain = std::remove_const_t<T>;
  if constexpr (requires { FieldTie<Plain>::tie(of); }) {
    return FieldTie<Plain>::tie(of);
  } else {
    return tied(of, std::integral_constant<std::size_t, field_count<Plain>()>());
  }
}

}  // namespace tenon::wire
