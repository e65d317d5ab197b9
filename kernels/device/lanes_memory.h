// Moving lanes between memory and registers: contiguous, packed (survivors only), scattered, and
// records.
#ifndef PARHELION_LANES_MEMORY_H
#define PARHELION_LANES_MEMORY_H

#define LOAD_REAL(p) AT(global const Real, p, 0)
#define LOAD_INT(p) AT(global const Int, p, 0)
#define LOAD_UINT(p) AT(global const Uint, p, 0)
#define STORE_REAL(p, v) (AT(global Real, p, 0) = (v))
#define STORE_UINT(p, v) (AT(global Uint, p, 0) = (v))
#define STORE_INT(p, v) (AT(global Int, p, 0) = (v))

typedef union {
    Real lanes;
    Scalar at[LANES];
} RealLanes;
typedef union {
    Int lanes;
    int at[LANES];
} IntLanes;

typedef union {
    Uint lanes;
    unsigned int at[LANES];
} UintLanes;
/// At any byte.
typedef unsigned int AnyWord __attribute__((aligned(1), may_alias));

/// What is wanted of each lane by itself.
FN IntLanes one_by_one(Int v) {
    IntLanes out;
    out.lanes = v;
    return out;
}

/// A table of 16 values and the places to look up; only the lowest 4 bits of each place count.
#define TABLE_PARTS (16 / LANES)
typedef struct {
    Real part[TABLE_PARTS];
} Table;
FN Table load_table(global const float* p) {
    Table t;
    for (int part = 0; part < TABLE_PARTS; part++)
        t.part[part] = LOAD_REAL(p + part * LANES);
    return t;
}
FN Real look_up(const Table* t, Int place) {
#if LANES == 1
    return t->part[place & 15];
#elif LANES == 16 && defined(LANE_AVX512)
    return __builtin_ia32_permvarsf512(t->part[0], place);
#elif LANES == 16
    return shuffle(t->part[0], as_uint16(place));
#elif defined(LANE_AVX512)
    return __builtin_ia32_vpermi2varps256(t->part[0], place, t->part[1]);
#else
    return shuffle2(t->part[0], t->part[1], as_uint8(place));
#endif
}

// Storing the lanes whose bits are set one behind the other. Where lanes are many, up to LANES
// entries behind `p` are overwritten.
#if LANES == 1
#define PACKED_STORE(name, memory, place, type, Lanes, Union, compress)                            \
    FN void name(memory type* p, Lanes v, uint bits) {                                             \
        if (bits) place(memory type, p, 0) = v;                                                    \
    }
