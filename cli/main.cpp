// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <cstdio>

int main() {
  std::puts("tenon " TENON_VERSION);
  return 0;
}
