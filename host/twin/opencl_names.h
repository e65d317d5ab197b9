// What OpenCL C has and C++ has not, for the kernels' text inside a struct (kernels_float.cpp and
// kernels_double.cpp, which alone include this and undo it with opencl_names_end.h).
//
// Functions of the kernels become members of that struct: what a kernel takes from its surroundings
// - its number and the features - are values of the struct, so there are no globals.

// No #pragma once: it is text.

#define FEATURES features
#define kernel
#define global
#define restrict __restrict

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-parameter" // all kernels have the same
#pragma GCC diagnostic ignored "-Wunused-variable"
#ifdef __clang__
#pragma GCC diagnostic ignored "-Wbitwise-instead-of-logical" // masks are vectors elsewhere
#else
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized" // lanes that are masked out
#endif
