// The shared functions that are held against a higher precision, by what they are about.
#pragma once

#include "host/catalogue/function_test.h"

namespace parhelion::stress {

std::vector<FunctionTest> fresnel_functions();
std::vector<FunctionTest> microfacet_functions();
std::vector<FunctionTest> vector_functions();
std::vector<FunctionTest> intersection_functions();
std::vector<FunctionTest> cylinder_functions();
std::vector<FunctionTest> sampling_functions();
std::vector<FunctionTest> normals_functions();

} // namespace parhelion::stress
