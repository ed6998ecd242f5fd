// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/base/sha256.h"

#include <string>
#include <utility>

#include <gtest/gtest.h>

namespace tenon {
namespace {

// Messages and digests of FIPS 180-2, appendix B, and the empty message.
TEST(Sha256, DigestsOfTheStandard) {
  const std::pair<std::string, std::string> rows[] = {
      {"", "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855"},
      {"abc", "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"},
      {"abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq",
       "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1"},
      {std::string(1000000, 'a'),
       "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0"},
  };
  for (const auto& [message, digest] : rows) {
    Sha256 hash;
    hash.update(message);
    EXPECT_EQ(hash.hex_digest(), digest) << message.size();
  }
}

TEST(Sha256, PiecesOfAnySizeGiveTheDigestOfTheWhole) {
  const std::string message(1000, 'x');
  Sha256 whole;
  whole.update(message);
  const std::string digest = whole.hex_digest();
  for (const std::size_t size : {1u, 7u, 63u, 64u, 65u, 200u}) {
    Sha256 hash;
    for (std::size_t at = 0; at < message.size(); at += size) {
      hash.update(std::string_view(message).substr(at, size));
    }
    EXPECT_EQ(hash.hex_digest(), digest) << size;
  }
}

}  // namespace
}  // namespace tenon
