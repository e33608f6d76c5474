// SPDX-License-Identifier: GPL-3.0-or-later
// GF_FN marks a function that runs on the host and, when the file is compiled as CUDA, on the device too.
// GF_OUT_OF_LINE: one that the host calls, so that what is before it stays short.
#pragma once

#if defined(__CUDACC__)
#define GF_FN __host__ __device__ inline
#else
#define GF_FN inline
#endif
#if defined(__CUDA_ARCH__)
#define GF_OUT_OF_LINE GF_FN
#else
#define GF_OUT_OF_LINE GF_FN __attribute__((noinline))
#endif
