// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace tenon {

/// A library that is opened when it is needed, and then stays. Functions that only it has are found
/// by name; its own names hide nobody else's.
class SharedLibrary {
 public:
  /// When the library's own calls of others are bound: at once, so that what is missing is known
  /// when it is opened; or when made, which is faster for large libraries.
  enum class Binding : unsigned char { Now, Lazy };

  /// The first of `files` that can be opened: a path, or a name that the system looks for. Empty
  /// names are skipped.
  static SharedLibrary open(const std::vector<std::string>& files, Binding binding = Binding::Now);

  explicit operator bool() const { return handle_ != nullptr; }
  /// What the system said of each file; "" where one was opened.
  const std::string& why_not() const { return why_not_; }

  /// Sets a pointer to a function or variable of that name; false, and null, where there is none.
  template <class Symbol>
  bool find(const char* name, Symbol*& symbol) const {
    symbol = reinterpret_cast<Symbol*>(address(name));
    return symbol != nullptr;
  }
  void* address(const char* name) const;

  /// Makes the library's own calls of one of its functions go to `other`, which takes the same
  /// arguments. Nobody else's calls change. False, with nothing changed, where it makes none that
  /// the loader binds, or this system is none that this is known to work on.
  bool redirect(const char* name, void* other) const;
  /// Whether the process has that file open already.
  static bool is_open(const std::string& file);

 private:
  void* handle_ = nullptr;
  std::string why_not_;
};

/// The folder, absolute and with a '/' behind it, of the program or library that this code is in;
/// "" where the system cannot tell.
std::string folder_of_this_code();

/// Where an installed library keeps one of its own: the file of that name in the folder "tenon"
/// beside this code, absolute; the name alone where there is none. A path keeps it apart from
/// another library of the same name in the process.
std::string own_library(const std::string& name);

}  // namespace tenon
