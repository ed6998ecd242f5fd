// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What Boost calls in place of throwing where there are no exceptions (Boost.ThrowException,
// BOOST_NO_EXCEPTIONS). All calls of Boost in this folder take error codes; what comes here is the
// end of memory or of file descriptors while the server is made.
#include <cstdlib>

#include <boost/throw_exception.hpp>

namespace boost {

void throw_exception(const std::exception& /*fault*/) { std::abort(); }

void throw_exception(const std::exception& /*fault*/, const boost::source_location& /*place*/) {
  std::abort();
}

}  // namespace boost
