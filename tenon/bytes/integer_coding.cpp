// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/bytes/integer_coding.h"

#include <array>
#include <cstring>
#include <limits>
#include <unordered_map>

#include "tenon/base/limits.h"
#include "tenon/bytes/lz4_block.h"

namespace tenon::bytes {
namespace {

template <std::size_t kWidth>
struct Widths;
template <>
struct Widths<4> {
  using Signed = std::int32_t;
  using Unsigned = std::uint32_t;
  using Short = std::int8_t;
  using Middle = std::int16_t;
};
template <>
struct Widths<8> {
  using Signed = std::int64_t;
  using Unsigned = std::uint64_t;
  using Short = std::int16_t;
  using Middle = std::int32_t;
};

Error too_short() {
  return Error(ErrorCode::Corrupt, "a packed list of integers ends too early")
      .with_rule("file.integers-damaged");
}

template <class T>
std::size_t codes_size(T count) {
  return static_cast<std::size_t>((count + 3) / 4);
}

/// Reads differences one by one from the code bytes and the tail. Sums wrap around.
template <class W>
class Decoder {
 public:
  using Unsigned = typename W::Unsigned;

  /// False when `data` are too short for the codes.
  bool start(std::string_view data, std::size_t count) {
    if (data.size() < sizeof(Unsigned) + codes_size(count)) {
      return false;
    }
    std::memcpy(&common_, data.data(), sizeof(common_));
    codes_ = data.data() + sizeof(Unsigned);
    tail_ = codes_ + codes_size(count);
    end_ = data.data() + data.size();
    return true;
  }

  /// The next `count` (1 to 4) integers; false at the end of the tail.
  template <class T>
  bool next(std::size_t count, T* out) {
    const auto codes = static_cast<unsigned char>(*codes_++);
    if (codes == 0) {
      for (std::size_t i = 0; i < count; ++i) {
        out[i] = static_cast<T>(value_ += common_);
      }
      return true;
    }
    for (std::size_t i = 0; i < count; ++i) {
      Unsigned difference = common_;
      const unsigned code = (codes >> (2 * i)) & 3u;
      const bool found = code == 0   ? true
                         : code == 1 ? take<typename W::Short>(difference)
                         : code == 2 ? take<typename W::Middle>(difference)
                                     : take<typename W::Signed>(difference);
      if (!found) {
        return false;
      }
      out[i] = static_cast<T>(value_ += difference);
    }
    return true;
  }

 private:
  template <class Stored>
  bool take(Unsigned& difference) {
    if (static_cast<std::size_t>(end_ - tail_) < sizeof(Stored)) {
      return false;
    }
    Stored stored;
    std::memcpy(&stored, tail_, sizeof(stored));
    tail_ += sizeof(stored);
    difference = static_cast<Unsigned>(static_cast<typename W::Signed>(stored));
    return true;
  }

  Unsigned common_ = 0;
  Unsigned value_ = 0;
  const char* codes_ = nullptr;
  const char* tail_ = nullptr;
  const char* end_ = nullptr;
};

/// How often each difference occurs: the small ones, which are nearly all in meshes, by index.
template <class Signed>
class DifferenceCounts {
 public:
  std::size_t add(Signed difference) {
    if (difference >= -kSmall && difference < kSmall) {
      return ++small_[static_cast<std::size_t>(difference + kSmall)];
    }
    return ++others_[difference];
  }

