// SPDX-License-Identifier: GPL-3.0-or-later
// With -msse2, Eigen takes the instructions of SSE2, which emscripten turns into those of WebAssembly: sums are in the
// order of the command's, and products of matrices take half the time. It also includes this header, of which
// emscripten has none and Eigen uses nothing.
#pragma once

// Eigen's detours around GCC's defects are in the assembly of x86.
#undef EIGEN_COMP_GNUC
#define EIGEN_COMP_GNUC 0
