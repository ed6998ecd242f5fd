// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A .npy file is a magic word, a version, the length of a header and the header, a dictionary as
// Python prints it: {'descr': '<f8', 'fortran_order': False, 'shape': (3, 4), }. Then the elements.
// Only what NumPy itself writes is read; all sizes are checked against the file before anything is.
#include "tenon/bake/npy_array.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string_view>
#include <utility>

#include "tenon/base/text/text_number.h"
#include "tenon/base/text/unicode.h"

namespace tenon::bake {
namespace {

static_assert(std::endian::native == std::endian::little);

constexpr std::string_view kMagic = "\x93NUMPY";
constexpr std::size_t kMaxHeader = 65535;
constexpr std::size_t kMaxDimensions = 2;

Error broken(const char* what) { return {ErrorCode::Parse, what}; }

/// The value after "'key':" up to `end`, without leading spaces.
std::optional<std::string_view> entry(std::string_view header, std::string_view key,
                                      std::string_view end) {
  const std::size_t at = header.find("'" + std::string(key) + "':");
  if (at == std::string_view::npos) {
    return std::nullopt;
  }
  std::string_view rest = header.substr(at + key.size() + 3);
  while (rest.starts_with(' ')) {
    rest.remove_prefix(1);
  }
  const std::size_t length = rest.find(end);
  return length == std::string_view::npos ? std::nullopt : std::optional(rest.substr(0, length));
}

/// "(3, 4" -> 3, 4.
std::optional<std::vector<std::size_t>> read_shape(std::string_view text) {
  std::vector<std::size_t> shape;
  if (!text.starts_with('(')) {
    return std::nullopt;
  }
  text.remove_prefix(1);
  while (!text.empty() && shape.size() <= kMaxDimensions) {
    const std::size_t length = std::min(text.find(','), text.size());
    std::string_view number = text.substr(0, length);
    while (number.starts_with(' ')) {
      number.remove_prefix(1);
    }
    if (!number.empty()) {
      const std::optional<double> size = parse_double(number);
      if (!size || !(*size >= 0 && *size <= 1e12)) {
        return std::nullopt;
      }
      shape.push_back(static_cast<std::size_t>(*size));
    }
    text.remove_prefix(std::min(length + 1, text.size()));
  }
  return shape;
}

struct Header {
  std::string_view text;
  std::size_t data = 0;  // where the elements begin
};

std::optional<Header> find_header(std::string_view file) {
  constexpr std::size_t kVersion = kMagic.size();
  if (!file.starts_with(kMagic) || file.size() < kVersion + 6) {
    return std::nullopt;
  }
  const bool is_long = file[kVersion] >= 2;
  std::uint32_t length = 0;
  std::memcpy(&length, file.data() + kVersion + 2, is_long ? 4 : 2);
  const std::size_t begin = kVersion + 2 + (is_long ? 4 : 2);
  if (length > kMaxHeader || length > file.size() - begin) {
    return std::nullopt;
  }
  return Header{file.substr(begin, length), begin + length};
}

template <class T>
T loaded(const char* at) {
  T value;
  std::memcpy(&value, at, sizeof(T));
  return value;
}

}  // namespace

/// "'<f8'": numbers of 4 or 8 bytes, texts of any width that is not absurd.
Result<void> NpyArray::set_type(std::string_view type) {
  constexpr double kWidest = 65536;
  const std::optional<double> width =
      type.size() < 5 ? std::nullopt : parse_double(type.substr(3, type.size() - 4));
  kind_ = type.size() < 5 ? '?' : type[2];
  const bool is_number = kind_ == 'f' || kind_ == 'i' || kind_ == 'u';
  const bool is_known =
      width && type[1] != '>' &&
      (is_number ? *width == 4 || *width == 8 : is_text() && *width >= 1 && *width <= kWidest);
  if (!is_known) {
    return Error(ErrorCode::Unsupported, "its elements are of type " +
                                             std::string(type.substr(0, 40)) +
                                             ", not whole numbers, floats or texts");
  }
  width_ = static_cast<std::size_t>(*width) * (kind_ == 'U' ? 4 : 1);
  return {};
}

/// False where the file has fewer bytes than the elements need.
bool NpyArray::set_shape(std::vector<std::size_t> shape, std::size_t bytes) {
  shape_ = std::move(shape);
  for (const std::size_t n : shape_) {
    if (n != 0 && count_ > bytes / n) {
      return false;
    }
    count_ *= n;
  }
  return count_ <= bytes / width_;
}

Result<NpyArray> NpyArray::read(std::shared_ptr<const bytes::FileBytes> file) {
  const std::optional<Header> header = find_header(file->text());
  if (!header) {
    return broken("it is not an array file of NumPy");
  }
  const auto type = entry(header->text, "descr", ",");
  const auto order = entry(header->text, "fortran_order", ",");
  const auto shape_text = entry(header->text, "shape", ")");
  auto shape = shape_text ? read_shape(*shape_text) : std::nullopt;
  if (!type || !order || !shape || shape->size() > kMaxDimensions) {
    return broken("its header does not tell type, order and at most two sizes");
  }
  NpyArray array;
  TENON_CHECK(array.set_type(*type));
  array.by_columns_ = order->starts_with("True");
  array.data_ = header->data;
  if (!array.set_shape(*std::move(shape), file->size() - array.data_)) {
    return broken("it ends before its last element");
  }
  array.file_ = std::move(file);
  return array;
}

const char* NpyArray::element(std::size_t i) const {
  if (by_columns_ && shape_.size() == 2) {
    i = i % shape_[1] * shape_[0] + i / shape_[1];
  }
  return file_->text().data() + data_ + i * width_;
}

double NpyArray::number(std::size_t i) const {
  const char* at = element(i);
  if (kind_ == 'f') {
    return width_ == 8 ? loaded<double>(at) : static_cast<double>(loaded<float>(at));
  }
  if (kind_ == 'i') {
    return width_ == 8 ? static_cast<double>(loaded<std::int64_t>(at)) : loaded<std::int32_t>(at);
  }
  return width_ == 8 ? static_cast<double>(loaded<std::uint64_t>(at)) : loaded<std::uint32_t>(at);
}

std::string NpyArray::text(std::size_t i) const {
  const std::string_view bytes(element(i), width_);
  if (kind_ == 'S') {
    return std::string(bytes.substr(0, bytes.find('\0')));
  }
  std::string text;
  for (std::size_t k = 0; k < width_; k += 4) {
    const auto code = loaded<std::uint32_t>(bytes.data() + k);
    if (code == 0 || code > 0x10FFFF) {
      break;
    }
    unicode::append(code, text);
  }
  return text;
}

}  // namespace tenon::bake
