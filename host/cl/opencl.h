// The OpenCL C++ bindings with the one configuration this program uses.
#pragma once

#define CL_HPP_TARGET_OPENCL_VERSION 120
#define CL_HPP_MINIMUM_OPENCL_VERSION 120
#define CL_HPP_ENABLE_EXCEPTIONS
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wignored-attributes" // cl_float4 and friends as template arguments
#include <CL/opencl.hpp>
#pragma GCC diagnostic pop
