// What a listener to the kernels is told: nothing on a device. The kernels as C++ may define NOTE
// before (host/twin/kernels_noted.cpp), to tell a path vertex by vertex.
//
// A note stands where a value is made and says by its name what for, so that a function may be
// called as often as it takes.
#ifndef NOTE
#define NOTE(event, value)
#endif
