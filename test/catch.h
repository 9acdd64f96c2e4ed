// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_TEST_CATCH_H
#define PGDR_TEST_CATCH_H

// One header for both versions of Catch2 that distributions ship.
#if __has_include(<catch2/catch_all.hpp>)
#include <catch2/catch_all.hpp>
using Catch::Approx;
#else
#include <catch2/catch.hpp>
#endif

/// Ends a test that cannot run here; ctest lists it as skipped. Only directly inside a TEST_CASE.
#define PGDR_SKIP(reason)              \
  do {                                 \
    WARN("pgdr-test-skip: " << reason); \
    return;                            \
  } while (false)

#endif
