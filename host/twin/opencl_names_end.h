// The end of what opencl_names.h began.
#pragma GCC diagnostic pop
#undef FEATURES
#undef kernel
#undef global
#undef restrict
