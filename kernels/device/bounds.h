// Bounds of buffers. Where kernels run checked - on the host always, on a device if CHECKED is
// defined - every access asks whether it stays within the buffer that its base points into. One
// that does not is told, and meets zeros instead.
#ifndef PARHELION_BOUNDS_H
#define PARHELION_BOUNDS_H

#define BUFFER_ENUM(type, name) buffer_##name,
enum BufferNumber { SCENE_BUFFERS(BUFFER_ENUM) WORK_BUFFERS(BUFFER_ENUM) buffer_count };

/// What a checked kernel is told beside its parameters.
typedef struct {
#ifdef __OPENCL_C_VERSION__
    ulong bytes[buffer_count];
#else
    unsigned long bytes[buffer_count]; // NOLINT(google-runtime-int): OpenCL's ulong
#endif
} BufferSizes;

#ifdef __OPENCL_C_VERSION__
#ifdef CHECKED
// Of the launch that runs; all its work-items write the same.
global ulong buffer_begin[buffer_count], buffer_end[buffer_count];
global ulong outside_report;
global ulong nowhere[64] __attribute__((aligned(64)));

/// `at` where it is in the same buffer as `base`, and zeros where not.
static __attribute__((noinline)) global void* inside(global const void* base, global const void* at,
                                                     ulong bytes) {
    ulong begin = (ulong)at, end = begin + bytes, from = (ulong)base;
    int nearest = 0;
    for (int k = 0; k < buffer_count; k++) {
        if (from < buffer_begin[k] || from > buffer_end[k]) continue;
        if (begin >= buffer_begin[k] && end <= buffer_end[k]) return (global void*)at;
        nearest = k + 1;
    }
    *(global uint*)outside_report = nearest ? nearest : buffer_count + 1;
    for (int k = 0; k < 64; k++)
        nowhere[k] = 0;
    return (global void*)nowhere;
}

#define CHECKED_PARAMETERS , const BufferSizes sizes, global uint *outside
#define CHECK_BUFFER(type, name)                                                                   \
    buffer_begin[buffer_##name] = (ulong)name;                                                     \
    buffer_end[buffer_##name] = (ulong)name + sizes.bytes[buffer_##name];
#define CHECK_BOUNDS()                                                                             \
    SCENE_BUFFERS(CHECK_BUFFER)                                                                    \
    WORK_BUFFERS(CHECK_BUFFER)                                                                     \
    outside_report = (ulong)outside
#define IN_BUFFER(T, base, index) ((T*)inside(base, (T*)(base) + (index), sizeof(T)))
#define WORD_IN_BUFFER(T, base, word)                                                              \
    ((T*)inside(base, (global const int*)(base) + (word), sizeof(T)))
#define BYTE_IN_BUFFER(T, base, byte)                                                              \
    ((T*)inside(base, (global const char*)(base) + (byte), sizeof(T)))
#else
#define IN_BUFFER(T, base, index) ((T*)(base) + (index))
#define WORD_IN_BUFFER(T, base, word) ((T*)((global const int*)(base) + (word)))
#define BYTE_IN_BUFFER(T, base, byte) ((T*)((global const char*)(base) + (byte)))
#endif
#else
#define BYTE_IN_BUFFER(T, base, byte)                                                              \
    ((T*)inside(base, (global const char*)(base) + (byte), sizeof(T)))
#define IN_BUFFER(T, base, index) ((T*)inside(base, (T*)(base) + (index), sizeof(T)))
#endif

#ifndef CHECKED_PARAMETERS
#define CHECKED_PARAMETERS
#define CHECK_BOUNDS()
#endif

/// Element `index` of type T from `base` on; base stands twice.
#define AT(T, base, index) (*IN_BUFFER(T, base, index))
#define PRIVATE_AT(T, base, index) ((base)[index])
/// A T that begins with byte `byte` from base on, wherever that is.
#define AT_BYTE(T, base, byte) (*BYTE_IN_BUFFER(T, base, byte))
/// A T that begins with word `word` from base on.
#define AT_WORD(T, base, word) (*WORD_IN_BUFFER(T, base, word))

#endif
