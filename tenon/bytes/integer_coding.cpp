// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Reading is safe by two checks up front. The count is compared with the maximum that so many
// compressed bytes can hold before anything is allocated, and the codes are summed up to the length
// of the tail that they need, so that the stream reads on without checks. Writing takes the
// commonest difference, the largest of several, so one list has one encoding. Each difference is
// stored in full width, and the end moves on by the width that it needs: little-endian numbers
// begin with their low bytes, and the next one overwrites the rest. Differences wrap around as
// unsigned numbers, which makes their sums exact.
#include "tenon/bytes/integer_coding.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <memory>
#include <numeric>
#include <vector>

#include "tenon/base/limits/limits.h"
#include "tenon/bytes/integer_stream.h"
#include "tenon/bytes/lz4_block.h"

namespace tenon::bytes {
namespace {

Error too_short() {
  return Error(ErrorCode::Corrupt, "a packed list of integers ends too early")
      .with_rule("file.integers-damaged");
}

/// Puts integers that are equal side by side. Many of 32 bits are put in order by eleven bits at a
/// time, from the low ones up, which takes a fifth of the steps of comparing them.
template <class Signed>
void group_equal(std::vector<Signed>& integers) {
  constexpr unsigned kBits = 11;
  constexpr std::uint32_t kDigits = 1U << kBits;
  constexpr std::size_t kMany = kDigits;
  if (sizeof(Signed) > sizeof(std::uint32_t) || integers.size() < kMany) {
    std::sort(integers.begin(), integers.end());
    return;
  }
  std::vector<Signed> other(integers.size());
  std::vector<std::size_t> starts;
  for (unsigned shift = 0; shift < 8 * sizeof(std::uint32_t); shift += kBits) {
    const auto digit = [shift](Signed x) {
      return static_cast<std::uint32_t>(x) >> shift & (kDigits - 1);
    };
    starts.assign(kDigits + 1, 0);
    for (const Signed x : integers) {
      ++starts[digit(x) + 1];
    }
    std::partial_sum(starts.begin(), starts.end(), starts.begin());
    for (const Signed x : integers) {
      other[starts[digit(x)]++] = x;
    }
    integers.swap(other);
  }
}

/// The commonest of many differences, the largest of several. The small ones, which are nearly all
/// in meshes, are counted by index; the others are sorted: no choice of numbers makes that slow.
template <class Signed>
class DifferenceCounts {
 public:
  explicit DifferenceCounts(std::size_t count) : small_(count < kFew ? 0 : 2 * kSmall) {}

  void add(Signed difference) {
    const std::uint64_t index = static_cast<std::uint64_t>(difference) + kSmall;
    if (index < small_.size()) {
      ++small_[static_cast<std::size_t>(index)];
    } else {
      others_.push_back(difference);
    }
  }
  Signed commonest() {
    for (std::size_t i = 0; i < small_.size(); ++i) {
      note(static_cast<Signed>(i) - static_cast<Signed>(kSmall), small_[i]);
    }
    group_equal(others_);
    for (auto first = others_.begin(); first != others_.end();) {
      const auto last = std::find_if(first, others_.end(), [&](Signed x) { return x != *first; });
      note(*first, static_cast<std::size_t>(last - first));
      first = last;
    }
    return common_;
  }

 private:
  void note(Signed difference, std::size_t count) {
    if (count > common_count_ || (count == common_count_ && count > 0 && difference > common_)) {
      common_ = difference;
      common_count_ = count;
    }
  }

  static constexpr std::uint64_t kSmall = 2048;
  static constexpr std::size_t kFew = 512;
  std::vector<std::size_t> small_;
  std::vector<Signed> others_;
  Signed common_ = 0;
  std::size_t common_count_ = 0;
};

template <class W, class T>
typename W::Signed commonest_difference(std::span<const T> integers) {
  using Signed = typename W::Signed;
  using Unsigned = typename W::Unsigned;
  DifferenceCounts<Signed> counts(integers.size());
  Unsigned before = 0;
  for (const T integer : integers) {
    counts.add(static_cast<Signed>(static_cast<Unsigned>(integer) - before));
    before = static_cast<Unsigned>(integer);
  }
  return counts.commonest();
}

template <class Narrow, class Wide>
bool fits(Wide value) {
  return value >= std::numeric_limits<Narrow>::min() && value <= std::numeric_limits<Narrow>::max();
}

/// Writes differences in their narrowest width. Moves on by that width, but may write all of it.
template <class W>
class DifferenceWriter {
 public:
  DifferenceWriter(typename W::Signed common, char* tail) : common_(common), tail_(tail) {}

  /// The code of the difference.
  unsigned put(typename W::Signed difference) {
    static_assert(std::endian::native == std::endian::little, "narrow numbers lie first");
    std::memcpy(tail_, &difference, sizeof(difference));
    const unsigned wider = (fits<typename W::Short>(difference) ? 0u : 1u) +
                           (fits<typename W::Middle>(difference) ? 0u : 1u);
    const bool is_common = difference == common_;
    tail_ += is_common ? 0 : sizeof(typename W::Short) << wider;
    return is_common ? 0 : wider + 1;
  }
  const char* end() const { return tail_; }

