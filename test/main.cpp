// SPDX-License-Identifier: GPL-3.0-or-later
// Catch2 2 is header-only and wants one translation unit with its main(); version 3 is a library with one.
#define CATCH_CONFIG_MAIN
#include "catch.h"
