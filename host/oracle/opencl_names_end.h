// The end of what opencl_names.h began.
#pragma GCC diagnostic pop
#undef FEATURE_MASK
#undef kernel
#undef global
#undef restrict
