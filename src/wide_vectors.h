// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>  // tells which C library it is

/// Before a function whose loops gain from vectors of 32 bytes: it is compiled twice, and a processor that has them
/// takes that one. Both give the same bytes, as no operations are contracted. Programs for other systems have one.
#if defined(__x86_64__) && defined(__GLIBC__) && !defined(__clang__)
#define DROPLET_WIDE_VECTORS [[gnu::target_clones("avx2", "default")]]
#else
#define DROPLET_WIDE_VECTORS
#endif