 private:
  typename W::Signed common_;
  char* tail_;
};

/// Four integers, each by `step` more than the one before.
template <class T, class Unsigned>
bool are_steps_of(const T* integers, Unsigned before, Unsigned step) {
  Unsigned others = static_cast<Unsigned>(integers[0]) - before - step;
  for (std::size_t i = 1; i < 4; ++i) {
    others |= static_cast<Unsigned>(integers[i]) - static_cast<Unsigned>(integers[i - 1]) - step;
  }
  return others == 0;
}

}  // namespace

std::uint64_t max_integer_count(std::uint64_t compressed_size) {
  // One byte of codes covers four integers. A product that wraps means a file larger than any.
  return compressed_size * limits::kDecompressionRatio * 4;
}

template <class T>
std::size_t IntegerStream<T>::tail_size(std::span<const char> codes) {
  static constexpr auto kTails = [] {
    std::array<std::uint8_t, 256> tails{};
    for (unsigned code = 0; code < tails.size(); ++code) {
      tails[code] = static_cast<std::uint8_t>(tail_of(code));
    }
    return tails;
  }();
  std::size_t size = 0;
  for (const char code : codes) {
    size += kTails[static_cast<unsigned char>(code)];
  }
  return size;
}

template <class T>
Result<IntegerStream<T>> IntegerStream<T>::open(std::span<const std::byte> compressed,
                                                std::uint64_t count) {
  IntegerStream stream;
  if (count == 0) {
    return stream;
  }
  if (count > max_integer_count(compressed.size())) {
    return too_short();
  }
  const auto size = static_cast<std::size_t>(count);
  const std::size_t codes = integer_codes_size(size);
  TENON_TRY(std::string data, lz4_decompress(compressed, sizeof(T) + codes + size * sizeof(T)));
  if (data.size() < sizeof(T) + codes) {
    return too_short();
  }
  if (const std::size_t last = size % kGroup; last != 0) {
    char& code = data[sizeof(T) + codes - 1];  // its upper bits are unused
    code = static_cast<char>(static_cast<unsigned char>(code) & ((1u << (2 * last)) - 1));
  }
  if (data.size() - sizeof(T) - codes <
      tail_size(std::span<const char>(data).subspan(sizeof(T), codes))) {
    return too_short();
  }
  std::memcpy(&stream.common_, data.data(), sizeof(stream.common_));
  stream.data_ = std::make_unique<const std::string>(std::move(data));
  stream.codes_ = stream.data_->data() + sizeof(T);
  stream.tail_ = stream.codes_ + codes;
  return stream;
}

template class IntegerStream<std::int32_t>;
template class IntegerStream<std::uint32_t>;
template class IntegerStream<std::int64_t>;
template class IntegerStream<std::uint64_t>;

template <class T>
Result<std::vector<T>> decode_integers(std::span<const std::byte> compressed, std::uint64_t count) {
  TENON_TRY(auto stream, IntegerStream<T>::open(compressed, count));
  std::vector<T> integers(static_cast<std::size_t>(count));
  stream.read(integers);
  return integers;
}

template <class T>
std::string encode_integers(std::span<const T> integers) {
  using W = IntegerWidths<sizeof(T)>;
  using Unsigned = typename W::Unsigned;
  using Signed = typename W::Signed;
  if (integers.empty()) {
    return lz4_compress({});
  }
  const Signed common = commonest_difference<W>(integers);
  // The commonest difference, a code for each integer, the differences: no more than this. Not
  // cleared: most of the room is never touched.
  const std::size_t code_bytes = integer_codes_size(integers.size());
  const auto out =
      std::make_unique_for_overwrite<char[]>(sizeof(Signed) * (integers.size() + 2) + code_bytes);
  std::memcpy(out.get(), &common, sizeof(common));
  char* codes = out.get() + sizeof(common);
  DifferenceWriter<W> writer(common, codes + code_bytes);
  Unsigned before = 0;
  for (std::size_t i = 0; i < integers.size(); i += 4) {
    const std::size_t count = std::min<std::size_t>(4, integers.size() - i);
    if (count == 4 && are_steps_of(integers.data() + i, before, static_cast<Unsigned>(common))) {
      before = static_cast<Unsigned>(integers[i + 3]);
      *codes++ = 0;
      continue;
    }
    unsigned code = 0;
    for (std::size_t k = 0; k < count; ++k) {
      const auto integer = static_cast<Unsigned>(integers[i + k]);
      code |= writer.put(static_cast<Signed>(integer - before)) << (2 * k);
      before = integer;
    }
    *codes++ = static_cast<char>(static_cast<unsigned char>(code));
  }
  return lz4_compress(std::as_bytes(
      std::span<const char>(out.get(), static_cast<std::size_t>(writer.end() - out.get()))));
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
