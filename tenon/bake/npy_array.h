// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "tenon/base/result.h"
#include "tenon/bytes/file_bytes.h"

/// One array as NumPy writes it.
namespace tenon::bake {

/// The contents of a .npy file: real numbers or texts, little-endian.
class NpyArray {
 public:
  /// Errors: Parse for what is no such file or ends early, Unsupported for other element types;
  /// without a rule.
  static Result<NpyArray> read(std::shared_ptr<const bytes::FileBytes> file);

  const std::vector<std::size_t>& shape() const { return shape_; }
  std::size_t size() const { return count_; }
  bool is_text() const { return kind_ == 'S' || kind_ == 'U'; }
  /// Element `i` in the order of rows, whatever the order in the file. Numbers alone.
  double number(std::size_t i) const;
  /// As UTF-8. Texts alone.
  std::string text(std::size_t i) const;

 private:
  Result<void> set_type(std::string_view type);
  bool set_shape(std::vector<std::size_t> shape, std::size_t bytes);
  const char* element(std::size_t i) const;

  std::shared_ptr<const bytes::FileBytes> file_;
  std::vector<std::size_t> shape_;
  std::size_t count_ = 1;
  std::size_t data_ = 0;   // offset in the file
  std::size_t width_ = 0;  // bytes of an element
  char kind_ = 'f';        // 'f', 'i', 'u', 'S' bytes, 'U' characters of four bytes
  bool by_columns_ = false;
};

}  // namespace tenon::bake
