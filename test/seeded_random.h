// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_TEST_SEEDED_RANDOM_H
#define PGDR_TEST_SEEDED_RANDOM_H

#include <cstdint>

#include "catch.h"
#include "mesh/random.h"

namespace pgdr_test {

/// The random numbers of a test: what fails while they are in scope prints their seed. Not on other threads.
class Seeded_random : public Random {
 public:
  explicit Seeded_random(std::uint64_t seed)
      : Random(seed),
        message_(Catch::MessageBuilder("INFO", CATCH_INTERNAL_LINEINFO, Catch::ResultWas::Info)
                 << "seed " << seed) {}

 private:
  Catch::ScopedMessage message_;
};

}  // namespace pgdr_test

#endif
