// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/print.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <string>

#include <unistd.h>

#include "cli/text/terminal_text.h"

namespace tenon::cli {

namespace {

std::atomic<void (*)()> before_print = nullptr;
int first_error = 0;

void clear_for_print() {
  if (void (*hook)() = before_print.load()) {
    hook();
  }
}

void print_bytes(std::string_view text) {
  if (first_error == 0 && std::fwrite(text.data(), 1, text.size(), stdout) != text.size()) {
    first_error = errno == 0 ? EIO : errno;
  }
}

}  // namespace

int printing_error() { return first_error; }

void set_before_print(void (*hook)()) { before_print = hook; }

void print(const char* format, ...) {
  char buffer[256];
  std::va_list arguments;
  va_start(arguments, format);
  std::va_list again;
  va_copy(again, arguments);
  const int length = std::vsnprintf(buffer, sizeof buffer, format, arguments);
  va_end(arguments);
  if (length >= 0 && static_cast<std::size_t>(length) < sizeof buffer) {
    print_text({buffer, static_cast<std::size_t>(length)});
  } else if (length >= 0) {
    std::string text(static_cast<std::size_t>(length) + 1, '\0');
    std::vsnprintf(text.data(), text.size(), format, again);
    text.pop_back();
    print_text(text);
  }
  va_end(again);
}

void flush_prints() {
  if (std::fflush(stdout) != 0 && first_error == 0) {
    first_error = errno == 0 ? EIO : errno;
  }
}

void print_text(std::string_view text) {
  clear_for_print();
  const bool plain = std::all_of(text.begin(), text.end(),
                                 [](char c) { return (c >= 0x20 && c < 0x7F) || c == '\n'; });
  plain ? print_bytes(text) : print_bytes(terminal_text(text, true));
}

void print_data(std::string_view text) {
  if (stdout_is_terminal()) {
    print_text(text);
  } else {
    print_bytes(text);
  }
}

void print_colored(std::string_view text) {
  clear_for_print();
  print_bytes(text);
}

void say_aside(std::string_view line) {
  clear_for_print();
  flush_prints();  // so that lines of both streams stay whole and in order in one log
  const std::string whole = std::string(line) + '\n';
  std::fwrite(whole.data(), 1, whole.size(), stderr);
}

bool stdout_is_terminal() { return isatty(STDOUT_FILENO) != 0; }

bool stderr_is_terminal() { return isatty(STDERR_FILENO) != 0; }

}  // namespace tenon::cli
