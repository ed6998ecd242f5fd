// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/serve/request_guard.h"

#include <gtest/gtest.h>

namespace tenon::serve {
namespace {

TEST(RequestGuard, FindsTheRouteBehindTheToken) {
  EXPECT_EQ(route_of("/abc/", "abc"), "");
  EXPECT_EQ(route_of("/abc/scene.glb", "abc"), "scene.glb");
  EXPECT_EQ(route_of("/abc/page.js?v=1", "abc"), "page.js");
  EXPECT_EQ(route_of("/abc/../x", "abc"), "../x");  // no such page: names are compared whole
}

TEST(RequestGuard, RefusesOtherTokens) {
  for (const char* target : {"/", "", "*", "/abc", "abc/", "//abc/", "/ab/", "/abcd/", "/abd/x",
                             "/?/abc/", "http://127.0.0.1/abc/"}) {
    EXPECT_FALSE(route_of(target, "abc")) << target;
  }
  EXPECT_TRUE(lacks_slash("/abc", "abc"));
  EXPECT_FALSE(lacks_slash("/abd", "abc"));
  EXPECT_FALSE(lacks_slash("", "abc"));
}

TEST(RequestGuard, KnowsTheMachineItself) {
  for (const char* host : {"127.0.0.1", "127.0.0.1:80", "localhost:8080", "[::1]:1", "[::1]"}) {
    EXPECT_TRUE(is_own_host(host, true)) << host;
    EXPECT_TRUE(is_own_host(host, false)) << host;
  }
}

TEST(RequestGuard, RefusesNamesThatLeadHere) {
  for (const char* host :
       {"", "evil.example", "127.0.0.1.evil.example", "localhost.evil.example:1",
        "127.0.0.1:", ":1", "127.0.0.1:x", "127.0.0.1:999999", "127.0.0.1@evil.example", "1.2.3",
        "1.2.3.4.5", "1.2.3.256", "[::1", "[evil]", "[::1].evil.example"}) {
    EXPECT_FALSE(is_own_host(host, true)) << host;
    EXPECT_FALSE(is_own_host(host, false)) << host;
  }
}

TEST(RequestGuard, TakesAddressesWhereItIsBoundToThem) {
  for (const char* host : {"192.168.1.7:8080", "10.0.0.1", "[fe80::1]:8080"}) {
    EXPECT_FALSE(is_own_host(host, true)) << host;
    EXPECT_TRUE(is_own_host(host, false)) << host;
  }
}

TEST(RequestGuard, ComparesOriginsWithTheHost) {
  EXPECT_TRUE(is_own_origin("http://127.0.0.1:80", "127.0.0.1:80"));
  for (const char* origin : {"null", "", "http://evil.example", "https://127.0.0.1:80",
                             "http://127.0.0.1:81", "http://127.0.0.1:80.evil.example"}) {
    EXPECT_FALSE(is_own_origin(origin, "127.0.0.1:80")) << origin;
  }
  EXPECT_FALSE(is_own_origin("http://", ""));
}

}  // namespace
}  // namespace tenon::serve