#elif defined(LANE_AVX512)
// vstore16() would be four stores.
typedef Real RealAnywhere __attribute__((aligned(4)));
typedef Int IntAnywhere __attribute__((aligned(4)));
#define PACKED_STORE(name, memory, place, type, Lanes, Union, compress)                            \
    FN void name(memory type* p, Lanes v, uint bits) {                                             \
        *(memory Lanes##Anywhere*)p = compress(v, (Lanes)0, bits);                                 \
    }
#if LANES == 16
#define COMPRESS_REAL(v, rest, bits) __builtin_ia32_compresssf512_mask(v, rest, (ushort)(bits))
#define COMPRESS_INT(v, rest, bits) __builtin_ia32_compresssi512_mask(v, rest, (ushort)(bits))
#else
#define COMPRESS_REAL(v, rest, bits) __builtin_ia32_compresssf256_mask(v, rest, (uchar)(bits))
#define COMPRESS_INT(v, rest, bits) __builtin_ia32_compresssi256_mask(v, rest, (uchar)(bits))
#endif
#else
#define PACKED_STORE(name, memory, place, type, Lanes, Union, compress)                            \
    FN void name(memory type* p, Lanes v, uint bits) {                                             \
        Union x;                                                                                   \
        x.lanes = v;                                                                               \
        for (int n = 0; bits; bits &= bits - 1)                                                    \
            place(memory type, p, n++) = x.at[lowest_bit(bits)];                                   \
    }
#endif
PACKED_STORE(store_packed, global, AT, Scalar, Real, RealLanes, COMPRESS_REAL)
PACKED_STORE(store_packed_int, global, AT, int, Int, IntLanes, COMPRESS_INT)
PACKED_STORE(store_packed_private, , PRIVATE_AT, Scalar, Real, RealLanes, COMPRESS_REAL)
PACKED_STORE(store_packed_private_int, , PRIVATE_AT, int, Int, IntLanes, COMPRESS_INT)

/// Up to 16 words, in each lane those of its row.
typedef struct {
    Real word[16];
} Record;

#if LANES == 1
// -------------------------------------------------------------------------------------------------
// one lane
/// `words` words of floats from each lane's own on.
FN Record load_record(global const float* records, IntLanes first, int words) {
    Record r;
    for (int k = 0; k < words; k++)
        r.word[k] = AT(global const float, records, first.at[0] + k);
    return r;
}
FN Real gather(global const float* p, Int index) { return AT(global const float, p, index); }
#ifdef PARHELION_REAL_IS_DOUBLE
FN Real gather(const Scalar* p, Int index) { return AT(const Scalar, p, index); }
#endif
FN Int gather_int(global const int* p, Int index) { return AT(global const int, p, index); }
FN Uint gather_at_byte(global const int* p, Uint byte) {
    return AT_BYTE(global const AnyWord, p, (ulong)byte);
}
FN void scatter_add(global Scalar* p, Int index, Real v, uint bits) {
    if (bits) AT(global Scalar, p, index) += v;
}
FN void scatter_add3(global Scalar* p, long stride, Int index, vec3 v, uint bits) {
    scatter_add(p, index, v.x, bits);
    scatter_add(p + stride, index, v.y, bits);
    scatter_add(p + 2 * stride, index, v.z, bits);
}

#else
// -----------------------------------------------------------------------------------------------
// many lanes
#ifdef LANE_AVX512
#define PLAIN(p) ((const void*)(ulong)(p)) // the builtins know no address spaces
FN Real gather(global const float* p, Int index) {
#if LANES == 16
    return __builtin_ia32_gathersiv16sf((Real)0.f, PLAIN(p), index, (ushort)-1, 4);
#else
    return __builtin_ia32_gather3siv8sf((Real)0.f, PLAIN(p), index, (uchar)-1, 4);
#endif
}
/// The word that begins with a byte, wherever that is: less than 2^32 of them from p on, which
/// signed indices reach from the middle.
FN Uint gather_at_byte(global const int* p, Uint byte) {
    const void* middle = PLAIN((ulong)p + 2147483648ul);
    Int index = asInt(byte - 2147483648u);
#if LANES == 16
    return asUint(__builtin_ia32_gathersiv16si((Int)0, middle, index, (ushort)-1, 1));
#else
    return asUint(__builtin_ia32_gather3siv8si((Int)0, middle, index, (uchar)-1, 1));
#endif
}
#else
FN Real gather(global const float* p, Int index) {
    IntLanes i;
    RealLanes r;
    i.lanes = index;
    for (int k = 0; k < LANES; k++)
        r.at[k] = AT(global const float, p, i.at[k]);
    return r.lanes;
}
FN Uint gather_at_byte(global const int* p, Uint byte) {
    UintLanes b, w;
    b.lanes = byte;
    for (int k = 0; k < LANES; k++)
        w.at[k] = AT_BYTE(global const AnyWord, p, (ulong)b.at[k]);
    return w.lanes;
}
#endif

FN Int gather_int(global const int* p, Int index) {
    return asInt(gather((global const float*)p, index));
}

/// The lanes' indices must differ. Not the processor's scatter: measured, 15 ns a shadow ray more.
FN void scatter_add(global float* p, Int index, Real v, uint bits) {
    IntLanes i;
    RealLanes x;
    i.lanes = index;
    x.lanes = v;
#ifdef LANE_AVX512
    // Paths of the camera lie as they were made.
    int first = i.at[0];
    if (bits == (1u << LANES) - 1u && !someLane(index != (Int)first + LANE_INDEX)) {
        *(global RealAnywhere*)(p + first) += v;
        return;
    }
#endif
    for (; bits; bits &= bits - 1) {
        int k = lowest_bit(bits);
        AT(global float, p, i.at[k]) += x.at[k];
    }
}

/// The same for three values, each `stride` behind the one before: one loop, mostly of few lanes.
FN void scatter_add3(global float* p, long stride, Int index, vec3 v, uint bits) {
    IntLanes i;
    RealLanes x, y, z;
    i.lanes = index;
    x.lanes = v.x;
    y.lanes = v.y;
    z.lanes = v.z;
    for (; bits; bits &= bits - 1) {
        int k = lowest_bit(bits);
        AT(global float, p, i.at[k]) += x.at[k];
        AT(global float, p + stride, i.at[k]) += y.at[k];
        AT(global float, p + 2 * stride, i.at[k]) += z.at[k];
    }
}

#ifdef __clang__
// Loads of 16 bytes and 4 x 4 transposes in registers: cheaper than gathers, and than loads of 64
// and 16 x 16.
#define QUADS
typedef float4 Quad __attribute__((aligned(4)));
#if LANES == 16
#define OF_ALL_ROWS(a, b, c, d)                                                                    \
    a, b, c, d, a + 4, b + 4, c + 4, d + 4, a + 8, b + 8, c + 8, d + 8, a + 12, b + 12, c + 12,    \
        d + 12
#define EVERY_FOURTH(row, k) (Real)(row[k], row[k + 4], row[k + 8], row[k + 12])
#else
#define OF_ALL_ROWS(a, b, c, d) a, b, c, d, a + 4, b + 4, c + 4, d + 4
#define EVERY_FOURTH(row, k) (Real)(row[k], row[k + 4])
#endif
#define MERGE(x, y, a, b, c, d) __builtin_shufflevector(x, y, OF_ALL_ROWS(a, b, c, d))
#define PAIRS_LOW(x, y) MERGE(x, y, 0, LANES, 1, LANES + 1)
#define PAIRS_HIGH(x, y) MERGE(x, y, 2, LANES + 2, 3, LANES + 3)
#define QUADS_LOW(x, y) MERGE(x, y, 0, 1, LANES, LANES + 1)
#define QUADS_HIGH(x, y) MERGE(x, y, 2, 3, LANES + 2, LANES + 3)

/// Four words of each lane's own.
typedef struct {
    float4 row[LANES];
} Quads;

/// Where words `quad` of a record of so many begin that are read together: the last four of it are
/// the last. Of three words one more is read, behind them.
FN int quad_begin(int quad, int words) {
    return 4 * quad + 4 <= words || quad == 0 ? 4 * quad : words - 4;
}

FN Record with_quads(Record r, int at, Quads q) {
    Real a = EVERY_FOURTH(q.row, 0), b = EVERY_FOURTH(q.row, 1), c = EVERY_FOURTH(q.row, 2),
         d = EVERY_FOURTH(q.row, 3);
    Real ab = PAIRS_LOW(a, b), cd = PAIRS_LOW(c, d);
    r.word[at] = QUADS_LOW(ab, cd);
    r.word[at + 1] = QUADS_HIGH(ab, cd);
    ab = PAIRS_HIGH(a, b), cd = PAIRS_HIGH(c, d);
    r.word[at + 2] = QUADS_LOW(ab, cd);
    r.word[at + 3] = QUADS_HIGH(ab, cd);
    return r;
}

/// `words` words from each lane's own on.
FN Record load_record(global const float* records, IntLanes first, int words) {
    Record r;
#pragma unroll
    for (int quad = 0; quad < (words + 3) / 4; quad++) {
        int at = quad_begin(quad, words);
        Quads q;
#pragma unroll
        for (int k = 0; k < LANES; k++)
            q.row[k] = AT_WORD(global const Quad, records, (ulong)(uint)first.at[k] + at);
        r = with_quads(r, at, q);
    }
    return r;
}
#else
FN Record load_record(global const float* records, IntLanes first, int words) {
    Record r;
    for (int k = 0; k < words; k++)
        r.word[k] = gather(records + k, first.lanes);
    return r;
}
#endif
#endif

// The fields of a record by name, from the lists in types.h.
#if LANES == 1
#define RECORD_FIELD(type, name) s.name = record->name;
#define LOADER(Struct, FIELDS, words)                                                              \
    FN Struct load_##Struct(global const Struct##Record* records, Int index) {                     \
        global const Struct##Record* record =                                                      \
            IN_BUFFER(global const Struct##Record, records, index);                                \
        Struct s;                                                                                  \
        FIELDS(RECORD_FIELD)                                                                       \
        return s;                                                                                  \
    }
#else
#define WORD_float(w) (w)
#define WORD_int(w) asInt(w)
#define RECORD_FIELD(type, name)                                                                   \
    s.name = WORD_##type(record.word[__builtin_offsetof(Stored, name) / sizeof(int)]);
#define LOADER(Struct, FIELDS, words)                                                              \
    FN Struct load_##Struct(global const Struct##Record* records, Int index) {                     \
        typedef Struct##Record Stored;                                                             \
        Record record =                                                                            \
            load_record((global const float*)records, one_by_one(index * (words)), words);         \
        Struct s;                                                                                  \
        FIELDS(RECORD_FIELD)                                                                       \
        return s;                                                                                  \
    }
#endif
RECORDS(LOADER)

#endif