 private:
  static constexpr Signed kSmall = 2048;
  std::vector<std::size_t> small_ = std::vector<std::size_t>(2 * kSmall);
  std::unordered_map<Signed, std::size_t> others_;
};

/// The commonest difference, the largest of several.
template <class W, class T>
typename W::Signed commonest_difference(std::span<const T> integers) {
  using Signed = typename W::Signed;
  using Unsigned = typename W::Unsigned;
  DifferenceCounts<Signed> counts;
  Signed common = 0;
  std::size_t common_count = 0;
  Unsigned before = 0;
  for (const T integer : integers) {
    const auto difference = static_cast<Signed>(static_cast<Unsigned>(integer) - before);
    before = static_cast<Unsigned>(integer);
    const std::size_t count = counts.add(difference);
    if (count > common_count || (count == common_count && difference > common)) {
      common = difference;
      common_count = count;
    }
  }
  return common;
}

template <class Narrow, class Wide>
bool fits(Wide value) {
  return value >= std::numeric_limits<Narrow>::min() && value <= std::numeric_limits<Narrow>::max();
}

template <class Stored>
void put(Stored value, char*& at) {
  std::memcpy(at, &value, sizeof(value));
  at += sizeof(value);
}

/// Writes `difference` in the narrowest width and moves `tail` behind it; its code.
template <class W>
unsigned put_difference(typename W::Signed difference, char*& tail) {
  if (fits<typename W::Short>(difference)) {
    put(static_cast<typename W::Short>(difference), tail);
    return 1;
  }
  if (fits<typename W::Middle>(difference)) {
    put(static_cast<typename W::Middle>(difference), tail);
    return 2;
  }
  put(difference, tail);
  return 3;
}

}  // namespace

std::uint64_t max_integer_count(std::uint64_t compressed_size) {
  // One byte of codes stands for four integers. A product that wraps stands for a file larger
  // than any.
  return compressed_size * limits::kDecompressionRatio * 4;
}

template <class T>
Result<std::vector<T>> decode_integers(std::span<const std::byte> compressed, std::uint64_t count) {
  using W = Widths<sizeof(T)>;
  if (count == 0) {
    return std::vector<T>();
  }
  if (count > max_integer_count(compressed.size())) {
    return too_short();
  }
  const auto size = static_cast<std::size_t>(count);
  TENON_TRY(const std::string data,
            lz4_decompress(compressed, sizeof(T) + codes_size(size) + size * sizeof(T)));
  Decoder<W> decoder;
  if (!decoder.start(data, size)) {
    return too_short();
  }
  std::vector<T> integers(size);
  std::size_t at = 0;
  for (; at + 4 <= size; at += 4) {
    if (!decoder.next(4, integers.data() + at)) {
      return too_short();
    }
  }
  if (at < size && !decoder.next(size - at, integers.data() + at)) {
    return too_short();
  }
  return integers;
}

template <class T>
std::string encode_integers(std::span<const T> integers) {
  using W = Widths<sizeof(T)>;
  using Unsigned = typename W::Unsigned;
  using Signed = typename W::Signed;
  if (integers.empty()) {
    return lz4_compress({});
  }
  const Signed common = commonest_difference<W>(integers);
  // The commonest difference, a code for each integer, the differences: no more than this.
  const std::size_t code_bytes = codes_size(integers.size());
  std::string out(sizeof(Signed) * (integers.size() + 1) + code_bytes, '\0');
  char* codes = out.data();
  put(common, codes);
  char* tail = codes + code_bytes;
  Unsigned before = 0;
  for (std::size_t i = 0; i < integers.size(); ++i) {
    const auto difference = static_cast<Signed>(static_cast<Unsigned>(integers[i]) - before);
    before = static_cast<Unsigned>(integers[i]);
    const unsigned code = difference == common ? 0 : put_difference<W>(difference, tail);
    codes[i / 4] =
        static_cast<char>(static_cast<unsigned char>(codes[i / 4]) | code << (2 * (i % 4)));
  }
  return lz4_compress(
      std::as_bytes(std::span(out.data(), static_cast<std::size_t>(tail - out.data()))));
}

template Result<std::vector<std::int32_t>> decode_integers(std::span<const std::byte>,
                                                           std::uint64_t);
template Result<std::vector<std::uint32_t>> decode_integers(std::span<const std::byte>,
                                                            std::uint64_t);
template Result<std::vector<std::int64_t>> decode_integers(std::span<const std::byte>,
                                                           std::uint64_t);
template Result<std::vector<std::uint64_t>> decode_integers(std::span<const std::byte>,
                                                            std::uint64_t);
template std::string encode_integers(std::span<const std::int32_t>);
template std::string encode_integers(std::span<const std::uint32_t>);
template std::string encode_integers(std::span<const std::int64_t>);
template std::string encode_integers(std::span<const std::uint64_t>);

}  // namespace tenon::bytes
