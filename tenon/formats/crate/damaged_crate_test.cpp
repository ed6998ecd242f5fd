// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <cstring>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>
#include <stdlib.h>

#include "tenon/formats/crate/reader.h"
#include "tenon/formats/crate/sample_layer.h"
#include "tenon/formats/crate/writer.h"

#if defined(__SANITIZE_ADDRESS__)
/// An allocation beyond 256 MiB ends the program: no input of these tests may ask for so much.
extern "C" const char* __asan_default_options() { return "max_allocation_size_mb=256"; }
#endif

namespace tenon::formats {
namespace {

/// Reads the file and all that it defers; true when it could be opened.
bool read_all(const std::string& bytes) {
  Diagnostics diagnostics;
  const auto layer = read_crate(bytes::FileBytes::own(bytes), "damaged.usdc", diagnostics);
  if (!layer) {
    EXPECT_FALSE(layer.error().message().empty());
    return false;
  }
  std::size_t elements = 0;
  for (const layer::Layer::Entry& entry : layer->entries()) {
    for (const layer::Field& field : entry.spec.fields()) {
      const auto decoded = field.value.decoded();
      elements += decoded ? decoded->size() : 0;
    }
  }
  return elements > 0;
}

TEST(DamagedCrate, EveryByteMayBeWrong) {
  const std::string bytes = *write_crate(crate::layer_of_all_types());
  ASSERT_LT(bytes.size(), 20'000u);
  std::size_t opened = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    for (const int flip : {0xff, 0x01}) {
      std::string damaged = bytes;
      damaged[i] = static_cast<char>(damaged[i] ^ flip);
      opened += read_all(damaged) ? 1 : 0;
    }
  }
  EXPECT_GT(opened, 0u) << "some bytes are only contents";
  EXPECT_LT(opened, 2 * bytes.size()) << "some bytes are structure";
}

TEST(DamagedCrate, MayEndAnywhere) {
  const std::string bytes = *write_crate(crate::layer_of_all_types());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_FALSE(read_all(bytes.substr(0, size))) << size;
  }
  EXPECT_TRUE(read_all(bytes));
}

/// Each byte replaced by the extremes of counts: tables and arrays that claim 2^32 or 2^63 rows.
TEST(DamagedCrate, CountsMayBeHuge) {
  const std::string bytes = *write_crate(crate::layer_of_all_types());
  const auto start = std::chrono::steady_clock::now();
  for (std::size_t i = 0; i + 8 <= bytes.size(); i += 4) {
    for (const char top : {'\0', '\x7f', '\xff'}) {
      std::string damaged = bytes;
      damaged.replace(i, 8, std::string(7, '\xff') + top);
      read_all(damaged);
    }
  }
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  EXPECT_LT(took.count(), 280) << "no input takes long";
}

TEST(DamagedCrate, ValuesMayHoldThemselves) {
  layer::Layer layer("made");
  layer::Dictionary inner;
  inner.items["self"] = layer::Value(std::string("x"));
  layer::Dictionary outer;
  outer.items["inner"] = layer::Value(inner);
  layer.root().set("customLayerData", outer);
  std::string bytes = *write_crate(layer);
  // The first dictionary is at 88: count, key, distance 8, word. Its word is made to point at the
  // dictionary itself.
  const std::uint64_t self = std::uint64_t{31} << 48 | 88;
  for (std::size_t i = 0; i < 8; ++i) {
    bytes[88 + 8 + 4 + 8 + i] = static_cast<char>(self >> (8 * i));
  }
  Diagnostics diagnostics;
  const auto back = read_crate(bytes::FileBytes::own(bytes), "x.usdc", diagnostics);
  ASSERT_FALSE(back);
  EXPECT_EQ(back.error().code(), ErrorCode::Limit);
}

TEST(DamagedCrate, SectionsMayLieOutsideOfTheFile) {
  const std::string bytes = *write_crate(crate::layer_of_all_types());
  const auto number_at = [&](std::size_t at) {
    std::uint64_t number = 0;
    std::memcpy(&number, bytes.data() + at, sizeof(number));
    return number;
  };
  // The table of contents: a count, then a name of 16 bytes, start and size of each section.
  const std::size_t table = number_at(16);
  const std::size_t count = number_at(table);
  ASSERT_GE(count, 5u);
  for (std::size_t section = 0; section < count; ++section) {
    const std::size_t start = table + 8 + 32 * section + 16;
    for (const std::size_t field : {start, start + 8}) {
      for (const std::uint64_t wrong : {std::uint64_t{bytes.size() + 1}, ~std::uint64_t{0}}) {
        std::string damaged = bytes;
        std::memcpy(damaged.data() + field, &wrong, sizeof(wrong));
        EXPECT_FALSE(read_all(damaged)) << "section " << section << " at byte " << field;
      }
    }
  }
}

TEST(DamagedCrate, TheCorruptFileOfOpenUsdIsRefusedWhereItIs) {
  const char* set = ::getenv("TENON_SHARED_DIR");
  const std::string shared = set == nullptr ? TENON_SOURCE_DIR "/../shared" : set;
  const std::string path = shared +
                           "/conformance/openusd/pxr/usd/usd/testenv/testUsdReadOutOfBounds/"
                           "corrupt.usd";
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    return;  // published, and not here; the tests above damage files of their own
  }
  EXPECT_FALSE(read_all({std::istreambuf_iterator<char>(file), {}}));
}

}  // namespace
}  // namespace tenon::formats
