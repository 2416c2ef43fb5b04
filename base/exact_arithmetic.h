// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Headers with inline arithmetic include this one. They promise the bits that the library computes, in the caller's
/// program as well; a compiler that may reorder, contract or approximate operations gives others. Where it says that it
/// may, it is stopped here. Contraction to fused operations, which compilers do by default, is switched off by the
/// option -ffp-contract=off, which travels with the CMake targets; who builds without them sets it by hand.
#if defined(__FAST_MATH__) || defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__) ||                       \
    defined(__NO_SIGNED_ZEROS__) || defined(_M_FP_FAST) || (defined(__USE_FAST_MATH__) && __USE_FAST_MATH__ != 0) || \
    (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__ != 0)
#error "trismooth gives the same bits everywhere, fast-math does not: compile without -ffast-math and its parts"
#endif
