// SPDX-License-Identifier: GPL-3.0-or-later
// GF_FN marks a function that runs on the host and, when the file is compiled as CUDA, on the device too.
#pragma once

#if defined(__CUDACC__)
#define GF_FN __host__ __device__ inline
#else
#define GF_FN inline
#endif
